// SPDX-License-Identifier: Apache-2.0
//
// Runs the program as a process in a temporary folder. CMake defines HALFSPACE_PROGRAM as the path of the program.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/image/image_io.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {

namespace fs = std::filesystem;

struct Outcome {
  int exit_code = -1;  // −1 if the process was killed by a signal
  int signal = 0;
  std::string out, err;
};

inline int lines_of(const std::string& text) { return static_cast<int>(std::ranges::count(text, '\n')); }

// Runs the program in a temporary directory, which is deleted at the end of the test.
class Cli : public testing::Test {
 protected:
  void SetUp() override { fs::create_directory(directory); }

  pid_t start(const std::vector<std::string>& arguments) const {
    std::vector<std::string> words = {HALFSPACE_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    const std::string out = (root / "out").string(), err = (root / "err").string();
    const pid_t child = ::fork();
    if (child != 0) return child;
    const int o = ::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int e = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (::chdir(directory.c_str()) != 0 || ::dup2(o, STDOUT_FILENO) < 0 || ::dup2(e, STDERR_FILENO) < 0) ::_exit(99);
    std::signal(SIGINT, SIG_DFL);  // shells start background jobs with SIGINT ignored, and the program inherits that
    ::execv(argv[0], argv.data());
    ::_exit(99);
  }

  Outcome finish(pid_t child) const {
    int status = 0;
    ::waitpid(child, &status, 0);
    Outcome o{WIFEXITED(status) ? WEXITSTATUS(status) : -1, WIFSIGNALED(status) ? WTERMSIG(status) : 0, read_bytes(root / "out"),
              read_bytes(root / "err")};
    return o;
  }

  Outcome run(const std::vector<std::string>& arguments) const { return finish(start(arguments)); }

  // environment: variable assignments, as written before a shell command
  Outcome run_in(const std::string& environment, const std::string& arguments) const {
    const std::string command = "cd " + directory.string() + " && " + environment + " " HALFSPACE_PROGRAM " " + arguments + " > " +
                                (root / "out").string() + " 2> " + (root / "err").string();
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, 0, read_bytes(root / "out"), read_bytes(root / "err")};
  }

  // Returns the pixels of an image file. Files with the same pixels differ if they were rendered with different options.
  Image<glm::u8vec4> picture(const std::string& name) const { return read_image(directory / name); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory)) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  const TemporaryFolder folder;
  const fs::path root = folder.path(), directory = root / "here";
};

}  // namespace halfspace
