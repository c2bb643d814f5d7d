#include "viewer/app/input_log.h"

#include <gtest/gtest.h>

#include "viewer/platform/key.h"

namespace patchlab::viewer {
namespace {

TEST(InputLog, ReadsEveryKindOfEvent) {
  const auto events = parse_input_log(
      "# a comment\n\nclick tools/Reject outliers\nclick 640 400\nmove 1 2\npress right\nrelease right\n"
      "drag 1 2 3 4 5 6\nwheel -2\nkey Ctrl+Shift+Z\nhold Shift\nhold nothing\ntype mug side\nwait\nkey Enter\n",
      "log");
  ASSERT_TRUE(events) << events.error().message;
  ASSERT_EQ(events->size(), 13u);
  const auto& e = *events;
  EXPECT_EQ(e[0].kind, LogEvent::Kind::click_widget);
  EXPECT_EQ(e[0].text, "tools/Reject outliers");
  EXPECT_EQ(e[0].line, 3);
  EXPECT_EQ(e[1].kind, LogEvent::Kind::click);
  EXPECT_EQ(e[1].places[0].x(), 640);
  EXPECT_EQ(e[3].button, 1);
  EXPECT_EQ(e[5].places.size(), 3u);
  EXPECT_EQ(e[6].notches, -2);
  EXPECT_EQ(e[7].keys, (std::vector<int>{key::left_control, key::left_shift, 'Z'}));
  EXPECT_TRUE(e[9].keys.empty());
  EXPECT_EQ(e[10].text, "mug side");
  EXPECT_EQ(e[12].keys, std::vector<int>{key::enter});
}

TEST(InputLog, NamesTheLineThatIsWrong) {
  for (const char* wrong : {"dance", "move 3", "press up", "key Hyper+Q", "wheel up", "wait 3", "drag 1 2"}) {
    const auto events = parse_input_log(std::string("move 1 2\n") + wrong + "\n", "session.log");
    ASSERT_FALSE(events) << wrong;
    EXPECT_EQ(events.error().code, ErrorCode::unreadable);
    EXPECT_NE(events.error().message.find("session.log, line 2"), std::string::npos)
        << events.error().message;
  }
}

}  // namespace
}  // namespace patchlab::viewer
