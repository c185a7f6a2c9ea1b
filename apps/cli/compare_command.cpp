// SPDX-License-Identifier: Apache-2.0
//
// `halfspace compare A B`: measures the difference between two images.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/errors.h"
#include "cli/input_files.h"
#include "halfspace/core/check.h"
#include "halfspace/core/srgb.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/image_difference.h"
#include "halfspace/image/image_io.h"

namespace halfspace {

namespace {

// The result of a comparison: of linear light if both files are linear, otherwise of 8-bit values.
struct Comparison {
  ImageDifference difference;
  int width, height;
  bool linear;
};

std::string text_report(const CompareArguments& args, const Comparison& c) {
  const ImageDifference& d = c.difference;
  const std::string psnr = std::isinf(d.psnr_db) ? "infinite" : fmt::format("{:.2f} dB", d.psnr_db);
  return fmt::format(
      "{} vs. {}, {}x{}, {}{}\n"
      "differing    {} of {} pixels\n"
      "rmse         {:.6g}\n"
      "mean         {:.6g}\n"
      "psnr         {}\n"
      "max          {:.6g}\n"
      "p99.9        {:.6g}\n"
      "above 1/255  {:.4f} %\n"
      "ssim         {:.6f}\n",
      args.a, args.b, c.width, c.height, c.linear ? "linear light" : "8-bit values / 255", d.channels == 4 ? ", with alpha" : "",
      d.differing, int64_t{c.width} * c.height, d.rmse, d.mean, psnr, d.max, d.p999, 100.0 * d.share_above, d.ssim);
}

std::string json_report(const CompareArguments& args, const Comparison& c) {
  const ImageDifference& d = c.difference;
  nlohmann::ordered_json json = {{"a", args.a},
                                 {"b", args.b},
                                 {"width", c.width},
                                 {"height", c.height},
                                 {"values", c.linear ? "linear" : "codes"},
                                 {"channels", d.channels},
                                 {"differing_pixels", d.differing},
                                 {"rmse", d.rmse},
                                 {"mean", d.mean},
                                 {"psnr_db", nullptr},
                                 {"max", d.max},
                                 {"p999", d.p999},
                                 {"share_above_1_255", d.share_above},
                                 {"ssim", d.ssim}};
  if (!std::isinf(d.psnr_db)) json["psnr_db"] = d.psnr_db;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

template <class Texel>
Comparison compare_files(const CompareArguments& args, const Image<Texel>& a, const Image<Texel>& b) {
  if (a.width() != b.width() || a.height() != b.height()) {
    const auto size = [](const Image<Texel>& i) { return fmt::format("{}x{}", i.width(), i.height()); };
    throw InputError(args.b + ": size is " + size(b) + "; expected " + size(a) + ", the size of " + args.a);
  }
  if (!args.out.empty()) write_png(args.out, difference_colors(difference_map(a, b)));
  return {compare_images(a, b), a.width(), a.height(), std::is_same_v<Texel, glm::vec4>};
}

// Reads an image as 8-bit values. Linear light is encoded as sRGB.
Image<glm::u8vec4> read_codes(const std::string& path, bool linear) {
  if (!linear) return read_image(path);
  const Image<glm::vec4> light = read_linear(path);
  Image<glm::u8vec4> codes(light.width(), light.height());
  std::ranges::transform(light.texels(), codes.data(), [](const glm::vec4& c) {
    return glm::u8vec4(linear_to_srgb(c.x), linear_to_srgb(c.y), linear_to_srgb(c.z), linear_to_unorm8(c.w));
  });
  return codes;
}

}  // namespace

void compare_command(const CompareArguments& args) {
  const double tolerance =
      args.tolerance.empty() ? -1.0 : parse_real("--tolerance", args.tolerance, 0, 1e9, "a difference of 0 or more, for example 0.004");
  if (!args.out.empty()) {
    reject_overwriting(args.out, {args.a, args.b});
    check_writable(args.out);
  }
  const bool a_linear = holds_linear_numbers(args.a), b_linear = holds_linear_numbers(args.b);
  const Comparison c = a_linear && b_linear ? compare_files(args, read_linear(args.a), read_linear(args.b))
                                            : compare_files(args, read_codes(args.a, a_linear), read_codes(args.b, b_linear));
  std::cout << (args.json ? json_report(args, c) : text_report(args, c));
  if (tolerance >= 0.0 && c.difference.max > tolerance) {
    throw DifferenceError(
        fmt::format("{}: differs from {} by {:.6g}; expected at most {}", args.b, args.a, c.difference.max, args.tolerance));
  }
}

}  // namespace halfspace
