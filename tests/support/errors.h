// SPDX-License-Identifier: Apache-2.0
//
// Checks error messages. Most tests check only the place and keywords of a message, so that its wording can be improved.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "halfspace/core/check.h"

namespace halfspace {

/// Returns the message of the Error that f throws, or "(no error)".
template <class Error, class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "(no error)";
}
template <class F>
std::string input_error(F&& f) {
  return message_of<InputError>(f);
}
template <class F>
std::string output_error(F&& f) {
  return message_of<OutputError>(f);
}

/// Checks that the message is a single line that begins with the place of the error, such as "a.json: objects.ball.radius", and contains
/// all keywords after it.
inline testing::AssertionResult reports(const std::string& message, const std::string& place, const std::vector<std::string>& keywords) {
  const auto fail = [&] { return testing::AssertionFailure() << "message: " << message << "\n  "; };
  if (message.find('\n') != std::string::npos) return fail() << "has several lines";
  if (!message.starts_with(place)) return fail() << "does not begin with '" << place << "'";
  for (const std::string& word : keywords) {
    if (message.find(word, place.size()) == std::string::npos) return fail() << "does not contain '" << word << "'";
  }
  return testing::AssertionSuccess();
}

}  // namespace halfspace
