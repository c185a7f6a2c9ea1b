// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/check.h"

namespace halfspace::detail {

void check_failed(const char* file, int line, const char* text, const std::string& left, const std::string& right) {
  std::fprintf(stderr, "%s:%d: check failed: %s", file, line, text);
  if (!left.empty()) std::fprintf(stderr, " (%s against %s)", left.c_str(), right.c_str());
  std::fputc('\n', stderr);
  std::abort();
}

}  // namespace halfspace::detail
