// SPDX-License-Identifier: Apache-2.0
#include "messages.h"

#include <string_view>
#include <utility>

#include "halfspace/core/text.h"

namespace halfspace::python {

namespace {

// Phrases and their replacements. A phrase that begins with another one comes before it.
constexpr std::pair<std::string_view, std::string_view> kPhrases[] = {
    {"use --allow-outside to allow it", "pass allow_outside=True to allow it"},
    {"use --allow-outside", "pass allow_outside=True to allow it"},
    {"or --allow-outside", "or allow_outside=True"},
    {"use --animation to select another", "pass animation= to select another"},
    {" (--max-memory)", ""},
    {" (--max-pixels)", ""},
    {" (--max-primitives)", ""},
};

// Starts of messages about arguments, and their replacements.
constexpr std::pair<std::string_view, std::string_view> kPlaces[] = {
    {"--set: ", ""},
    {"--scene: ", "model_scene: "},
    {"--animation: ", "animation: "},
    {"--variant: ", "variant: "},
    {"--environment: ", "environment: "},
    {"--eye: ", "eye: "},
    {"--look-at: ", "look_at: "},
    {"--up: ", "up: "},
};

}  // namespace

std::string in_python_terms(std::string message) {
  for (const auto& [place, replacement] : kPlaces) {
    if (message.starts_with(place)) {
      message.replace(0, place.size(), replacement);
      break;
    }
  }
  for (const auto& [phrase, replacement] : kPhrases) {
    if (const std::size_t at = message.rfind(phrase); at != std::string::npos) message.replace(at, phrase.size(), replacement);
  }
  return printable(message);  // Python decodes messages as UTF-8, and names from files may not be valid
}

}  // namespace halfspace::python
