#include "weft/io/FileName.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

// "Münze Ärger" as one character a letter, and with the dots as characters of their own.
constexpr const char* kComposed = "M\u00fcnze \u00c4rger.JPG";
constexpr const char* kDecomposed = "Mu\u0308nze A\u0308rger.JPG";

TEST(FileName, IsTheSameInEveryNormalForm) {
  EXPECT_STRNE(kComposed, kDecomposed);
  EXPECT_EQ(composedName(kDecomposed), kComposed);
  EXPECT_EQ(composedName(kComposed), kComposed);
  EXPECT_EQ(composedName("\uac00"), composedName("\u1100\u1161")) << "Hangul";
}

TEST(FileName, FoldedIsTheSameInUpperAndLowerCase) {
  EXPECT_EQ(foldedName(kDecomposed), "m\u00fcnze \u00e4rger.jpg");
  EXPECT_EQ(foldedName("IMG_1.PNG"), foldedName("img_1.png"));
  EXPECT_NE(foldedName("img_1.png"), foldedName("img_2.png"));
}

TEST(FileName, ThatIsNotUtf8StaysAsItIs) {
  EXPECT_EQ(composedName("M\xfcnze"), "M\xfcnze");
  EXPECT_EQ(foldedName("M\xfcnze"), "M\xfcnze");
  EXPECT_EQ(foldedName(""), "");
}

}  // namespace
}  // namespace weft
