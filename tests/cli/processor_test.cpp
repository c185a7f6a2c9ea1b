// SPDX-License-Identifier: Apache-2.0
//
// The check at the program's start, on the machine itself: a program of start_check.cpp and cpu.cpp alone is said to need
// FMA4 and XOP, which no processor since 2017 has, beside what every one has. An emulator of a lesser processor has a
// test of its own (Cli.ALesserProcessorIsToldInOneLine).
#include <gtest/gtest.h>

#include <string>

#include "support/errors.h"
#include "support/program.h"

namespace halfspace {
namespace {

TEST(StartCheck, SaysInOneLineWhatTheProcessorLacks) {
  const ProgramOutput output = run_command(HALFSPACE_LESSER_PROGRAM " 2>&1");
  const std::string& said = output.text;
  EXPECT_EQ(output.exit_code, 1);
  ASSERT_TRUE(said.ends_with('\n')) << said;
  EXPECT_TRUE(tells(said.substr(0, said.size() - 1), "halfspace: ", {"this build needs", "FMA4", "XOP", "processor"}));
  EXPECT_EQ(said.find("SSE3"), std::string::npos) << said << "which every processor has";
}

}  // namespace
}  // namespace halfspace
