// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include "halfspace/image/tool/protocol.h"

namespace halfspace::HS_LANES {

/// The reason why a tool cannot fulfill a request. The text is one line of the form "problem; what was expected".
struct Failure {
  std::string text;
  bool exceeds_limit = false;
};

/// Converts a message of a decoder or encoder, which may span several lines, to part of a single line.
inline std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  if (text.size() > 200) text.resize(200);
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.empty() ? "no reason given" : text;
}

/// Writes a header and the message that follows it to standard output.
template <class Header>
void put_answer(const Header& header, const std::string& message) {
  std::fwrite(&header, sizeof header, 1, stdout);
  std::fwrite(message.data(), 1, message.size(), stdout);
}

/// Answers a request for an image with a message.
inline void report_failure(const Failure& failure) {
  PictureHeader header;
  header.height = failure.exceeds_limit ? 1 : 0;
  header.message_bytes = static_cast<uint32_t>(failure.text.size());
  put_answer(header, failure.text);
}

}  // namespace halfspace::HS_LANES
