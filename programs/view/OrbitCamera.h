#pragma once

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>

#include "weft/scenegraph/Bounds.h"
#include "weft/scenegraph/Camera.h"

namespace weft {

/// A camera that turns around a place that it looks at; up is +Y.
///
/// Drags are in heights of the picture, x to the right, y down.
class OrbitCamera {
 public:
  /// Looks as another camera does, without its roll, around what of its line of sight is nearest to
  /// the middle of the scene.
  void lookAs(const Camera& camera, const Bounds& scene);
  /// All of the scene, from where it is looked at now.
  void frame(const Node& scene, float aspect);
  /// All of the scene from a direction.
  void frame(const Node& scene, float aspect, glm::dvec3 from);

  void orbit(glm::dvec2 drag);
  void pan(glm::dvec2 drag);
  /// Nearer by a tenth a step, farther where they are negative, within reason.
  void zoom(double steps);

  /// With planes that enclose the scene as far as it can be seen.
  Camera camera(const Bounds& scene) const;

 private:
  glm::dvec3 towardsEye() const;

  glm::dvec3 target_{0.0};
  double distance_ = 3.0;
  double radius_ = 1.0;     ///< of the scene
  double azimuth_ = 0.0;    ///< of the eye: radians from +Z towards +X
  double elevation_ = 0.0;  ///< of the eye above the target, radians
  float fieldOfView_ = 0.5f;
  bool orthographic_ = false;
};

}  // namespace weft
