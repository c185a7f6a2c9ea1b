// SPDX-License-Identifier: Apache-2.0
//
// `render --mpi`: the processes of mpirun share scenes or frames.
#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "cli/cli_run.h"
#include "mpi/rank_threads.h"
#include "support/sanitized.h"

namespace halfspace {
namespace {

// OpenMPI does not free everything at exit, and takes two of its own locks in both orders.
constexpr const char* kMpirun =
    kSanitized ? "ASAN_OPTIONS=detect_leaks=0 TSAN_OPTIONS=detect_deadlocks=0 mpirun --allow-run-as-root" : "mpirun --allow-run-as-root";

class Mpi : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (!fs::exists(fs::path(HALFSPACE_PROGRAM).parent_path() / "halfspace-mpi.so") ||
        std::system("mpirun --version > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "the program was built without MPI (scripts/install_deps.sh --mpi)";
  }
  // options: of mpirun
  Outcome mpirun(int ranks, const std::string& arguments, const std::string& options = "") const {
    const std::string command = "cd " + directory.string() + " && " + kMpirun + " --oversubscribe --bind-to none " + options + " -n " +
                                std::to_string(ranks) + " " HALFSPACE_PROGRAM " render " + arguments + " --mpi > " +
                                (root / "out").string() + " 2> " + (root / "err").string();
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, 0, read_bytes(root / "out"), read_bytes(root / "err")};
  }
};

TEST_F(Mpi, RanksGiveTheFilesOfOneProcess) {
  const std::string frames = "moon --size 48x27 --frames 0..8 -o ";
  EXPECT_EQ(run_in("", "render " + frames + "one/m.png").exit_code, 0);
  for (const int ranks : {1, 3}) {
    const std::string out = std::to_string(ranks);
    const Outcome o = mpirun(ranks, frames + out + "/m.png --resume");
    EXPECT_EQ(o.exit_code, 0) << o.err;
    EXPECT_NE(o.err.find("kept 0 pictures, rendered 9: 9 missing"), std::string::npos) << o.err;
    for (int i = 0; i < 9; ++i) {
      const std::string name = "m_000" + std::to_string(i) + ".png";
      EXPECT_EQ(read_bytes(directory / out / name), read_bytes(directory / "one" / name)) << name;
    }
  }
}

TEST_F(Mpi, EachRankCountsThePicturesOfAllRanks) {
  const Outcome o = mpirun(2, "moon --size 48x27 --frames 0..39 -o m.png --progress json", "--tag-output");
  EXPECT_EQ(o.exit_code, 0) << o.err;
  std::istringstream lines(o.err);
  std::map<std::string, int> own, done;  // of each rank: its lines, and the count in the last one
  for (std::string line; std::getline(lines, line);) {
    const std::size_t brace = line.find('{');
    ASSERT_NE(brace, std::string::npos) << line;
    const std::string rank = line.substr(0, brace);
    const nlohmann::json picture = nlohmann::json::parse(line.substr(brace));
    EXPECT_EQ(picture.at("total"), 40);
    ++own[rank], done[rank] = picture.at("done").get<int>();
  }
  ASSERT_EQ(own.size(), 2u) << o.err;
  int sum = 0, most = 0;
  for (const auto& [rank, count] : own) {
    sum += count;
    most = std::max(most, done[rank]);
    EXPECT_GT(done[rank], count) << rank << " knows nothing of the other";
    EXPECT_LE(done[rank], 40);
  }
  EXPECT_EQ(sum, 40);
  // When the last number is handed out, the other rank is at its last picture.
  EXPECT_GE(most, 39);
}

TEST_F(Mpi, OneBarCountsThePicturesOfAllRanks) {
  if (std::system("script --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "script (util-linux) is absent";
  // `script` gives mpirun a terminal. The ranks write to a pipe, which mpirun reads.
  const std::string command = "cd " + directory.string() + " && script -qec '" + kMpirun +
                              " --oversubscribe --bind-to none -n 2 " HALFSPACE_PROGRAM
                              " render moon --size 48x27 --frames 0..39 -o m.png --mpi' /dev/null < /dev/null > " +
                              (root / "out").string() + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string shown = read_bytes(root / "out");
  const std::regex bar("\\[#*\\.*\\] ([0-9]+)/40  [0-9.e+]+/s  [0-9:]+ left"), start("\\] 0/40");
  int last = 0;
  for (std::sregex_iterator found(shown.begin(), shown.end(), bar), end; found != end; ++found) last = std::stoi((*found)[1]);
  EXPECT_GE(last, 37) << shown;  // rank 0 may not see the last pictures of the other one
  EXPECT_EQ(std::distance(std::sregex_iterator(shown.begin(), shown.end(), start), std::sregex_iterator()), 1) << shown;
}

TEST_F(Mpi, RanksShareAList) {
  std::string list;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    write_bytes(directory / (name + std::string(".obj")), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    list += name + std::string(".obj\n");
  }
  write_bytes(directory / "list.txt", list + "missing.obj\n");
  const Outcome o = mpirun(2, "--list list.txt --size 32x18 -o '{name}.png' --report report.json");
  EXPECT_EQ(o.exit_code, 3);
  EXPECT_NE(o.err.find("halfspace: missing.obj"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("1 of 6 scenes failed"), std::string::npos) << o.err;
  const nlohmann::json report = nlohmann::json::parse(read_bytes(directory / "report.json"));
  EXPECT_EQ(report.at("scenes").size(), 6u) << "of all ranks";
  EXPECT_EQ(report.at("failed"), 1);
  EXPECT_TRUE(fs::exists(directory / "a.png") && fs::exists(directory / "e.png"));
}

TEST_F(Mpi, WrongArgumentsEndAllRanks) {
  for (const char* arguments :
       {"moon -o a.png", "moon --frames 0..1 -o a.gif", "moon --frames 0..1 -o a.png --shard 0/2", "--list - -o '{name}.png'"}) {
    const Outcome o = mpirun(2, arguments);
    EXPECT_EQ(o.exit_code, 2) << arguments;
    EXPECT_NE(o.err.find("halfspace: --mpi cannot be combined with"), std::string::npos) << o.err;
  }
}

TEST_F(Mpi, ARankWithTooFewCpusWarns) {
  if (::sysconf(_SC_NPROCESSORS_ONLN) < 2) GTEST_SKIP() << "this machine has one CPU";
  const std::string command = "cd " + directory.string() + " && " + kMpirun +
                              " --bind-to core -n 1 " HALFSPACE_PROGRAM
                              " render moon --size 16x9 --frames 0..1 -o m.png --mpi --threads 2 2> " +
                              (root / "err").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_NE(read_bytes(root / "err").find("rank 0 is bound to 1 CPU, but has 2 threads; expected mpirun --bind-to none"),
            std::string::npos);
}

TEST(MpiThreads, RanksShareTheCpusOfTheirNode) {
  EXPECT_EQ(threads_of_rank({.own = 8, .sum = 8, .all = 8, .ranks = 1}, 0), 8);
  EXPECT_EQ(threads_of_rank({.own = 8, .sum = 32, .all = 8, .ranks = 4}, 0), 2) << "not bound";
  EXPECT_EQ(threads_of_rank({.own = 2, .sum = 8, .all = 8, .ranks = 4}, 0), 2) << "bound";
  EXPECT_EQ(threads_of_rank({.own = 1, .sum = 4, .all = 2, .ranks = 4}, 0), 1) << "more ranks than CPUs";
}

TEST(MpiThreads, RanksShareTheQuotaOfTheirNode) {
  EXPECT_EQ(threads_of_rank({.own = 64, .sum = 64, .all = 64, .ranks = 1}, 4), 4);
  EXPECT_EQ(threads_of_rank({.own = 64, .sum = 256, .all = 64, .ranks = 4}, 4), 1) << "not bound";
  EXPECT_EQ(threads_of_rank({.own = 16, .sum = 64, .all = 64, .ranks = 4}, 4), 1) << "bound";
  EXPECT_EQ(threads_of_rank({.own = 16, .sum = 64, .all = 64, .ranks = 4}, 2), 1) << "less than one CPU per rank";
  EXPECT_EQ(threads_of_rank({.own = 2, .sum = 8, .all = 8, .ranks = 4}, 100), 2) << "more than the node has";
}

}  // namespace
}  // namespace halfspace
