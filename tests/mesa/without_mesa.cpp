// SPDX-License-Identifier: Apache-2.0
//
// Stands for all of tests/mesa where what they need was absent when this was built.
#include <gtest/gtest.h>

TEST(Mesa, Comparison) {
  GTEST_SKIP() << "not compared with Mesa: built without libepoxy or EGL's headers (Debian and Ubuntu: libegl-dev libepoxy-dev)";
}
