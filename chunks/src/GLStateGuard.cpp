#include "weft/chunks/GLStateGuard.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "weft/chunks/Slot.h"

namespace weft {

namespace {

constexpr unsigned kUnits = SamplerSlot - TextureSlot;
constexpr unsigned kBlocks = StorageSlot - UniformSlot;
constexpr unsigned kDrawBuffers = 8;  // what every GL 4.5 has
constexpr unsigned kViewports = 16;

/// All off by default. Blending and alpha test have places of their own.
constexpr GLenum kSwitches[] = {
    GL_DEPTH_TEST,
    GL_DEPTH_CLAMP,
    GL_CULL_FACE,
    GL_COLOR_LOGIC_OP,
    GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_POLYGON_OFFSET_FILL,
    GL_POLYGON_OFFSET_LINE,
    GL_POLYGON_OFFSET_POINT,
    GL_PRIMITIVE_RESTART,
    GL_PROGRAM_POINT_SIZE,
    GL_RASTERIZER_DISCARD,
    GL_TEXTURE_CUBE_MAP_SEAMLESS,
    GL_CLIP_DISTANCE0,
    GL_CLIP_DISTANCE1,
    GL_CLIP_DISTANCE2,
    GL_CLIP_DISTANCE3,
    GL_CLIP_DISTANCE4,
    GL_CLIP_DISTANCE5,
    GL_CLIP_DISTANCE6,
    GL_CLIP_DISTANCE7,
};

void setEnabled(GLenum name, bool enabled) {
  (enabled ? glEnable : glDisable)(name);
}

// Values of any kind are kept as doubles, which hold every name, enumerator and float of GL
// exactly.
using Values = std::array<GLdouble, 2>;

GLenum enumOf(GLdouble value) {
  return static_cast<GLenum>(value);
}

/// Some state that one call sets, the names of its values, and GL's defaults of these.
struct Setting {
  std::array<GLenum, 2> names;  ///< the second GL_NONE: one value
  Values initial;
  void (*set)(const Values& values);
};

template <GLenum name>
void setPixelStore(const Values& values) {
  glPixelStorei(name, static_cast<GLint>(values[0]));
}

template <GLenum target>
void setBuffer(const Values& values) {
  glBindBuffer(target, enumOf(values[0]));
}

constexpr Setting kSettings[] = {
    {{GL_CURRENT_PROGRAM}, {}, [](const Values& v) { glUseProgram(enumOf(v[0])); }},
    {{GL_VERTEX_ARRAY_BINDING}, {}, [](const Values& v) { glBindVertexArray(enumOf(v[0])); }},
    {{GL_DEPTH_FUNC}, {GL_LESS}, [](const Values& v) { glDepthFunc(enumOf(v[0])); }},
    {{GL_DEPTH_WRITEMASK}, {GL_TRUE}, [](const Values& v) { glDepthMask(v[0] != 0); }},
    {{GL_CULL_FACE_MODE}, {GL_BACK}, [](const Values& v) { glCullFace(enumOf(v[0])); }},
    {{GL_FRONT_FACE}, {GL_CCW}, [](const Values& v) { glFrontFace(enumOf(v[0])); }},
    {{GL_POLYGON_OFFSET_FACTOR, GL_POLYGON_OFFSET_UNITS},
     {},
     [](const Values& v) { glPolygonOffset(static_cast<GLfloat>(v[0]), static_cast<GLfloat>(v[1])); }},
    {{GL_CLIP_ORIGIN, GL_CLIP_DEPTH_MODE},
     {GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE},
     [](const Values& v) { glClipControl(enumOf(v[0]), enumOf(v[1])); }},
    {{GL_LINE_WIDTH}, {1}, [](const Values& v) { glLineWidth(static_cast<GLfloat>(v[0])); }},
    {{GL_POINT_SIZE}, {1}, [](const Values& v) { glPointSize(static_cast<GLfloat>(v[0])); }},
    {{GL_DRAW_INDIRECT_BUFFER_BINDING}, {}, setBuffer<GL_DRAW_INDIRECT_BUFFER>},
    {{GL_PIXEL_UNPACK_BUFFER_BINDING}, {}, setBuffer<GL_PIXEL_UNPACK_BUFFER>},
    {{GL_PIXEL_PACK_BUFFER_BINDING}, {}, setBuffer<GL_PIXEL_PACK_BUFFER>},
    {{GL_UNIFORM_BUFFER_BINDING}, {}, setBuffer<GL_UNIFORM_BUFFER>},
    {{GL_SHADER_STORAGE_BUFFER_BINDING}, {}, setBuffer<GL_SHADER_STORAGE_BUFFER>},
    {{GL_UNPACK_ALIGNMENT}, {4}, setPixelStore<GL_UNPACK_ALIGNMENT>},
    {{GL_UNPACK_ROW_LENGTH}, {}, setPixelStore<GL_UNPACK_ROW_LENGTH>},
    {{GL_UNPACK_IMAGE_HEIGHT}, {}, setPixelStore<GL_UNPACK_IMAGE_HEIGHT>},
    {{GL_UNPACK_SKIP_PIXELS}, {}, setPixelStore<GL_UNPACK_SKIP_PIXELS>},
    {{GL_UNPACK_SKIP_ROWS}, {}, setPixelStore<GL_UNPACK_SKIP_ROWS>},
    {{GL_UNPACK_SKIP_IMAGES}, {}, setPixelStore<GL_UNPACK_SKIP_IMAGES>},
    {{GL_UNPACK_SWAP_BYTES}, {}, setPixelStore<GL_UNPACK_SWAP_BYTES>},
    {{GL_PACK_ALIGNMENT}, {4}, setPixelStore<GL_PACK_ALIGNMENT>},
    {{GL_PACK_ROW_LENGTH}, {}, setPixelStore<GL_PACK_ROW_LENGTH>},
    {{GL_PACK_IMAGE_HEIGHT}, {}, setPixelStore<GL_PACK_IMAGE_HEIGHT>},
    {{GL_PACK_SKIP_PIXELS}, {}, setPixelStore<GL_PACK_SKIP_PIXELS>},
    {{GL_PACK_SKIP_ROWS}, {}, setPixelStore<GL_PACK_SKIP_ROWS>},
    {{GL_PACK_SKIP_IMAGES}, {}, setPixelStore<GL_PACK_SKIP_IMAGES>},
    {{GL_PACK_SWAP_BYTES}, {}, setPixelStore<GL_PACK_SWAP_BYTES>},
};

// A compatibility context can have another mode for back faces; in a core context only one is
// given.
void setPolygonMode(const std::array<GLint, 2>& modes) {
  if (modes[1] == 0 || modes[1] == modes[0]) {
    glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(modes[0]));
  } else {
    glPolygonMode(GL_FRONT, static_cast<GLenum>(modes[0]));
    glPolygonMode(GL_BACK, static_cast<GLenum>(modes[1]));
  }
}

bool isCompatibility() {
  GLint profile = 0;
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  return (profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
}

/// Of one draw buffer.
struct Blending {
  static constexpr GLenum kNames[] = {GL_BLEND_SRC_RGB,   GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,
                                      GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};

  bool enabled = false;
  std::array<GLint, std::size(kNames)> values{};

  static Blending current(unsigned drawBuffer) {
    Blending blending{glIsEnabledi(GL_BLEND, drawBuffer) == GL_TRUE, {}};
    for (std::size_t i = 0; i < std::size(kNames); ++i)
      glGetIntegeri_v(kNames[i], drawBuffer, &blending.values[i]);
    return blending;
  }

  void restore(unsigned drawBuffer) const {
    const auto value = [this](std::size_t i) { return static_cast<GLenum>(values[i]); };
    (enabled ? glEnablei : glDisablei)(GL_BLEND, drawBuffer);
    glBlendFuncSeparatei(drawBuffer, value(0), value(1), value(2), value(3));
    glBlendEquationSeparatei(drawBuffer, value(4), value(5));
  }
};

/// A binding of a uniform or storage block.
struct BlockBinding {
  GLint buffer = 0;
  GLint64 start = 0, bytes = 0;  ///< 0 bytes: the whole buffer

  static BlockBinding current(GLenum target, unsigned index) {
    const bool uniform = target == GL_UNIFORM_BUFFER;
    BlockBinding binding;
    glGetIntegeri_v(uniform ? GL_UNIFORM_BUFFER_BINDING : GL_SHADER_STORAGE_BUFFER_BINDING, index,
                    &binding.buffer);
    if (binding.buffer == 0) return binding;
    glGetInteger64i_v(uniform ? GL_UNIFORM_BUFFER_START : GL_SHADER_STORAGE_BUFFER_START, index,
                      &binding.start);
    glGetInteger64i_v(uniform ? GL_UNIFORM_BUFFER_SIZE : GL_SHADER_STORAGE_BUFFER_SIZE, index,
                      &binding.bytes);
    return binding;
  }

  void restore(GLenum target, unsigned index) const {
    if (bytes == 0)
      glBindBufferBase(target, index, static_cast<GLuint>(buffer));
    else
      glBindBufferRange(target, index, static_cast<GLuint>(buffer), start, bytes);
  }
};

constexpr GLenum kBlockTargets[] = {GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER};

/// What is bound to a texture unit: a name of each target that has one.
struct Unit {
  static constexpr GLenum kBindings[] = {GL_TEXTURE_BINDING_1D,
                                         GL_TEXTURE_BINDING_2D,
                                         GL_TEXTURE_BINDING_3D,
                                         GL_TEXTURE_BINDING_1D_ARRAY,
                                         GL_TEXTURE_BINDING_2D_ARRAY,
                                         GL_TEXTURE_BINDING_RECTANGLE,
                                         GL_TEXTURE_BINDING_CUBE_MAP,
                                         GL_TEXTURE_BINDING_CUBE_MAP_ARRAY,
                                         GL_TEXTURE_BINDING_BUFFER,
                                         GL_TEXTURE_BINDING_2D_MULTISAMPLE,
                                         GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY};

  GLuint sampler = 0;
  std::vector<GLuint> textures;

  /// Of the active unit.
  static Unit current() {
    Unit unit;
    GLint name = 0;
    for (const GLenum binding : kBindings) {
      glGetIntegerv(binding, &name);
      if (name != 0) unit.textures.push_back(static_cast<GLuint>(name));
    }
    glGetIntegerv(GL_SAMPLER_BINDING, &name);
    unit.sampler = static_cast<GLuint>(name);
    return unit;
  }

  void restore(unsigned number) const {
    glBindTextureUnit(number, 0);  // of every target
    for (const GLuint name : textures) glBindTextureUnit(number, name);
    glBindSampler(number, sampler);
  }
};

}  // namespace

void resetGLState() {
  for (const GLenum name : kSwitches) glDisable(name);
  for (const Setting& setting : kSettings) setting.set(setting.initial);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDisable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ZERO);
  glBlendEquation(GL_FUNC_ADD);
  if (isCompatibility()) glDisable(GL_ALPHA_TEST);
  glBindSamplers(0, kUnits, nullptr);
}

struct GLStateGuard::Saved {
  std::array<bool, std::size(kSwitches)> switches;
  std::array<Values, std::size(kSettings)> settings;
  std::array<GLint, 2> polygonMode{};
  std::array<Blending, kDrawBuffers> blending;
  bool alphaTest = false;
  std::array<std::array<BlockBinding, kBlocks>, std::size(kBlockTargets)> blocks;
  std::array<Unit, kUnits> units;
  GLint drawFramebuffer = 0, readFramebuffer = 0;
  std::array<std::array<GLfloat, 4>, kViewports> viewports;

  Saved();
  void restore() const;
};

GLStateGuard::Saved::Saved() {
  std::transform(std::begin(kSwitches), std::end(kSwitches), switches.begin(),
                 [](GLenum name) { return glIsEnabled(name) == GL_TRUE; });
  std::transform(std::begin(kSettings), std::end(kSettings), settings.begin(), [](const Setting& setting) {
    Values values{};
    for (std::size_t i = 0; i < values.size() && setting.names[i] != GL_NONE; ++i)
      glGetDoublev(setting.names[i], &values[i]);
    return values;
  });
  glGetIntegerv(GL_POLYGON_MODE, polygonMode.data());
  for (unsigned i = 0; i < kDrawBuffers; ++i) blending[i] = Blending::current(i);
  if (isCompatibility()) alphaTest = glIsEnabled(GL_ALPHA_TEST);
  for (std::size_t target = 0; target < blocks.size(); ++target)
    for (unsigned i = 0; i < kBlocks; ++i)
      blocks[target][i] = BlockBinding::current(kBlockTargets[target], i);

  GLint activeUnit = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &activeUnit);
  for (unsigned i = 0; i < kUnits; ++i) {
    glActiveTexture(GL_TEXTURE0 + i);
    units[i] = Unit::current();
  }
  glActiveTexture(static_cast<GLenum>(activeUnit));

  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawFramebuffer);
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &readFramebuffer);
  for (unsigned i = 0; i < kViewports; ++i) glGetFloati_v(GL_VIEWPORT, i, viewports[i].data());
}

void GLStateGuard::Saved::restore() const {
  for (std::size_t target = 0; target < blocks.size(); ++target)
    for (unsigned i = 0; i < kBlocks; ++i) blocks[target][i].restore(kBlockTargets[target], i);
  for (std::size_t i = 0; i < switches.size(); ++i) setEnabled(kSwitches[i], switches[i]);
  // After the blocks, which also bind to the targets in general.
  for (std::size_t i = 0; i < settings.size(); ++i) kSettings[i].set(settings[i]);
  setPolygonMode(polygonMode);
  for (unsigned i = 0; i < kDrawBuffers; ++i) blending[i].restore(i);
  if (alphaTest) glEnable(GL_ALPHA_TEST);
  for (unsigned i = 0; i < kUnits; ++i) units[i].restore(i);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(drawFramebuffer));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(readFramebuffer));
  glViewportArrayv(0, kViewports, viewports[0].data());
}

GLStateGuard::GLStateGuard() : saved_(std::make_unique<const Saved>()) {}

GLStateGuard::~GLStateGuard() {
  saved_->restore();
}

}  // namespace weft
