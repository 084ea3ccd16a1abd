#include "TextEncoding.h"

#include <utf8proc.h>

#include <array>
#include <cstdint>

namespace weft {
namespace {

bool isUtf8(std::string_view text) {
  while (!text.empty()) {
    utf8proc_int32_t character = 0;
    const auto* bytes = reinterpret_cast<const utf8proc_uint8_t*>(text.data());
    const utf8proc_ssize_t size =
        utf8proc_iterate(bytes, static_cast<utf8proc_ssize_t>(text.size()), &character);
    if (size <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(size));
  }
  return true;
}

void append(std::string& text, std::uint32_t character) {
  std::array<utf8proc_uint8_t, 4> bytes{};
  const utf8proc_ssize_t size = utf8proc_encode_char(static_cast<utf8proc_int32_t>(character), bytes.data());
  text.append(bytes.begin(), bytes.begin() + size);
}

std::uint32_t unitAt(std::string_view bytes, std::size_t at, bool isBigEndian) {
  const auto first = static_cast<std::uint8_t>(bytes[at]);
  const auto second = static_cast<std::uint8_t>(bytes[at + 1]);
  return isBigEndian ? first << 8 | second : second << 8 | first;
}

Result<std::string> fromUtf16(std::string_view bytes, bool isBigEndian, const std::string& where) {
  std::string text;
  for (std::size_t at = 2; at < bytes.size(); at += 2) {
    const bool isWhole = at + 2 <= bytes.size();
    std::uint32_t character = isWhole ? unitAt(bytes, at, isBigEndian) : 0xdc00;
    if (character >= 0xd800 && character < 0xdc00 && at + 4 <= bytes.size()) {
      const std::uint32_t low = unitAt(bytes, at + 2, isBigEndian);
      if (low >= 0xdc00 && low < 0xe000) {
        character = 0x10000 + ((character - 0xd800) << 10) + (low - 0xdc00);
        at += 2;
      }
    }
    if (character >= 0xd800 && character < 0xe000)
      return fail("the UTF-16 text is damaged", where + ", byte " + std::to_string(at));
    append(text, character);
  }
  return text;
}

}  // namespace

Result<std::string> textInUtf8(std::string_view bytes, const std::string& where) {
  if (bytes.starts_with("\xff\xfe")) return fromUtf16(bytes, false, where);
  if (bytes.starts_with("\xfe\xff")) return fromUtf16(bytes, true, where);
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  return nameInUtf8(bytes);
}

std::string nameInUtf8(std::string_view name) {
  if (isUtf8(name)) return std::string(name);
  std::string text;
  for (const char c : name) append(text, static_cast<std::uint8_t>(c));
  return text;
}

}  // namespace weft
