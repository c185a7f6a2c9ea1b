// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool/radiance_header.h"

#include <cstddef>

namespace halfspace::HS_LANES {

int radiance_orientation(std::string_view file) {
  const std::size_t end = file.find("\n\n");  // an empty line ends the header
  if (end == std::string_view::npos) return 1;
  std::string_view line = file.substr(end + 2);
  line = line.substr(0, line.find('\n'));
  const std::size_t second = line.find_first_of("+-", 1);  // the resolution string is "SIGN AXIS number SIGN AXIS number"
  if (second == std::string_view::npos || second + 1 >= line.size()) return 1;
  const bool columns = line[1] == 'X';  // scanlines are columns of the picture
  const char x_sign = columns ? line[0] : line[second], y_sign = columns ? line[second] : line[0];
  const bool from_right = x_sign == '-', from_bottom = y_sign == '+';
  if (columns) return from_bottom ? (from_right ? 7 : 8) : (from_right ? 6 : 5);
  return from_bottom ? (from_right ? 3 : 4) : (from_right ? 2 : 1);
}

}  // namespace halfspace::HS_LANES
