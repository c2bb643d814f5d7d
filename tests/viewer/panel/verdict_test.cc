#include <gtest/gtest.h>

#include "viewer/panel/panels.h"

namespace patchlab::viewer {
namespace {

TEST(SentencesOf, AreReasonsThenWarningsEachOnce) {
  FitReport report;
  report.reasons = {{"chi_square", 0, 0, "The residuals are too large."}};
  report.warnings = {{"few_points", 0, 0, "Only 12 points."},
                     {"chi_square", 0, 0, "Residuals 3 times larger than the noise model."},
                     {"other", 0, 0, "The residuals are too large."},
                     {"near_singular", 0, 0, "About the frame."}};
  EXPECT_EQ(sentences_of(report),
            (std::vector<std::string>{"The residuals are too large.", "Only 12 points."}));
}

}  // namespace
}  // namespace patchlab::viewer
