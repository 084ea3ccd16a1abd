#pragma once

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <map>
#include <string>
#include <tuple>

namespace weft::test {

/// The GL state that chunks and the renderer touch, by name.
using GlSnapshot = std::map<std::string, int>;

inline void addInteger(GlSnapshot& snapshot, const char* name, GLenum value) {
  GLint current[4] = {};
  glGetIntegerv(value, current);
  snapshot[name] = current[0];
}

inline void addTextures(GlSnapshot& snapshot) {
  constexpr std::pair<const char*, GLenum> kBindings[] = {{"2D", GL_TEXTURE_BINDING_2D},
                                                          {"array", GL_TEXTURE_BINDING_2D_ARRAY},
                                                          {"rectangle", GL_TEXTURE_BINDING_RECTANGLE},
                                                          {"volume", GL_TEXTURE_BINDING_3D},
                                                          {"cube", GL_TEXTURE_BINDING_CUBE_MAP},
                                                          {"sampler", GL_SAMPLER_BINDING}};
  GLint active = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  snapshot["active texture"] = active;
  for (unsigned unit = 0; unit < 32; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    for (const auto& [name, binding] : kBindings)
      addInteger(snapshot, ("texture " + std::to_string(unit) + " " + name).c_str(), binding);
  }
  glActiveTexture(static_cast<GLenum>(active));
}

inline void addBlocks(GlSnapshot& snapshot) {
  for (unsigned i = 0; i < 8; ++i) {
    GLint buffer = 0;
    glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, i, &buffer);
    snapshot["uniform " + std::to_string(i)] = buffer;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, i, &buffer);
    snapshot["storage " + std::to_string(i)] = buffer;
  }
}

inline GlSnapshot takeGlSnapshot() {
  GlSnapshot snapshot;
  constexpr std::pair<const char*, GLenum> kIntegers[] = {
      {"program", GL_CURRENT_PROGRAM},
      {"uniform buffer", GL_UNIFORM_BUFFER_BINDING},
      {"storage buffer", GL_SHADER_STORAGE_BUFFER_BINDING},
      {"array buffer", GL_ARRAY_BUFFER_BINDING},
      {"unpack buffer", GL_PIXEL_UNPACK_BUFFER_BINDING},
      {"vertex array", GL_VERTEX_ARRAY_BINDING},
      {"draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING},
      {"read framebuffer", GL_READ_FRAMEBUFFER_BINDING},
      {"depth test", GL_DEPTH_TEST},
      {"depth mask", GL_DEPTH_WRITEMASK},
      {"depth function", GL_DEPTH_FUNC},
      {"cull", GL_CULL_FACE},
      {"cull mode", GL_CULL_FACE_MODE},
      {"front face", GL_FRONT_FACE},
      {"polygon offset", GL_POLYGON_OFFSET_FILL},
      {"polygon offset factor", GL_POLYGON_OFFSET_FACTOR},
      {"polygon offset units", GL_POLYGON_OFFSET_UNITS},
      {"blend", GL_BLEND},
      {"blend source", GL_BLEND_SRC_RGB},
      {"blend destination", GL_BLEND_DST_RGB},
      {"blend source alpha", GL_BLEND_SRC_ALPHA},
      {"blend destination alpha", GL_BLEND_DST_ALPHA},
      {"unpack alignment", GL_UNPACK_ALIGNMENT},
  };
  for (const auto& [name, value] : kIntegers) addInteger(snapshot, name, value);
  addTextures(snapshot);
  addBlocks(snapshot);
  return snapshot;
}

/// All that a host program, in which Weft draws, may have set and does not want to lose.
inline GlSnapshot takeHostSnapshot() {
  GlSnapshot snapshot = takeGlSnapshot();
  constexpr std::pair<const char*, GLenum> kIntegers[] = {
      {"pipeline", GL_PROGRAM_PIPELINE_BINDING},
      {"pack buffer", GL_PIXEL_PACK_BUFFER_BINDING},
      {"indirect buffer", GL_DRAW_INDIRECT_BUFFER_BINDING},
      {"copy read buffer", GL_COPY_READ_BUFFER_BINDING},
      {"copy write buffer", GL_COPY_WRITE_BUFFER_BINDING},
      {"renderbuffer", GL_RENDERBUFFER_BINDING},
      {"draw buffer", GL_DRAW_BUFFER},
      {"read buffer", GL_READ_BUFFER},
      {"blend equation", GL_BLEND_EQUATION_RGB},
      {"blend equation alpha", GL_BLEND_EQUATION_ALPHA},
      {"logic operation", GL_COLOR_LOGIC_OP},
      {"depth clamp", GL_DEPTH_CLAMP},
      {"scissor test", GL_SCISSOR_TEST},
      {"stencil test", GL_STENCIL_TEST},
      {"stencil function", GL_STENCIL_FUNC},
      {"stencil mask", GL_STENCIL_WRITEMASK},
      {"multisampling", GL_MULTISAMPLE},
      {"alpha to coverage", GL_SAMPLE_ALPHA_TO_COVERAGE},
      {"dithering", GL_DITHER},
      {"sRGB", GL_FRAMEBUFFER_SRGB},
      {"seamless cubes", GL_TEXTURE_CUBE_MAP_SEAMLESS},
      {"line offset", GL_POLYGON_OFFSET_LINE},
      {"point offset", GL_POLYGON_OFFSET_POINT},
      {"primitive restart", GL_PRIMITIVE_RESTART},
      {"restart index", GL_PRIMITIVE_RESTART_INDEX},
      {"program point size", GL_PROGRAM_POINT_SIZE},
      {"rasterizer discard", GL_RASTERIZER_DISCARD},
      {"clip distance 0", GL_CLIP_DISTANCE0},
      {"clip distance 7", GL_CLIP_DISTANCE7},
      {"clip origin", GL_CLIP_ORIGIN},
      {"clip depth", GL_CLIP_DEPTH_MODE},
      {"provoking vertex", GL_PROVOKING_VERTEX},
      {"line width", GL_LINE_WIDTH},
      {"point size", GL_POINT_SIZE},
      {"unpack row length", GL_UNPACK_ROW_LENGTH},
      {"unpack rows skipped", GL_UNPACK_SKIP_ROWS},
      {"unpack pixels skipped", GL_UNPACK_SKIP_PIXELS},
      {"unpack swaps", GL_UNPACK_SWAP_BYTES},
      {"unpack image height", GL_UNPACK_IMAGE_HEIGHT},
      {"unpack images skipped", GL_UNPACK_SKIP_IMAGES},
      {"pack alignment", GL_PACK_ALIGNMENT},
      {"pack row length", GL_PACK_ROW_LENGTH},
      {"debug output", GL_DEBUG_OUTPUT},
  };
  for (const auto& [name, value] : kIntegers) addInteger(snapshot, name, value);
  constexpr std::tuple<const char*, GLenum, std::size_t> kVectors[] = {{"viewport", GL_VIEWPORT, 4},
                                                                       {"scissor", GL_SCISSOR_BOX, 4},
                                                                       {"color mask", GL_COLOR_WRITEMASK, 4},
                                                                       {"polygon mode", GL_POLYGON_MODE, 2}};
  for (const auto& [name, value, count] : kVectors) {
    GLint current[4] = {};
    glGetIntegerv(value, current);
    for (std::size_t i = 0; i < count; ++i) snapshot[fmt::format("{} {}", name, i)] = current[i];
  }
  for (unsigned i = 0; i < 8; ++i) {
    GLint64 size = 0;
    glGetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, i, &size);
    snapshot[fmt::format("uniform {} size", i)] = static_cast<int>(size);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, i, &size);
    snapshot[fmt::format("storage {} start", i)] = static_cast<int>(size);
    GLint source = 0;
    glGetIntegeri_v(GL_BLEND_SRC_RGB, i, &source);
    snapshot[fmt::format("blend {} source", i)] = source;
    snapshot[fmt::format("blend {}", i)] = glIsEnabledi(GL_BLEND, i);
  }
  return snapshot;
}

/// The entries in which two snapshots differ: "blend: 1, not 0; ".
inline std::string difference(const GlSnapshot& actual, const GlSnapshot& expected) {
  std::string text;
  for (const auto& [name, value] : actual)
    if (value != expected.at(name))
      text += name + ": " + std::to_string(value) + ", not " + std::to_string(expected.at(name)) + "; ";
  return text;
}

}  // namespace weft::test
