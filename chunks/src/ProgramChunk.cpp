#include "weft/chunks/ProgramChunk.h"

#include <optional>

#include "weft/chunks/GLName.h"

namespace weft {

namespace {

struct ProgramObjects {
  std::optional<Result<GLProgram>> program;  ///< kept when it failed, too, so that it is not tried each frame
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

Result<GLShader> compile(const ShaderSource& source, GLenum stage, const std::string& file) {
  WEFT_TRY(const ShaderText text, assembleShader(source, file));
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

Result<GLProgram> link(const ShaderSource& source) {
  WEFT_TRY(const GLShader vertex, compile(source, GL_VERTEX_SHADER, source.vertex));
  WEFT_TRY(const GLShader fragment, compile(source, GL_FRAGMENT_SHADER, source.fragment));
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

}  // namespace

void ProgramChunk::activate(GLContext& context, unsigned) const {
  auto& program = context.objectsOf<ProgramObjects>(owner_).program;
  if (!program) program = link(source_);
  if (!*program) context.report(program->error());
  glUseProgram(*program ? GLuint(**program) : 0);
}

void ProgramChunk::changeFrom(GLContext& context, const Chunk&, unsigned slot) const {
  activate(context, slot);
}

void ProgramChunk::deactivate(GLContext&, unsigned) const {
  glUseProgram(0);
}

}  // namespace weft
