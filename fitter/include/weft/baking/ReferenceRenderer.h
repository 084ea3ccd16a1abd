#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"

namespace weft {

/// Indexed triangles to look at, in glTF's conventions: counter-clockwise seen from the front, V
/// runs down the image, and the bitangent, which points up the image, is tangent.w (N x T). A
/// `Mesh` of the scene graph without the scene graph.
struct ReferenceMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> texcoords;
  std::vector<std::uint32_t> indices;  ///< three a triangle
};

/// A square cloth of side 2 around the origin that hangs in the plane z = 0 in soft folds, which
/// grow from its upper edge to its lower one; +Y is up. (u, v) = (0, 0) at the upper left, (1, 1)
/// at the lower right.
ReferenceMesh makeFoldedCloth();

/// A material as the renderer asks for it.
struct ReferenceMaterial {
  int width = 1;  ///< texels of one repetition
  int height = 1;
  glm::vec2 repetitions{1.0f};  ///< per unit of texture coordinates
  /// Linear RGB of texel (x, y) for unit directions of its tangent frame, n.l included: 1 is a
  /// white Lambertian surface lit head-on. light.z > 0; called from many threads at once.
  std::function<glm::vec3(int x, int y, glm::vec3 light, glm::vec3 view)> value{};
  /// Radiance that it shows of what surrounds it, beside the lights; may be empty. `axes`: tangent,
  /// bitangent and normal in the world; likewise called.
  std::function<glm::vec3(int x, int y, const glm::mat3& axes, glm::vec3 view)> surroundings{};
};

struct ReferenceLight {
  enum class Kind { Directional, Point };
  Kind kind = Kind::Directional;
  glm::vec3 place{0, 0, 1};  ///< the direction towards the light, or where it is; world space
  /// linear RGB: lux (irradiance of a surface that faces it), or candela
  glm::vec3 intensity{1.0f};
};

/// From where, under which light, and how a picture is made.
struct ReferenceShot {
  glm::vec3 eye{0, 0, 3};
  glm::vec3 target{0.0f};
  glm::vec3 up{0, 1, 0};
  float verticalFieldOfView = 0.7f;  ///< radians
  std::vector<ReferenceLight> lights;
  bool shadows = true;  ///< the mesh casts shadows on itself
  int width = 512;
  int height = 512;
  int samples = 3;  ///< a side of the regular grid of rays through a pixel; 1 is its middle
};

/// Draws a mesh by ray tracing, without GL: the pictures of reports, and the reference of the
/// pictures that GL draws. Immutable after creation, thread safe.
class ReferenceRenderer {
 public:
  /// Fails on attributes of different lengths, indices that point nowhere, numbers that are not
  /// finite, and where Embree fails.
  static Result<ReferenceRenderer> create(ReferenceMesh mesh);

  ReferenceRenderer(ReferenceRenderer&&) noexcept;
  ReferenceRenderer& operator=(ReferenceRenderer&&) noexcept;
  ~ReferenceRenderer();

  /// Radiance, channels R, G, B, A (the share of the pixel that the mesh covers): value x
  /// irradiance / pi (docs/conventions.md), the nearest texel of every ray. Tangent frames are
  /// interpolated, then made orthonormal at each ray, as shaders/tangent_frame.glsl does. Parallel
  /// inside; equal on any number of threads.
  FloatImage render(const ReferenceShot& shot, const ReferenceMaterial& material) const;

 private:
  struct Tracer;
  explicit ReferenceRenderer(std::unique_ptr<const Tracer> tracer);
  std::unique_ptr<const Tracer> tracer_;
};

}  // namespace weft
