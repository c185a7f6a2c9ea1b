// SPDX-License-Identifier: Apache-2.0
//
// `halfspace chart STUDY|all`: measures error and time of rendering methods; writes data files, charts and an HTML page.
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "cli/charting.h"
#include "cli/commands.h"
#include "command_line/arguments.h"
#include "command_line/errors.h"
#include "halfspace/core/parallel.h"
#include "halfspace/core/text.h"
#include "halfspace/image/atomic_output.h"
#include "study/study_files.h"

namespace halfspace {

namespace {

std::vector<StudyEntry> chosen_studies(const std::string& name) {
  std::vector<StudyEntry> all = studies();
  if (name == "all") return all;
  std::vector<std::string_view> names{"all"};
  for (const StudyEntry& s : all) {
    if (s.name == name) return {s};
    names.push_back(s.name);
  }
  throw UsageError("unknown study '" + name + "'" + suggestion(name, names));
}

}  // namespace

void chart_command(const ChartArguments& args) {
  const std::vector<StudyEntry> chosen = chosen_studies(args.study);
  const Workers workers(parse_threads(args.threads));
  const std::filesystem::path folder = args.out;
  make_directory(folder);
  check_writable(folder / "index.html");
  const std::string command = "halfspace chart " + args.study + (args.quick ? " --quick" : "");
  std::vector<std::string> names;
  for (const StudyEntry& entry : chosen) {
    write_data(entry.run({args.quick}, workers), command, args.quick, workers, folder);
    names.emplace_back(entry.name);
    std::cout << entry.name << ": " << (folder / entry.name).string() << ".json" << std::endl;
  }
  std::cout << draw_or_explain(names, folder);
  write_index(folder);  // shows the charts that exist
  std::cout << (folder / "index.html").string() << '\n';
}

std::string study_lines() {
  std::string text;
  std::size_t width = 80;
  for (const StudyEntry& s : studies()) {
    if (width + s.name.size() + 1 >= 76) {
      text += "\n ";
      width = 1;
    }
    text += " ";
    text += s.name;
    width += s.name.size() + 1;
  }
  return text;
}

}  // namespace halfspace
