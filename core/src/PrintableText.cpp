#include "weft/core/PrintableText.h"

#include <fmt/format.h>

#include <cstddef>

namespace weft {
namespace {

/// The smallest code point that needs a sequence of so many bytes; shorter ones must not be written
/// so.
constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};

std::size_t sequenceBytes(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

bool isShown(char32_t code) {
  const bool isControl = code < 0x20 || (code >= 0x7f && code < 0xa0);
  const bool isSurrogate = code >= 0xd800 && code < 0xe000;
  return !isControl && !isSurrogate && code <= 0x10ffff;
}

/// Bytes of the character that the text begins with; 0 where it is none that may be shown.
std::size_t shownBytes(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t count = sequenceBytes(first);
  if (count == 0 || count > text.size()) return 0;
  char32_t code = count == 1 ? first : first & (0x7fu >> count);
  for (const char c : text.substr(1, count - 1)) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0u) != 0x80u) return 0;
    code = code << 6 | (byte & 0x3fu);
  }
  return code >= kSmallest[count] && isShown(code) ? count : 0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const std::size_t count = shownBytes(text);
    if (count > 0)
      shown += text.substr(0, count);
    else if (text.front() == '\n' || text.front() == '\r' || text.front() == '\t')
      shown += ' ';
    else
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    text.remove_prefix(count > 0 ? count : 1);
  }
  return shown;
}

}  // namespace weft
