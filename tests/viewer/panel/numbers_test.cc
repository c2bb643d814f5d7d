#include "viewer/panel/numbers.h"

#include <gtest/gtest.h>

namespace patchlab::viewer {
namespace {

TEST(Measured, IsGivenToTheSecondDigitOfItsStandardDeviation) {
  const Measured radius = measured(0.0612034, 0.000211, Dimension::length);
  EXPECT_EQ(radius.value, "61.20 mm");
  EXPECT_EQ(radius.sigma, "± 0.21 mm");
  const Measured kappa = measured(-16.3402, 0.0561, Dimension::curvature);
  EXPECT_EQ(kappa.value, "−16.340 1/m");
  EXPECT_EQ(kappa.sigma, "± 0.056 1/m");
}

TEST(Measured, ChangesItsUnitWithItsSize) {
  EXPECT_EQ(measured(1.5, 0.01, Dimension::length).value, "1.500 m");
  EXPECT_EQ(measured(0.7853981634, 0.01, Dimension::angle).value, "45.00 °");
  EXPECT_EQ(sigma_text(0.0034, Dimension::angle), "± 3.4 mrad");
  EXPECT_EQ(sigma_text(0.52, Dimension::angle), "± 30 °");
}

TEST(Measured, GivesTheStandardDeviationInTheUnitOfTheValueUnlessItIsTinyThere) {
  EXPECT_EQ(measured(49.39, 0.6, Dimension::length).sigma, "± 0.60 m");
  EXPECT_EQ(measured(1.5, 0.00002, Dimension::length).sigma, "± 0.020 mm");
}

TEST(Duration, IsInMillisecondsBelowASecond) {
  EXPECT_EQ(duration(0.0009), "0.90 ms");
  EXPECT_EQ(duration(30.3), "30 s");
}

TEST(Measured, AnExactNumberIsGivenToThreeDecimals) {
  EXPECT_EQ(measured(0.05, 0.0, Dimension::length).value, "50.000 mm");
}

TEST(Fixed, HasATrueMinusSignAndNoNegativeZero) {
  EXPECT_EQ(fixed(-1.25, 1), "−1.2");
  EXPECT_EQ(fixed(-0.001, 2), "0.00");
}

TEST(Count, IsGroupedInThrees) {
  EXPECT_EQ(count(0), "0");
  EXPECT_EQ(count(999), "999");
  EXPECT_EQ(count(1284), "1,284");
  EXPECT_EQ(count(307200), "307,200");
  EXPECT_EQ(count(12345678), "12,345,678");
  EXPECT_EQ(short_count(307200), "307k");
  EXPECT_EQ(short_count(5'000'000), "5.0M");
}

TEST(SizeWords, TakesTheUnitThatFits) {
  EXPECT_EQ(size_words(1200), "1.2 kB");
  EXPECT_EQ(size_words(127'400'000), "127 MB");
  EXPECT_EQ(size_words(1'540'000'000), "1.5 GB");
}

TEST(PValue, SaysWhenItIsTinyInsteadOfZero) {
  EXPECT_EQ(p_value_text(0.41), "p 0.41");
  EXPECT_EQ(p_value_text(0.004), "p 0.004");
  EXPECT_EQ(p_value_text(1e-30), "p < 0.001");
}

TEST(Quantity, KeepsTheDigitsAskedFor) {
  EXPECT_EQ(quantity(0.1, Dimension::length, 1), "100 mm");
  EXPECT_EQ(quantity(2.0, Dimension::length, 1), "2 m");
  EXPECT_EQ(quantity(0.00123, Dimension::length, 2), "1.2 mm");
}

}  // namespace
}  // namespace patchlab::viewer
