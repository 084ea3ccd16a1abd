#pragma once

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/matrix.hpp>

#include "weft/scenegraph/Camera.h"

namespace weft {

/// What is seen from where. Shaders work around the place, so that floats suffice wherever in the
/// world it is.
struct View {
  View(const Camera& camera, float aspect)
      : place(camera.position()),
        eye(camera.isOrthographic() ? camera.eye() : glm::dvec4(0, 0, 0, 1)),
        forward(-glm::transpose(glm::dmat3(camera.view))[2]),
        fromPlace(camera.projection(aspect) * glm::dmat4(glm::dmat3(camera.view))) {}
  /// Of a light: nothing is sorted by depth there.
  View(const glm::dvec3& lightPlace, const glm::dmat4& projection)
      : place(lightPlace), fromPlace(projection) {}

  glm::dvec3 place;            ///< of the eye in the world
  glm::dvec4 eye{0, 0, 0, 1};  ///< from there: that, or the direction of an orthographic view
  glm::dvec3 forward{0.0};     ///< unit
  glm::dmat4 fromPlace;        ///< from the world's axes around the place to clip space
};

}  // namespace weft
