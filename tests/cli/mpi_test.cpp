// SPDX-License-Identifier: Apache-2.0
//
// `render --mpi`: the processes of mpirun share scenes or frames.
#include <nlohmann/json.hpp>

#include "cli/cli_run.h"
#include "support/sanitized.h"

namespace halfspace {
namespace {

// OpenMPI does not free everything at exit.
constexpr const char* kMpirun = kSanitized ? "ASAN_OPTIONS=detect_leaks=0 mpirun --allow-run-as-root" : "mpirun --allow-run-as-root";

class Mpi : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (!fs::exists(fs::path(HALFSPACE_PROGRAM).parent_path() / "halfspace-mpi.so") ||
        std::system("mpirun --version > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "the program was built without MPI (scripts/install_deps.sh --mpi)";
  }
  Outcome mpirun(int ranks, const std::string& arguments) const {
    const std::string command = "cd " + directory.string() + " && " + kMpirun + " --oversubscribe --bind-to none -n " +
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

}  // namespace
}  // namespace halfspace
