#include "LightListLines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "FilePath.h"
#include "TextEncoding.h"

namespace weft {
namespace {

constexpr int kMostLights = 1000;

bool isBlank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

// Takes the last word off a text.
std::string_view takeLastWord(std::string_view& text) {
  text = trimmed(text);
  std::size_t start = text.size();
  while (start > 0 && !isBlank(text[start - 1])) --start;
  const std::string_view word = text.substr(start);
  text = trimmed(text.substr(0, start));
  return word;
}

// Takes a line off a text, whatever ends it: LF, CR LF or CR.
std::string_view takeLine(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = trimmed(text.substr(0, end));
  const bool isPair = text.substr(end).starts_with("\r\n");
  text.remove_prefix(std::min(end + (isPair ? 2 : 1), text.size()));
  return line;
}

template <class T>
std::optional<T> numberOf(std::string word) {
  if (const std::size_t comma = word.find(',');
      comma != std::string::npos && word.find('.') == std::string::npos)
    word[comma] = '.';
  const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
  T number{};
  const auto [end, error] = std::from_chars(begin, word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

std::optional<double> takeNumber(std::string_view& text) {
  return numberOf<double>(std::string(takeLastWord(text)));
}

// "image.png 0.5" before three numbers: not a name. "coin 12" may be one, without its extension.
bool endsInFourthNumber(std::string_view name) {
  if (!endsInNumber(name)) return false;
  std::string_view rest = name;
  const std::string_view last = takeLastWord(rest);
  while (endsInNumber(rest)) takeLastWord(rest);
  return !extensionOf(rest).empty() || last.find_first_of(".,+-eE") != std::string_view::npos;
}

// "some image.jpg 0.1 -0.2 0.97": names may contain blanks.
Result<ListedLight> parseLine(std::string_view line, std::string where) {
  const auto z = takeNumber(line);
  const auto y = takeNumber(line);
  const auto x = takeNumber(line);
  if (!x || !y || !z || line.empty())
    return fail("an image and the three numbers of its light are expected", std::move(where));
  if (endsInFourthNumber(line))
    return fail("more than the three numbers of a light follow the image", std::move(where),
                "leave out what is not x, y or z: Weft knows no intensities of single lights");
  const double length = glm::length(glm::dvec3(*x, *y, *z));
  if (!(length >= 1e-4 && length < 1e30))
    return fail(fmt::format("({}, {}, {}) is not the direction of a light", *x, *y, *z), std::move(where));
  ListedLight light{std::string(line), {*x, *y, *z}, std::move(where)};
  std::ranges::replace(light.image, '\\', '/');
  return light;
}

Result<int> parseCount(std::string_view line, std::string where) {
  const auto count = numberOf<int>(std::string(line));
  if (!count || *count < 1 || *count > kMostLights)
    return fail(fmt::format("the number of lights is expected, 1 to {}", kMostLights), std::move(where));
  return *count;
}

}  // namespace

bool endsInNumber(std::string_view name) {
  const auto number = numberOf<double>(std::string(takeLastWord(name)));
  return number && std::isfinite(*number);
}

Result<LightListLines> parseLightList(std::string_view bytes, const std::string& where) {
  WEFT_TRY(const std::string decoded, textInUtf8(bytes, where));
  if (decoded.empty()) return fail("the list of lights is empty", where);
  std::string_view text = decoded;
  LightListLines list;
  WEFT_TRY(list.count, parseCount(takeLine(text), where + ", line 1"));
  for (int number = 2; !text.empty(); ++number) {
    const std::string_view line = takeLine(text);
    if (line.empty()) continue;
    WEFT_TRY(ListedLight light, parseLine(line, fmt::format("{}, line {}", where, number)));
    list.lights.push_back(std::move(light));
  }
  return list;
}

}  // namespace weft
