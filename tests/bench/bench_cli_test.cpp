// SPDX-License-Identifier: Apache-2.0
//
// The command line of halfspace-bench. CMake defines HALFSPACE_BENCH_PROGRAM as the path of the program.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/program.h"
#include "support/errors.h"

namespace halfspace {

namespace {

namespace fs = std::filesystem;

using test::lines_of;
using test::Outcome;

Outcome bench(const std::string& arguments) { return test::run_program(HALFSPACE_BENCH_PROGRAM, arguments); }

struct Mistake {
  std::string arguments, place;
  std::vector<std::string> keywords;
};
class BenchMistake : public testing::TestWithParam<Mistake> {};

TEST_P(BenchMistake, IsReportedInOneLine) {
  const Outcome outcome = bench(GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  ASSERT_TRUE(outcome.text.ends_with('\n')) << outcome.text;
  EXPECT_TRUE(reports(outcome.text.substr(0, outcome.text.size() - 1), "halfspace-bench: " + GetParam().place, GetParam().keywords));
}

INSTANTIATE_TEST_SUITE_P(
    All, BenchMistake,
    testing::Values(Mistake{"--only fil", "--only", {"'fil'", "'fill'"}},
                    Mistake{"--sweep overdrew", "--sweep", {"'overdrew'", "'overdraw'"}},
                    Mistake{"--scenes --matrix", "--scenes", {"--matrix"}}, Mistake{"--scenes --sweep overdraw", "--scenes", {"--sweep"}},
                    Mistake{"--model a.glb --scenes", "--model", {"--scenes"}}, Mistake{"--scenes --views", "--views", {"--scenes"}},
                    Mistake{"--matrix --sweep overdraw", "--matrix", {"--sweep"}}, Mistake{"--size 0x4", "--size", {"'0x4'", "WxH"}},
                    Mistake{"--threads 0", "--threads", {"'0'", "1 to 1024"}}, Mistake{"--seconds -1", "--seconds", {"'-1'", "0 to 3600"}},
                    Mistake{"--sise 4x4", "unknown option", {"'--sise'", "'--size'"}},
                    Mistake{"--only fill tiny_1m", "unexpected argument", {"'tiny_1m'", "--help"}},
                    Mistake{"fill", "unexpected argument", {"'fill'", "--help"}}));

TEST(BenchCli, HelpFitsOnAScreenAndEndsWithTwoExamples) {
  const Outcome outcome = bench("--help");
  EXPECT_EQ(outcome.exit_code, 0);
  const std::vector<std::string> lines = lines_of(outcome.text);
  ASSERT_GE(lines.size(), 3u);
  EXPECT_LE(lines.size(), 24u);
  for (const std::string& line : lines) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_TRUE(lines[lines.size() - 2].starts_with("  halfspace-bench ")) << outcome.text;
  EXPECT_TRUE(lines[lines.size() - 1].starts_with("  halfspace-bench ")) << outcome.text;
}

TEST(BenchCli, ReportsFilesThatAreNotModels) {
  const Outcome missing = bench("--model nothing.glb --seconds 0 --json"), text = bench("--model nothing.txt --seconds 0 --json");
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_NE(missing.text.find("nothing.glb"), std::string::npos) << missing.text;
  EXPECT_EQ(text.exit_code, 3);
  EXPECT_NE(text.text.find("expected .glb"), std::string::npos) << text.text;
}

TEST(BenchCli, JsonHasOneLinePerWorkload) {
  const Outcome outcome = bench("--only layers_f2b,fill --size 64x32 --threads 2 --seconds 0 --json");
  EXPECT_EQ(outcome.exit_code, 0);
  const std::vector<std::string> lines = lines_of(outcome.text);
  ASSERT_EQ(lines.size(), 2u) << outcome.text;
  EXPECT_EQ(nlohmann::json::parse(lines[0]).at("workload"), "fill");  // in the order of the table
  for (const std::string& line : lines) {
    const nlohmann::json row = nlohmann::json::parse(line);
    EXPECT_EQ(row.at("size"), "64x32");
    EXPECT_EQ(row.at("threads"), 2);
    EXPECT_EQ(row.at("frames"), 1);
    EXPECT_GT(row.at("ms"), 0.0);
    EXPECT_LE(row.at("ms_min"), row.at("ms"));
    EXPECT_LE(row.at("ms"), row.at("ms_max"));
    EXPECT_GE(row.at("cpu_ms"), 0.0);
    EXPECT_FALSE(row.contains("frames_mb"));  // only reported for a single workload
  }
}

TEST(BenchCli, ReportsTheMemoryOfASingleWorkload) {
  const auto megabytes = [](const std::string& name) {
    const Outcome outcome = bench("--only " + name + " --size 64x64 --threads 1 --seconds 0 --json");
    EXPECT_EQ(outcome.exit_code, 0);
    return nlohmann::json::parse(outcome.text).at("frames_mb").get<double>();
  };
  // Three million vertices of 17 bytes each; some of them can reuse memory freed by preparation. A cleared 64x64 image needs almost no
  // memory.
  EXPECT_GE(megabytes("tiny_1m"), megabytes("clear") + 25);
}

TEST(BenchCli, EveryRoundRendersAFrame) {
  const Outcome outcome = bench("--only fill --size 16x16 --threads 1 --seconds 0.01 --json");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_GE(nlohmann::json::parse(outcome.text).at("frames"), 5);  // five rounds of at least one frame each
}

TEST(BenchCli, WritesImagesToTheOutputFolder) {
  const TemporaryFolder directory;
  const std::string name = directory.path().string();
  const Outcome outcome = bench("--only fill,layers_f2b --size 64x32 --seconds 0 --out " + name + "/new");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_TRUE(fs::exists(fs::path(name) / "new/fill.png"));
  EXPECT_TRUE(fs::exists(fs::path(name) / "new/layers_f2b.png"));
  EXPECT_TRUE(fs::exists(fs::path(name) / "new/layers_f2b.depth.exr"));
  EXPECT_FALSE(fs::exists(fs::path(name) / "new/fill.depth.exr"));
  EXPECT_EQ(bench("--only fill --size 4x4 --seconds 0 --out /dev/null/x").exit_code, 4);
}

TEST(BenchCli, ChecksImagesOnRequest) {
  const TemporaryFolder truths;
  for (const char* sweep : {"", "--sweep overdraw "}) {
    const std::string only = *sweep != 0 ? "overdraw=2" : "layers_b2f";
    const Outcome outcome = bench(sweep + ("--only " + only) + " --size 64x32 --seconds 0 --json --check " + truths.path().string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    const nlohmann::json row = nlohmann::json::parse(outcome.text);
    EXPECT_EQ(row.at("workload"), only);
    EXPECT_EQ(row.at("picture").at("covered"), 64 * 32);
    EXPECT_EQ(row.at("picture").at("colors_off"), 0);
    EXPECT_TRUE(fs::exists(truths.path().string() + "/" + only + ".64x32.truth"));
  }
}

TEST(BenchCli, ListNamesEveryWorkload) {
  const Outcome outcome = bench("--list");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(lines_of(outcome.text).size(), 25u);
  EXPECT_EQ(lines_of(bench("--scenes --list").text).size(), 15u);
  EXPECT_EQ(lines_of(bench("--views --list").text).size(), 6u);
}

}  // namespace

}  // namespace halfspace
