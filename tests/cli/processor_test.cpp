// SPDX-License-Identifier: Apache-2.0
//
// Tests the start-up check. The tested programs processor-LEVEL consist of start_check.cpp and cpu.cpp and need what a build for LEVEL
// needs. processor-none needs SSE3, which every processor supports, and FMA4 and XOP, which no processor since 2017 supports. The features
// of other processors come from an emulator (package qemu-user), whose /proc/cpuinfo is that of this machine.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/errors.h"
#include "support/program.h"

namespace halfspace {
namespace {

constexpr const char* kReached = "main was reached\n";

// Runs processor-LEVEL on an emulated processor. The result contains the features that it reports as missing.
ProgramOutput run_on(const std::string& processor, const std::string& level) {
  const std::string program = HALFSPACE_PROCESSOR_PROGRAMS + level;
  return run_command("qemu-x86_64 -cpu " + processor + " " + program + " 2>&1 | grep -v \"TCG doesn't support requested feature\"");
}

TEST(StartCheck, ReportsMissingFeaturesInOneLine) {
  const ProgramOutput output = run_command(HALFSPACE_PROCESSOR_PROGRAMS "none 2>&1");
  const std::string& said = output.text;
  EXPECT_EQ(output.exit_code, 1);
  ASSERT_TRUE(said.ends_with('\n')) << said;
  EXPECT_TRUE(reports(said.substr(0, said.size() - 1), "halfspace: ", {"this build needs", "FMA4", "XOP", "processor"}));
  EXPECT_EQ(said.find("SSE3"), std::string::npos) << said << "every processor supports SSE3";
}

TEST(StartCheck, AcceptsProcessorsWithAllFeatures) {
  if (!command_works("qemu-x86_64 --version")) GTEST_SKIP() << "qemu-x86_64 (package qemu-user) is absent";
  for (const char* processor : {"Haswell", "EPYC", "Skylake-Server", "Broadwell"}) {
    EXPECT_EQ(run_on(processor, "v3").text, kReached) << processor;
  }
  EXPECT_EQ(run_on("Nehalem", "v2").text, kReached);
}

// x86-64-v3 includes these, but our code does not contain them.
TEST(StartCheck, DoesNotNeedLzcntOrMovbe) {
  if (!command_works("qemu-x86_64 --version")) GTEST_SKIP() << "qemu-x86_64 (package qemu-user) is absent";
  EXPECT_EQ(run_on("Haswell,-abm", "v3").text, kReached);
  EXPECT_EQ(run_on("Haswell,-movbe", "v3").text, kReached);
}

TEST(StartCheck, NamesWhatEachProcessorLacks) {
  if (!command_works("qemu-x86_64 --version")) GTEST_SKIP() << "qemu-x86_64 (package qemu-user) is absent";
  struct Case {
    const char *processor, *level, *missing;
  };
  const std::vector<Case> cases = {
      {"qemu64", "v2", "SSSE3, SSE4.1, SSE4.2, POPCNT"},
      {"Nehalem", "v3", "BMI1, BMI2, AVX, F16C, FMA, AVX2"},
      {"SandyBridge", "v3", "BMI1, BMI2, F16C, FMA, AVX2"},
      {"Opteron_G5", "v3", "BMI1, BMI2, AVX2"},
      {"Haswell,-bmi2", "v3", "BMI2"},
      {"Haswell,-fma", "v3", "FMA"},
      // AVX is present, but the operating system does not save its registers.
      {"Haswell,-xsave", "v3", "AVX, F16C, FMA, AVX2"},
      {"Haswell", "v4", "AVX-512 (F, BW, DQ, VL, CD)"},
  };
  for (const auto& [processor, level, missing] : cases) {
    const std::string said = run_on(processor, level).text;
    EXPECT_TRUE(said.starts_with(std::string("halfspace: this build needs ") + missing + ", which this processor does not support; "))
        << said;
    EXPECT_EQ(said.find('\n'), said.size() - 1) << said;
  }
}

}  // namespace
}  // namespace halfspace
