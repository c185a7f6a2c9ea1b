// SPDX-License-Identifier: Apache-2.0
//
// Tests the start-up check on the actual machine. The tested program consists of start_check.cpp and cpu.cpp. It is built to require SSE3,
// which every processor supports, and FMA4 and XOP, which no processor since 2017 supports. A separate test uses an emulator
// (Cli.ReportsAnUnsupportedProcessorInOneLine).
#include <gtest/gtest.h>

#include <string>

#include "support/errors.h"
#include "support/program.h"

namespace halfspace {
namespace {

TEST(StartCheck, ReportsMissingFeaturesInOneLine) {
  const ProgramOutput output = run_command(HALFSPACE_UNSUPPORTED_PROCESSOR_PROGRAM " 2>&1");
  const std::string& said = output.text;
  EXPECT_EQ(output.exit_code, 1);
  ASSERT_TRUE(said.ends_with('\n')) << said;
  EXPECT_TRUE(reports(said.substr(0, said.size() - 1), "halfspace: ", {"this build needs", "FMA4", "XOP", "processor"}));
  EXPECT_EQ(said.find("SSE3"), std::string::npos) << said << "every processor supports SSE3";
}

}  // namespace
}  // namespace halfspace
