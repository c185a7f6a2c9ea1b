// SPDX-License-Identifier: Apache-2.0
//
// Replaces tests/mesa if its dependencies were not found at build time.
#include <gtest/gtest.h>

TEST(Mesa, IsCompared) {
  GTEST_SKIP() << "not compared with Mesa: built without libepoxy or the EGL headers (Debian and Ubuntu: libegl-dev libepoxy-dev)";
}
