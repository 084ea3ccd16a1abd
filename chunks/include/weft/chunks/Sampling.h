#pragma once

#include <optional>

namespace weft {

enum class TextureFilter { Nearest, Linear, Mipmapped };

/// What lies beyond the edges.
enum class TextureWrap { Clamp, Repeat, Mirror };

/// How the values between texels, and beyond the edges, come about.
struct Sampling {
  TextureFilter filter = TextureFilter::Nearest;  ///< parameters must not be blended unasked
  TextureWrap wrap = TextureWrap::Clamp;          ///< the only one that every shape has
  std::optional<TextureWrap> wrapV{};             ///< along v, where that is another
  /// Nearest or Linear, where `filter` is for reduction alone
  std::optional<TextureFilter> magnification{};

  bool operator==(const Sampling&) const = default;
};

}  // namespace weft
