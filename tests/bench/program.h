// SPDX-License-Identifier: Apache-2.0
//
// Runs one of the benchmark's programs.
#pragma once

#include <stdlib.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace halfspace::test {

struct Outcome {
  int exit_code;
  std::string text;  ///< what was printed
};

/// streams: what of standard error is kept, as the shell says it.
inline Outcome run_program(const std::string& program, const std::string& arguments, const std::string& streams = "2>&1") {
  std::FILE* pipe = ::popen((program + " " + arguments + " " + streams).c_str(), "r");
  if (pipe == nullptr) return {-1, ""};
  Outcome outcome{};
  std::array<char, 4096> part;
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;) outcome.text.append(part.data(), n);
  const int status = ::pclose(pipe);
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

inline std::vector<nlohmann::json> json_lines_of(const std::string& text) {
  std::vector<nlohmann::json> rows;
  for (const std::string& line : lines_of(text)) rows.push_back(nlohmann::json::parse(line));
  return rows;
}

/// A directory of a test's own, gone with it.
class TemporaryDirectory {
 public:
  TemporaryDirectory() : path_((std::filesystem::temp_directory_path() / "halfspace-bench-XXXXXX").string()) {
    if (::mkdtemp(path_.data()) == nullptr) path_ = "/dev/null";
  }
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace halfspace::test
