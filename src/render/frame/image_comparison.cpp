// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/frame/image_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "halfspace/core/check.h"
#include "halfspace/core/srgb.h"
#include "halfspace/image/image_io.h"

namespace halfspace::HS_LANES {

namespace {

using Codes = Image<glm::u8vec4>;
using LinearLight = Image<glm::vec4>;

Codes encoded(const LinearLight& light) {
  Codes codes(light.width(), light.height());
  std::ranges::transform(light.texels(), codes.data(), [](const glm::vec4& c) {
    return glm::u8vec4(linear_to_srgb(c.x), linear_to_srgb(c.y), linear_to_srgb(c.z), linear_to_unorm8(c.w));
  });
  return codes;
}

template <class Texel>
Comparison compare_texels(const std::string& name_a, const Image<Texel>& a, const std::string& name_b, const Image<Texel>& b,
                          Codes* difference) {
  if (a.width() != b.width() || a.height() != b.height()) {
    const auto size = [](const Image<Texel>& i) { return fmt::format("{}x{}", i.width(), i.height()); };
    throw InputError(name_b + ": size is " + size(b) + "; expected " + size(a) + ", the size of " + name_a);
  }
  if (difference != nullptr) *difference = difference_colors(difference_map(a, b));
  return {name_a, name_b, compare_images(a, b), a.width(), a.height(), std::is_same_v<Texel, glm::vec4>};
}

}  // namespace

ComparedImage read_compared_image(const std::string& file) {
  if (holds_linear_numbers(file)) return {file, read_linear(file)};
  return {file, read_image(file)};
}

Comparison compare(const ComparedImage& a, const ComparedImage& b, Codes* difference) {
  const auto *light_a = std::get_if<LinearLight>(&a.image), *light_b = std::get_if<LinearLight>(&b.image);
  if (light_a != nullptr && light_b != nullptr) return compare_texels(a.name, *light_a, b.name, *light_b, difference);
  const Codes from_a = light_a != nullptr ? encoded(*light_a) : Codes(), from_b = light_b != nullptr ? encoded(*light_b) : Codes();
  return compare_texels(a.name, light_a != nullptr ? from_a : std::get<Codes>(a.image), b.name,
                        light_b != nullptr ? from_b : std::get<Codes>(b.image), difference);
}

std::string comparison_text(const Comparison& c) {
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
      c.a, c.b, c.width, c.height, c.linear ? "linear light" : "8-bit values / 255", d.channels == 4 ? ", with alpha" : "", d.differing,
      int64_t{c.width} * c.height, d.rmse, d.mean, psnr, d.max, d.p999, 100.0 * d.share_above, d.ssim);
}

nlohmann::ordered_json comparison_json(const Comparison& c) {
  const ImageDifference& d = c.difference;
  nlohmann::ordered_json json = {{"a", c.a},
                                 {"b", c.b},
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
  return json;
}

std::string excess(const Comparison& c, double tolerance, const std::string& expected) {
  if (!(c.difference.max > tolerance)) return {};
  return fmt::format("{}: differs from {} by {:.6g}; expected at most {}", c.b, c.a, c.difference.max, expected);
}

}  // namespace halfspace::HS_LANES
