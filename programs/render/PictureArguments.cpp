#include "PictureArguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <optional>

namespace weft {
namespace {

constexpr int kLargestSide = 8192;
constexpr double kLargestExposure = 60.0;

/// The number that `text` is, and nothing else.
std::optional<int> wholeNumber(const std::string& text) {
  int number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<int> sideFrom(const std::string& text) {
  const std::optional<int> side = wholeNumber(text);
  return side && *side >= 1 && *side <= kLargestSide ? side : std::nullopt;
}

/// "--size WxH", "--size W H" or "--size N", a square, which may have taken the SCENE behind it
/// along; none for anything else.
std::optional<PictureArguments::Size> readSize(std::vector<std::string> words, std::string& scene) {
  if (const std::size_t cross = words[0].find('x'); cross != std::string::npos) {
    words.insert(words.begin() + 1, words[0].substr(cross + 1));
    words[0].resize(cross);
  } else if (words.size() == 1 || (words.size() == 2 && scene.empty() && !sideFrom(words[1]))) {
    words.insert(words.begin(), words[0]);
  }
  if (words.size() == 3 && scene.empty()) scene = words[2];
  if (words.size() < 2 || (words.size() == 3 && scene != words[2])) return std::nullopt;
  const auto width = sideFrom(words[0]), height = sideFrom(words[1]);
  if (!width || !height) return std::nullopt;
  return PictureArguments::Size{*width, *height};
}

}  // namespace

void PictureArguments::addTo(CLI::App& options) {
  options.add_option("--size", size, "WxH, W H or N for a square, in pixels")
      ->expected(1, 3)
      ->capture_default_str();
  options.add_option("--exposure", exposure, "stops: the picture is multiplied by 2 to their power")
      ->capture_default_str();
  options
      .add_option("--tone-map", toneMap,
                  "none, or soft: what is brighter than 0.8 is compressed below 1; default: soft for a "
                  "picture of 8 bits with --env, else none")
      ->check(CLI::IsMember({"none", "soft"}));
}

tl::expected<PictureArguments::Size, std::string> PictureArguments::parse(std::string& scene) const {
  const std::optional<Size> read = readSize(size, scene);
  if (!read)
    return tl::unexpected(
        fmt::format("--size takes WxH, W H or N for a square, 1 to {} pixels", kLargestSide));
  if (!(std::abs(exposure) <= kLargestExposure))
    return tl::unexpected(fmt::format("--exposure takes -{0} to {0} stops", kLargestExposure));
  return *read;
}

ToneCurve PictureArguments::toneCurve(bool softUnasked) const {
  return toneMap == "soft" || (toneMap.empty() && softUnasked) ? ToneCurve::Soft : ToneCurve::None;
}

}  // namespace weft
