// SPDX-License-Identifier: Apache-2.0
#include "cli/charting.h"

#include "halfspace/core/cpu.h"
#include "halfspace/study/study_files.h"

namespace halfspace {

bool write_charted(const Study& study, const std::string& command, bool quick, const Workers& workers,
                   const std::filesystem::path& folder) {
  write_study(study, {command, std::string("halfspace " HALFSPACE_VERSION ", ") + build_description(), workers.threads(), quick}, folder);
  return draw_chart(study.name, folder);
}

}  // namespace halfspace
