// SPDX-License-Identifier: Apache-2.0
//
// Helpers that run the programs of the benchmark.
#pragma once

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/program.h"
#include "support/temporary_folder.h"

namespace halfspace::test {

using Outcome = ProgramOutput;

/// Runs a program. `streams` is a shell redirection that determines how standard error is captured.
inline Outcome run_program(const std::string& program, const std::string& arguments, const std::string& streams = "2>&1") {
  return run_command(program + " " + arguments + " " + streams);
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

}  // namespace halfspace::test
