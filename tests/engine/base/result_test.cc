#include "engine/base/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "engine/base/progress.h"

namespace patchlab::test {
namespace {

Result<int> half(int number) {
  if (number % 2 != 0) return Error{ErrorCode::usage, "An odd number has no half."};
  return number / 2;
}

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> good = half(4), bad = half(3);
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, 2);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::usage);
  EXPECT_EQ(bad.error().message, "An odd number has no half.");
}

TEST(Result, GivesUpAValueThatCanOnlyBeMoved) {
  Result<std::unique_ptr<int>> held(std::make_unique<int>(7));
  const std::unique_ptr<int> taken = *std::move(held);
  EXPECT_EQ(*taken, 7);
}

TEST(Result, AStringValueIsNotMistakenForAnError) {
  const Result<std::string> text(std::string("fine"));
  ASSERT_TRUE(text.ok());
  EXPECT_EQ(text->size(), 4u);
}

TEST(Result, OfNothingIsGoodByDefault) {
  EXPECT_TRUE(Result<void>());
  const Result<void> bad(Error{ErrorCode::refused, "No."});
  EXPECT_FALSE(bad);
  EXPECT_EQ(bad.error().message, "No.");
}

TEST(Result, ErrorsHaveTheExitStatusOfTheContract) {
  EXPECT_EQ(exit_status(ErrorCode::refused), 1);
  EXPECT_EQ(exit_status(ErrorCode::cancelled), 1);
  EXPECT_EQ(exit_status(ErrorCode::usage), 2);
  EXPECT_EQ(exit_status(ErrorCode::unreadable), 3);
  EXPECT_EQ(exit_status(ErrorCode::no_finite_fit), 3);
  EXPECT_EQ(exit_status(ErrorCode::unwritable), 4);
}

TEST(Progress, NobodyListeningMeansGoOn) { EXPECT_TRUE(keep_going({}, 0.5)); }

TEST(Progress, ReportsTheFractionAndPassesTheAnswerOn) {
  double told = -1.0;
  const Progress stop_at_half = [&](double fraction) {
    told = fraction;
    return fraction < 0.5;
  };
  EXPECT_TRUE(keep_going(stop_at_half, 0.25));
  EXPECT_EQ(told, 0.25);
  EXPECT_FALSE(keep_going(stop_at_half, 0.5));
}

}  // namespace
}  // namespace patchlab::test
