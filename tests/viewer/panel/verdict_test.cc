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

Candidate candidate(SurfaceType surface, double bic, bool chosen = false) {
  Candidate made;
  made.surface = surface;
  made.bic = bic;
  made.chosen = chosen;
  return made;
}

TEST(ChoiceWords, SayByHowMuchTheChosenSurfaceIsAheadAndWhy) {
  std::vector<Candidate> candidates = {candidate(SurfaceType::sphere, 100, true),
                                       candidate(SurfaceType::plane, 119)};
  EXPECT_EQ(choice_words(candidates), "The least BIC, 19 ahead of plane.");
  candidates[1].reason = "chi-square is 24 higher";
  EXPECT_EQ(choice_words(candidates), "The least BIC, 19 ahead of plane: chi-square is 24 higher.");
}

TEST(ChoiceWords, SayWhereTheLeadIsNarrow) {
  EXPECT_EQ(choice_words({candidate(SurfaceType::sphere, 100, true), candidate(SurfaceType::plane, 101)}),
            "A narrow lead on plane.");
}

TEST(ChoiceWords, AreNoneForASingleCandidate) {
  EXPECT_EQ(choice_words({candidate(SurfaceType::sphere, 100, true)}), "");
}

}  // namespace
}  // namespace patchlab::viewer
