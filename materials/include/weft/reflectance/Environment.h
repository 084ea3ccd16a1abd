#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"

namespace weft {

/// Light that arrives from all directions, infinitely far away: an equirectangular picture of
/// linear radiance, in which a surface of radiance 1 shows 1.
///
/// Row 0 is straight up (+Y, as in glTF), the middle column lies along -Z, to which a glTF camera
/// looks, and columns to the right of it towards +X. All values are finite and not negative.
/// Immutable, thread safe.
class Environment {
 public:
  /// From an image with channels R, G, B, or one channel for grey. NaN and negative values become
  /// 0, infinite and huge ones the brightest of the others (at most kBrightest); `warnings` gets a
  /// line for each such kind, and where the width is not twice the height, in which case the image
  /// is stretched. Fails on other channels.
  static Result<Environment> create(const FloatImage& image, std::vector<std::string>& warnings);

  /// One that needs no file: "studio" (a dark room with three softboxes) or "sky" (a low sun in a
  /// clear sky above dark ground). Fails on other names.
  static Result<Environment> builtin(std::string_view name);
  static std::vector<std::string> builtinNames();
  /// The same radiance from everywhere.
  static Environment constant(glm::vec3 radiance);

  static constexpr float kBrightest = 1e8f;

  /// `[row][column][R, G, B]`.
  const FloatImage& image() const { return image_; }
  int width() const { return image_.width(); }
  int height() const { return image_.height(); }
  glm::vec3 texel(int x, int y) const {
    const auto rgb = image_.texel(x, y);
    return {rgb[0], rgb[1], rgb[2]};
  }
  /// The direction of a texel's middle; and of any place of the image, 0..1 along its sides.
  glm::vec3 direction(int x, int y) const;
  static glm::vec3 direction(glm::vec2 place);
  /// The inverse.
  static glm::vec2 place(glm::vec3 direction);
  /// Steradians of a texel of a row, exact.
  double solidAngle(int y) const;
  /// Smaller, at most so large, by averages over solid angle; equal where it is small already.
  Environment reduced(int width, int height) const;
  /// Where it has fewer than 64 columns: bilinearly enlarged, so that texels, which sums take for
  /// points, are small beside every lobe.
  Environment enlarged() const;
  /// Between the middles of texels; places of `place()`.
  glm::vec3 bilinear(glm::vec2 place) const;

 private:
  explicit Environment(FloatImage image) : image_(std::move(image)) {}

  FloatImage image_;
};

}  // namespace weft
