#include "AngleName.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace weft {
namespace {

bool isLowerCaseLetter(char c) {
  return c >= 'a' && c <= 'z';
}

// The number at the beginning of a text; '-' is a sign.
std::optional<double> leadingNumber(std::string text) {
  if (const std::size_t comma = text.find_first_not_of("+-0123456789");
      comma != std::string::npos && text[comma] == ',')
    text[comma] = '.';
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  double number = 0.0;
  const auto [end, error] =
      std::from_chars(begin, text.data() + text.size(), number, std::chars_format::fixed);
  if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
  return number;
}

// The number behind the last occurrence of `tag` that is a word of its own.
std::optional<double> numberAfter(std::string_view tag, std::string_view text) {
  for (std::size_t at = text.rfind(tag); at != std::string_view::npos;
       at = at == 0 ? std::string_view::npos : text.rfind(tag, at - 1)) {
    if (at > 0 && isLowerCaseLetter(text[at - 1])) continue;
    if (const auto number = leadingNumber(std::string(text.substr(at + tag.size())))) return number;
  }
  return std::nullopt;
}

// From 0 to 360; never -0.
double fullCircle(double degrees) {
  const double angle = std::fmod(degrees, 360.0);
  const double positive = angle < 0.0 ? angle + 360.0 : std::abs(angle);
  return positive < 360.0 ? positive : 0.0;  // a tiny negative angle is rounded up
}

std::optional<Angles> anglesAfter(std::string_view thetaTag, std::string_view phiTag, std::string_view text) {
  const auto theta = numberAfter(thetaTag, text);
  const auto phi = numberAfter(phiTag, text);
  if (!theta || !phi || *theta < 0.0 || *theta > 180.0) return std::nullopt;
  if (*theta == 0.0) return Angles{};
  return Angles{*theta, fullCircle(*phi)};
}

}  // namespace

std::optional<AnglePair> anglesFromName(std::string_view baseName) {
  std::string text(baseName);
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const auto light = anglesAfter("tl", "pl", text);
  const auto view = anglesAfter("tv", "pv", text);
  if (!light || !view) return std::nullopt;
  return AnglePair{*light, *view};
}

}  // namespace weft
