#include "weft/core/Result.h"

#include <gtest/gtest.h>

#include <memory>

#include "weft/core/Contract.h"

namespace weft {
namespace {

Result<int> half(int value) {
  if (value % 2 != 0) return fail("odd", std::to_string(value), "give an even number");
  return value / 2;
}

Result<int> quarter(int value) {
  WEFT_TRY(const int once, half(value));
  WEFT_TRY(const int twice, half(once));
  return twice;
}

Result<void> checkQuarter(int value) {
  WEFT_TRY_VOID(quarter(value));
  return {};
}

Result<std::unique_ptr<int>> onTheHeap(int value) {
  // moved, never copied
  WEFT_TRY(auto number, Result<std::unique_ptr<int>>(std::make_unique<int>(value)));
  return number;
}

TEST(Result, MessagesHoldWhatWhereAndHint) {
  EXPECT_EQ((Error{"the image is truncated", "a.png", "copy it again"}).message(),
            "a.png: the image is truncated (copy it again)");
  EXPECT_EQ((Error{"the image is truncated", "a.png", ""}).message(), "a.png: the image is truncated");
  EXPECT_EQ((Error{"no views", "", "measure some"}).message(), "no views (measure some)");
  EXPECT_EQ((Error{"no views", "", ""}).message(), "no views");
}

TEST(Result, TryPassesValuesOn) {
  const Result<int> result = quarter(12);
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, 3);
  EXPECT_TRUE(checkQuarter(12));
  EXPECT_EQ(**onTheHeap(5), 5);
}

TEST(Result, TryPassesTheFirstFailureOn) {
  for (const int value : {7, 6}) {
    const Result<int> result = quarter(value);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message(),
              value == 7 ? "7: odd (give an even number)" : "3: odd (give an even number)");
    const Result<void> check = checkQuarter(value);
    ASSERT_FALSE(check);
    EXPECT_EQ(check.error().message(), result.error().message());
  }
}

TEST(ContractDeathTest, EndsTheProgramWithAMessage) {
  WEFT_EXPECT(true, "nothing happens");
  EXPECT_DEATH(WEFT_EXPECT(1 + 1 == 3, "sums are right"),
               "ResultTest.cpp:[0-9]+: contract broken: sums are right");
}

}  // namespace
}  // namespace weft
