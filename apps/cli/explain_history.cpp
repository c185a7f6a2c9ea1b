// SPDX-License-Identifier: Apache-2.0
//
// The history of a pixel as text and as JSON.
#include "cli/explain_command.h"

namespace halfspace {

std::string history_text(const ExplainJob&) { return {}; }
std::string history_json(const ExplainJob&) { return {}; }

}  // namespace halfspace
