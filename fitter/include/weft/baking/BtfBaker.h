#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "weft/baking/HeightField.h"
#include "weft/core/Result.h"

namespace weft {

/// The 81 directions of UBO2003, used for views and lights alike, sorted by polar angle, then
/// azimuth.
std::vector<glm::vec3> ubo2003Directions();

/// How a height field is turned into a BTF.
struct BakeOptions {
  int width = 64;  ///< texels across one period of the height field
  int height = 64;
  /// paths a texel and view, stratified over the texel; the default leaves edges smooth
  int samples = 4;
  int bounces = 1;  ///< interreflections; one carries most of the light in a groove
  /// unit, at most 85 degrees from the normal
  std::vector<glm::vec3> views = ubo2003Directions();
  std::vector<glm::vec3> lights = ubo2003Directions();  ///< likewise

  Result<void> validate() const;
};

/// Ray-traces a BTF from a periodic height field, as a gonioreflectometer would measure it after
/// rectification (docs/baking.md).
///
/// A texel of view v shows what is seen of the surface along the line of direction v through the
/// texel's place in the plane z = 0. Immutable after creation, thread safe.
class BtfBaker {
 public:
  /// Builds the ray-tracing structure; keeps a copy of the field. Fails on options out of range, on
  /// a field that reflects more than it receives or is too steep for its period, and where Embree
  /// fails.
  static Result<BtfBaker> create(HeightField field, BakeOptions options);

  BtfBaker(BtfBaker&&) noexcept;
  BtfBaker& operator=(BtfBaker&&) noexcept;
  ~BtfBaker();

  const BakeOptions& options() const;

  /// One view under every light: `out[light][row][column][rgb]`, linear, radiance x pi / irradiance
  /// with the light's irradiance taken across its beam, so that a flat white Lambertian surface
  /// gives light.z. Parallel inside; equal on any number of threads.
  void bakeView(int view, std::span<float> out) const;

 private:
  struct Tracer;
  explicit BtfBaker(std::unique_ptr<Tracer> tracer);
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace weft
