// SPDX-License-Identifier: Apache-2.0
//
// The parts of `halfspace explain`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/commands.h"
#include "explain/pixel_history.h"
#include "halfspace/core/parallel.h"

namespace halfspace {

/// Command lines for the same frame, which can be run in the same folder.
struct ExplainCommands {
  std::string explain;  ///< without --pixel and -o; prints the history of a pixel if "--pixel X,Y --text" is appended
  std::string render;   ///< renders the picture
};

/// The input of `halfspace explain`.
struct ExplainJob {
  const SceneDescription& scene;
  const PreparedScene& prepared;
  std::string title;                ///< the scene as named by the user
  std::optional<glm::ivec2> pixel;  ///< the pixel that the user chose, from the upper left
  ExplainCommands commands;
  std::string lessons;  ///< address of their folder, or empty
  const Workers& workers;
};

/// Returns the history of the selected pixel as text or JSON (explain_history.cpp). The default is the pixel with the most fragments.
std::string explained_history(const ExplainJob& job, bool json);

inline constexpr const char* kExplainSize = "640x360";  ///< default of --size

// The page (explain_page.cpp).
/// Returns the file that the page is written to. Throws UsageError.
std::filesystem::path page_path(const ExplainArguments& args);
ExplainCommands explain_commands(const ExplainArguments& args, double seconds);
/// Returns the page.
std::string page_of(const ExplainJob& job);

}  // namespace halfspace
