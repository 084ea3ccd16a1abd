#pragma once

#include <epoxy/gl.h>

#include <glm/glm.hpp>
#include <vector>

#include "weft/core/Image.h"

namespace weft::test {

/// What the host has drawn so far, row 0 on top.
inline Image windowPicture() {
  GLint viewport[4] = {};
  glGetIntegerv(GL_VIEWPORT, viewport);
  Image picture(viewport[2], viewport[3], 3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  for (int y = 0; y < picture.height; ++y)
    glReadPixels(0, y, picture.width, 1, GL_RGB, GL_UNSIGNED_BYTE,
                 picture.bytes.data() + static_cast<std::size_t>(picture.height - 1 - y) * row);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  return picture;
}

/// Where a point of the world shows.
inline glm::vec3 colorAt(const Image& picture, const glm::mat4& viewProjection, glm::vec3 point) {
  const glm::vec4 clip = viewProjection * glm::vec4(point, 1.0f);
  const glm::vec2 place = 0.5f * glm::vec2(clip.x / clip.w, -clip.y / clip.w) + 0.5f;
  const auto pixel = picture.pixel(static_cast<int>(place.x * static_cast<float>(picture.width)),
                                   static_cast<int>(place.y * static_cast<float>(picture.height)));
  return {pixel[0], pixel[1], pixel[2]};
}

}  // namespace weft::test
