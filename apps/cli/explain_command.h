// SPDX-License-Identifier: Apache-2.0
//
// The parts of `halfspace explain`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "halfspace/core/parallel.h"
#include "halfspace/explain/pixel_history.h"

namespace halfspace {

/// What `halfspace explain` explains.
struct ExplainJob {
  const SceneDescription& scene;
  const PreparedScene& prepared;
  std::string title;                ///< the scene as named by the user
  std::optional<glm::ivec2> pixel;  ///< the pixel that the user chose, from the upper left
  std::string command;              ///< command line that shows the history of a pixel if "--pixel X,Y --text" is appended
  const Workers& workers;
};

/// Returns the history of the chosen or busiest pixel as text or JSON (explain_history.cpp).
std::string explained_history(const ExplainJob& job, bool json);

inline constexpr const char* kExplainSize = "640x360";  ///< default of --size

// The page (explain_page.cpp).
/// Returns the file that the page is written to. Throws UsageError.
std::filesystem::path page_path(const ExplainArguments& args);
/// Returns the command line that explains the same frame, without the pixel and the output.
std::string explain_command_line(const ExplainArguments& args, double seconds);
/// Returns the page.
std::string page_of(const ExplainJob& job);

}  // namespace halfspace
