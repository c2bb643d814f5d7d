#include "viewer/panel/layout.h"

#include <gtest/gtest.h>

namespace patchlab::viewer {
namespace {

class LayoutTest : public testing::TestWithParam<std::tuple<std::pair<float, float>, float>> {};
std::string window_name(const testing::TestParamInfo<LayoutTest::ParamType>& window) {
  const auto& [size, scale] = window.param;
  return std::to_string(static_cast<int>(size.first)) + "x" + std::to_string(static_cast<int>(size.second)) +
         "_at_" + std::to_string(static_cast<int>(100 * scale)) + "_percent";
}

INSTANTIATE_TEST_SUITE_P(SizesAndScales, LayoutTest,
                         testing::Combine(testing::Values(std::pair{640.f, 480.f}, std::pair{1280.f, 800.f},
                                                          std::pair{1440.f, 900.f},
                                                          std::pair{3840.f, 2160.f}),
                                          testing::Values(1.0f, 1.25f, 1.5f, 2.0f)),
                         window_name);

TEST_P(LayoutTest, ThePanelsTileTheWindow) {
  const auto [size, scale] = GetParam();
  const Layout layout = make_layout(size.first, size.second, scale);
  double area = 0;
  for (const Rect& rect :
       {layout.menu, layout.tools, layout.tree, layout.inspector, layout.status, layout.view}) {
    EXPECT_GE(rect.x, 0);
    EXPECT_GE(rect.y, 0);
    EXPECT_LE(rect.right(), size.first);
    EXPECT_LE(rect.bottom(), size.second);
    area += static_cast<double>(rect.width) * rect.height;
  }
  EXPECT_DOUBLE_EQ(area, static_cast<double>(size.first) * size.second);
}

TEST_P(LayoutTest, ThePanelsAreAsWideAsTheyWereDraggedWhereThereIsRoom) {
  const auto [size, scale] = GetParam();
  const Layout layout = make_layout(size.first, size.second, scale, {200.0f, 300.0f});
  EXPECT_LE(layout.tree.width, 200.0f * scale);
  EXPECT_LE(layout.inspector.width, 300.0f * scale);
  if (size.first > 1000 * scale) {
    EXPECT_EQ(layout.inspector.width, 300.0f * scale);
  }
}

TEST_P(LayoutTest, TheViewAloneFillsTheWindow) {
  const auto [size, scale] = GetParam();
  const Layout layout = make_layout(size.first, size.second, scale, {.side_panels = false, .bars = false});
  EXPECT_EQ(layout.view.width, size.first);
  EXPECT_EQ(layout.view.height, size.second);
}

TEST_P(LayoutTest, TheViewKeepsAThirdOfTheWidth) {
  const auto [size, scale] = GetParam();
  EXPECT_GE(make_layout(size.first, size.second, scale).view.width, size.first / 3);
}

}  // namespace
}  // namespace patchlab::viewer
