// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>
#include <span>
#include <string>

namespace halfspace {

/// Why halfspace-image-tool cannot do what it is asked: one line, what is wrong; what would be right.
struct Failure {
  std::string text;
};

/// A decoder's or encoder's message as a part of one line: OpenImageIO's messages may have several.
inline std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  if (text.size() > 200) text.resize(200);
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.empty() ? "no reason is given" : text;
}

/// Writes a header and what follows it to standard output.
template <class Header>
void put_answer(const Header& header, const std::string& message) {
  std::fwrite(&header, sizeof header, 1, stdout);
  std::fwrite(message.data(), 1, message.size(), stdout);
}

}  // namespace halfspace
