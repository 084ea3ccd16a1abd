#include "AngleName.h"

#include <charconv>
#include <cmath>

namespace weft {
namespace {

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

// The number behind the last occurrence of `tag` that is a word of its own.
std::optional<double> numberAfter(std::string_view tag, std::string_view text) {
  for (std::size_t at = text.rfind(tag); at != std::string_view::npos;
       at = at == 0 ? std::string_view::npos : text.rfind(tag, at - 1)) {
    const std::string_view rest = text.substr(at + tag.size());
    if ((at > 0 && isLetter(text[at - 1])) || rest.empty() || !isDigit(rest.front())) continue;
    double number = 0.0;
    const auto [end, error] =
        std::from_chars(rest.data(), rest.data() + rest.size(), number, std::chars_format::fixed);
    if (error == std::errc()) return number;
  }
  return std::nullopt;
}

std::optional<Angles> anglesAfter(std::string_view thetaTag, std::string_view phiTag, std::string_view text) {
  const auto theta = numberAfter(thetaTag, text);
  const auto phi = numberAfter(phiTag, text);
  if (!theta || !phi || *theta > 90.0) return std::nullopt;
  return Angles{*theta, *theta == 0.0 ? 0.0 : std::fmod(*phi, 360.0)};
}

}  // namespace

std::optional<AnglePair> anglesFromName(std::string_view baseName) {
  const auto light = anglesAfter("tl", "pl", baseName);
  const auto view = anglesAfter("tv", "pv", baseName);
  if (!light || !view) return std::nullopt;
  return AnglePair{*light, *view};
}

}  // namespace weft
