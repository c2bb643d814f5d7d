#include "viewer/panel/actions.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace patchlab::viewer {
namespace {

TEST(Actions, EveryActionHasExactlyOneRow) {
  std::set<Action> seen;
  for (const ActionRow& action : action_table())
    EXPECT_TRUE(seen.insert(action.action).second) << action.name;
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(Action::messages) + 1);
}

TEST(Actions, NoTwoActionsShareAKey) {
  std::set<std::tuple<int, bool, bool>> keys;
  for (const ActionRow& action : action_table()) {
    for (const int key : {action.key, action.also}) {
      if (key != 0) {
        EXPECT_TRUE(keys.insert({key, action.ctrl, action.shift}).second) << action.name;
      }
    }
  }
}

TEST(Actions, KeysReadAsPeopleWriteThem) {
  EXPECT_EQ(key_name(row(Action::redo)), "Ctrl+Shift+Z");
  EXPECT_EQ(key_name(row(Action::keep)), "Enter");
  EXPECT_EQ(key_name(row(Action::lasso_tool)), "L");
  EXPECT_EQ(key_name(row(Action::mode_add)), "");
}

TEST(Actions, EveryRowSaysWhatItIsIn) {
  for (const ActionRow& action : action_table()) EXPECT_FALSE(std::string(action.name).empty());
}

}  // namespace
}  // namespace patchlab::viewer
