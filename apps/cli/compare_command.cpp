// SPDX-License-Identifier: Apache-2.0
//
// `halfspace compare A B`: measures the difference between two images.
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "command_line/arguments.h"
#include "command_line/errors.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_io.h"
#include "halfspace/render/frame/image_comparison.h"
#include "halfspace/render/model_file/input_files.h"

namespace halfspace {

void compare_command(const CompareArguments& args) {
  const double tolerance =
      args.tolerance.empty() ? -1.0 : parse_real("--tolerance", args.tolerance, 0, 1e9, "a difference of 0 or more, for example 0.004");
  if (!args.out.empty()) {
    reject_overwriting(args.out, {args.a, args.b});
    check_writable(args.out);
  }
  const ComparedImage a = read_compared_image(args.a), b = read_compared_image(args.b);
  Image<glm::u8vec4> picture;
  const Comparison c = compare(a, b, args.out.empty() ? nullptr : &picture);
  if (!args.out.empty()) write_png(args.out, picture);
  std::cout << (args.json ? comparison_json(c).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n" : comparison_text(c));
  if (tolerance < 0.0) return;
  if (const std::string problem = excess(c, tolerance, args.tolerance); !problem.empty()) throw DifferenceError(problem);
}

}  // namespace halfspace
