#pragma once

#include <epoxy/gl.h>

#include <map>
#include <string>

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

/// The entries in which two snapshots differ: "blend: 1, not 0; ".
inline std::string difference(const GlSnapshot& actual, const GlSnapshot& expected) {
  std::string text;
  for (const auto& [name, value] : actual)
    if (value != expected.at(name))
      text += name + ": " + std::to_string(value) + ", not " + std::to_string(expected.at(name)) + "; ";
  return text;
}

}  // namespace weft::test
