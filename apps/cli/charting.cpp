// SPDX-License-Identifier: Apache-2.0
#include "cli/charting.h"

#include "halfspace/core/cpu.h"
#include "study/study_files.h"

namespace halfspace {

void write_data(const Study& study, const std::string& command, bool quick, const Workers& workers, const std::filesystem::path& folder) {
  write_study(study, {command, std::string("halfspace " HALFSPACE_VERSION ", ") + build_description(), workers.threads(), quick}, folder);
}

std::string draw_or_explain(const std::vector<std::string>& names, const std::filesystem::path& folder) {
  const std::string missing = draw_charts(names, folder);
  return missing.empty() ? "" : "no charts were drawn: " + missing + "; the data files were written\n";
}

}  // namespace halfspace
