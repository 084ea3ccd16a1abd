#include "weft/core/PrintableText.h"

#include <gtest/gtest.h>

#include "weft/core/Result.h"

namespace weft {
namespace {

TEST(PrintableText, KeepsUtf8) {
  for (const char* text : {"", "wool.rf.exr", "Müller/布.png", "\U0001f9f6 (\"a\", 'b')"})
    EXPECT_EQ(printable(text), text);
}

TEST(PrintableText, IsOneLine) {
  EXPECT_EQ(printable("a\nb\r\tc"), "a b  c");
}

TEST(PrintableText, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(printable("\x1b[2J"), "\\x1b[2J");
  EXPECT_EQ(printable(std::string_view("\0\x7f", 2)), "\\x00\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // the one-byte CSI, as UTF-8
}

TEST(PrintableText, EscapesWhatIsNotUtf8) {
  EXPECT_EQ(printable("\xff\xd8"), "\\xff\\xd8");
  EXPECT_EQ(printable("\xc3"), "\\xc3");           // cut off
  EXPECT_EQ(printable("\xc3("), "\\xc3(");         // continued by something else
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");  // '/' in two bytes
  EXPECT_EQ(printable("\xe0\x80\xaf"), "\\xe0\\x80\\xaf");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond Unicode
}

TEST(PrintableText, MessagesOfErrorsAre) {
  const Error error{"the part '\x1b]0;\xfe' is unknown", "a\nb.exr", "\x07"};
  EXPECT_EQ(error.message(), "a b.exr: the part '\\x1b]0;\\xfe' is unknown (\\x07)");
}

}  // namespace
}  // namespace weft
