// SPDX-License-Identifier: Apache-2.0
#include "view/actions.h"

#include <gtest/gtest.h>

#include <set>

namespace halfspace {
namespace {

TEST(ViewActions, EveryActionHasOneKey) {
  std::set<Action> actions;
  std::set<std::string_view> keys;
  for (const KeyBinding& b : key_bindings()) {
    EXPECT_TRUE(actions.insert(b.action).second) << b.key;
    EXPECT_TRUE(keys.insert(b.key).second) << b.key;
    EXPECT_FALSE(b.help.empty()) << b.key;
  }
  EXPECT_EQ(actions.size(), kActions);
}

TEST(ViewActions, KeyNamesMatchSdl) {
  EXPECT_EQ(action_of("W"), Action::forward);
  EXPECT_EQ(action_of("F12"), Action::save);
  EXPECT_EQ(action_of("Space"), Action::pause);
  EXPECT_EQ(action_of("["), Action::darker);
  EXPECT_EQ(action_of("F1"), std::nullopt);
  EXPECT_EQ(action_of(""), std::nullopt);
}

TEST(ViewActions, OnlyMovementsRepeatWhileAKeyIsHeld) {
  EXPECT_TRUE(is_movement(Action::forward));
  EXPECT_TRUE(is_movement(Action::pitch_down));
  EXPECT_FALSE(is_movement(Action::reset_camera));
}

}  // namespace
}  // namespace halfspace
