#include "weft/chunks/ProgramChunk.h"

#include <cstdint>
#include <map>
#include <utility>

#include "weft/chunks/GLName.h"

namespace weft {

namespace {

/// The texts of the stages, includes put in.
struct ProgramText {
  ShaderText vertex, fragment;

  bool operator==(const ProgramText& other) const {
    return vertex.text == other.vertex.text && fragment.text == other.fragment.text;
  }
};

/// What all chunks of equal source use under the same variant of the context.
struct LinkedProgram {
  ProgramText text;
  Result<GLProgram> program;  ///< an error, too, so that it is not tried each frame
};

/// The programs of a context that some chunk has.
struct ProgramCache {
  std::map<ShaderSource, std::weak_ptr<LinkedProgram>> programs;
};

struct ProgramObjects {
  std::map<ShaderVariant, std::shared_ptr<LinkedProgram>> variants;
  const LinkedProgram* active = nullptr;
  std::uint64_t activeRevision = 0;  ///< of the context's variant
};

std::string shaderLog(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  glGetShaderInfoLog(shader, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

std::string programLog(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  glGetProgramInfoLog(program, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

Result<GLShader> compile(GLenum stage, const ShaderText& text, const std::string& file) {
  GLShader shader(glCreateShader(stage));
  const GLchar* code = text.text.c_str();
  glShaderSource(shader, 1, &code, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::string place;
  const std::string log = text.withPlaces(shaderLog(shader), place);
  return fail("the shader does not compile: " + log, place.empty() ? file : place);
}

Result<ProgramText> assemble(const ShaderSource& source) {
  WEFT_TRY(ShaderText vertex, assembleShader(source, source.vertex));
  WEFT_TRY(ShaderText fragment, assembleShader(source, source.fragment));
  return ProgramText{std::move(vertex), std::move(fragment)};
}

Result<GLProgram> link(const ShaderSource& source, const ProgramText& text) {
  WEFT_TRY(const GLShader vertex, compile(GL_VERTEX_SHADER, text.vertex, source.vertex));
  WEFT_TRY(const GLShader fragment, compile(GL_FRAGMENT_SHADER, text.fragment, source.fragment));
  GLProgram program(glCreateProgram());
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glLinkProgram(program);
  glDetachShader(program, vertex);
  glDetachShader(program, fragment);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  return fail("the program does not link: " + programLog(program), source.vertex + " and " + source.fragment);
}

LinkedProgram make(const ShaderSource& source) {
  Result<ProgramText> text = assemble(source);
  if (!text) return {{}, tl::unexpected(text.error())};
  Result<GLProgram> program = link(source, *text);
  return {std::move(*text), std::move(program)};
}

/// Replaces the program if the text is another and in order.
Result<bool> reload(const ShaderSource& source, LinkedProgram& program) {
  WEFT_TRY(ProgramText text, assemble(source));
  if (text == program.text) return false;
  WEFT_TRY(GLProgram linked, link(source, text));
  program = {std::move(text), std::move(linked)};
  return true;
}

/// What a program is made of in this context.
ShaderSource sourceIn(const GLContext& context, ShaderSource source) {
  const auto& [defines, includeAliases] = context.programVariant();
  source.defines.insert(source.defines.end(), defines.begin(), defines.end());
  source.includeAliases.insert(includeAliases.begin(), includeAliases.end());
  if (source.overrideFolder.empty()) source.overrideFolder = context.shaderFolder();
  return source;
}

std::shared_ptr<LinkedProgram> findOrMake(GLContext& context, const ShaderSource& source) {
  auto& programs = context.shared<ProgramCache>().programs;
  std::erase_if(programs, [](const auto& entry) { return entry.second.expired(); });
  std::weak_ptr<LinkedProgram>& known = programs[source];
  std::shared_ptr<LinkedProgram> program = known.lock();
  if (!program) known = program = std::make_shared<LinkedProgram>(make(source));
  return program;
}

}  // namespace

void ProgramChunk::activate(GLContext& context, unsigned) const {
  auto& objects = context.objectsOf<ProgramObjects>(owner_);
  if (!objects.active || objects.activeRevision != context.programVariantRevision()) {
    auto& variant = objects.variants[context.programVariant()];
    if (!variant) variant = findOrMake(context, sourceIn(context, source_));
    objects.active = variant.get();
    objects.activeRevision = context.programVariantRevision();
  }
  const Result<GLProgram>& program = objects.active->program;
  if (!program) context.report(program.error());
  glUseProgram(program ? GLuint(*program) : 0);
}

void ProgramChunk::changeFrom(GLContext& context, const Chunk&, unsigned slot) const {
  activate(context, slot);
}

void ProgramChunk::deactivate(GLContext&, unsigned) const {
  glUseProgram(0);
}

bool ProgramChunk::isEqual(const Chunk& other) const {
  return source_ == static_cast<const ProgramChunk&>(other).source_;
}

Result<bool> reloadPrograms(GLContext& context) {
  Result<bool> changed = false;
  for (const auto& [source, known] : context.shared<ProgramCache>().programs) {
    const std::shared_ptr<LinkedProgram> program = known.lock();
    if (!program) continue;
    const Result<bool> reloaded = reload(source, *program);
    if (changed && (!reloaded || *reloaded)) changed = reloaded;
  }
  return changed;
}

}  // namespace weft
