#include "viewer/panel/colours.h"

#include <gtest/gtest.h>

#include "viewer/panel/theme.h"

namespace patchlab::viewer {
namespace {

constexpr double readable = 4.5;  // WCAG 2, AA

TEST(Contrast, IsTwentyOneForBlackOnWhiteAndOneForEqual) {
  EXPECT_NEAR(contrast(rgb(0x000000), rgb(0xFFFFFF)), 21.0, 1e-6);
  EXPECT_DOUBLE_EQ(contrast(rgb(0x123456), rgb(0x123456)), 1.0);
}

class ThemeTest : public testing::TestWithParam<ThemeChoice> {};
INSTANTIATE_TEST_SUITE_P(Both, ThemeTest, testing::Values(ThemeChoice::dark, ThemeChoice::light),
                         [](const auto& choice) {
                           return choice.param == ThemeChoice::dark ? "Dark" : "Light";
                         });

TEST_P(ThemeTest, EveryTextIsReadableOnEveryGroundItLiesOn) {
  const Theme t = theme(GetParam());
  const struct {
    const char* what;
    Rgba text, ground;
  } pairs[] = {
      {"text on view top", t.text, t.view_top},
      {"text on view bottom", t.text, t.view_bottom},
      {"dim on view top", t.text_dim, t.view_top},
      {"dim on view bottom", t.text_dim, t.view_bottom},
      {"text on panel", t.text, t.panel},
      {"dim on panel", t.text_dim, t.panel},
      {"text on bar", t.text, t.bar},
      {"dim on bar", t.text_dim, t.bar},
      {"text on popup", t.text, t.popup},
      {"dim on popup", t.text_dim, t.popup},
      {"text on hover", t.text, t.hover},
      {"dim on hover", t.text_dim, t.hover},
      {"chosen", t.accent_text, t.accent_ground},
      {"text on chosen", t.text, t.accent_ground},
      {"dim on chosen", t.text_dim, t.accent_ground},
      {"accent on panel", t.accent_text, t.panel},
      {"accent on popup", t.accent_text, t.popup},
      {"good", t.good_text, t.good_ground},
      {"text on good", t.text, t.good_ground},
      {"doubt", t.doubt_text, t.doubt_ground},
      {"text on doubt", t.text, t.doubt_ground},
      {"doubt on panel", t.doubt_text, t.panel},
      {"doubt on popup", t.doubt_text, t.popup},
      {"bad", t.bad_text, t.bad_ground},
      {"text on bad", t.text, t.bad_ground},
  };
  for (const auto& pair : pairs) EXPECT_GE(contrast(pair.text, pair.ground), readable) << pair.what;
}

TEST(Sequential, GrowsLighterAllTheWay) {
  double before = contrast(sequential(0.0), rgb(0x000000));
  for (int i = 1; i <= 50; ++i) {
    const double now = contrast(sequential(i / 50.0), rgb(0x000000));
    EXPECT_GT(now, before) << i;
    before = now;
  }
}

TEST(Diverging, IsNeutralAtZeroBlueBelowAndOrangeAbove) {
  const Rgba zero = diverging(0.0, 0.3), below = diverging(-1.0, 0.3), above = diverging(1.0, 0.3);
  EXPECT_NEAR(zero[0], zero[2], 0.01);
  EXPECT_GT(below[2], below[0]);
  EXPECT_GT(above[0], above[2]);
}

TEST(CategoryColour, IsOfTheNumberAndRepeatsAfterSeven) {
  EXPECT_EQ(category_colour("region-1"), category_colour("patch-1"));
  EXPECT_NE(category_colour("region-1"), category_colour("region-2"));
  EXPECT_EQ(category_colour("region-1"), category_colour("region-8"));
}

}  // namespace
}  // namespace patchlab::viewer
