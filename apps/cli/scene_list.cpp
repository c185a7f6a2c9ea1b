// SPDX-License-Identifier: Apache-2.0
#include "cli/scene_list.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>

#include "halfspace/core/check.h"

namespace halfspace {

std::vector<std::string> read_scenes(std::vector<std::string> given, const std::string& list) {
  if (list.empty()) return given;
  const std::string name = list == "-" ? "standard input" : list;
  std::ifstream file;
  if (list != "-") file.open(list);
  std::istream& lines = list == "-" ? std::cin : file;
  const auto fail = [&](const std::string& problem) -> void { throw InputError("--list: " + name + problem); };
  if (!lines) fail(std::string(": cannot be read (") + std::strerror(errno) + "); expected a file with one scene or model per line");
  const std::size_t before = given.size();
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (!line.empty()) given.push_back(line);
  }
  if (lines.bad()) fail(": cannot be read; expected a file with one scene or model per line");
  if (given.size() == before) fail(" has no scenes; expected one scene or model per line");
  return given;
}

}  // namespace halfspace
