// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_samples.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/half.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/core/srgb.h"

namespace halfspace::HS_LANES {

namespace {

// Returns an image of the converted texels.
template <class To, class From, class F>
Image<To> map_texels(const Image<From>& from, F&& convert) {
  Image<To> to(from.width(), from.height());
  for (std::size_t i = 0; i < from.texels().size(); ++i) to.data()[i] = convert(from.data()[i]);
  return to;
}

[[noreturn]] void fail_at(std::size_t texel, int width, const char* what, const std::string& name) {
  const std::size_t columns = static_cast<std::size_t>(width);
  throw InputError(fmt::format("{}: contains {} at pixel ({}, {}), counted from 0 at the top left; expected finite numbers", name, what,
                               texel % columns, texel / columns));
}

Image<float> numbers(const Image<uint8_t>& codes, const std::string&) {
  return map_texels<float>(codes, [](uint8_t c) { return static_cast<float>(c) / 255.0f; });
}
Image<float> numbers(const Image<uint16_t>& codes, const std::string&) {
  return map_texels<float>(codes, [](uint16_t c) { return static_cast<float>(c) / 65535.0f; });
}
Image<float> numbers(Image<float>&& image, const std::string& name) {
  for (std::size_t i = 0; i < image.texels().size(); ++i) {
    const float x = image.data()[i];
    if (!std::isfinite(x)) fail_at(i, image.width(), std::isnan(x) ? "NaN" : "an infinity", name);
  }
  return std::move(image);
}

// decode(c/65535) of core/srgb.h to within about one ulp. Multiples of 257 give the same results as the corresponding 8-bit values.
std::vector<float> make_srgb16_to_linear() {
  std::vector<float> table(65536);
  for (std::size_t c = 0; c < table.size(); ++c) {
    const float v = static_cast<float>(c) / 65535.0f;
    table[c] = v <= 0.04045f ? v / 12.92f : pow((v + 0.055f) / 1.055f, 2.4f);
  }
  for (std::size_t c = 0; c < kSrgbToLinear.size(); ++c) table[257 * c] = kSrgbToLinear[c];
  return table;
}

Image<glm::vec4> linear(const Image<glm::u8vec4>& codes, bool, const std::string&) {
  return map_texels<glm::vec4>(codes, [](const glm::u8vec4& c) {
    return glm::vec4(kSrgbToLinear[c.x], kSrgbToLinear[c.y], kSrgbToLinear[c.z], static_cast<float>(c.w) / 255.0f);
  });
}
Image<glm::vec4> linear(const Image<glm::u16vec4>& codes, bool, const std::string&) {
  static const std::vector<float> kTable = make_srgb16_to_linear();
  return map_texels<glm::vec4>(
      codes, [](const glm::u16vec4& c) { return glm::vec4(kTable[c.x], kTable[c.y], kTable[c.z], static_cast<float>(c.w) / 65535.0f); });
}
Image<glm::vec4> linear(Image<glm::vec4>&& image, bool premultiplied, const std::string& name) {
  const auto clamped = [](float x) { return std::isinf(x) ? std::copysign(kMaxHalf, x) : x; };
  for (std::size_t i = 0; i < image.texels().size(); ++i) {
    glm::vec4& t = image.data()[i];
    for (int c = 0; c < 4; ++c) {
      if (std::isnan(t[c])) fail_at(i, image.width(), "NaN", name);
      t[c] = clamped(t[c]);
    }
    const float divisor = premultiplied && t.w > 0.0f ? t.w : 1.0f;
    for (int c = 0; c < 3; ++c) t[c] = clamped(t[c] / divisor);
  }
  return std::move(image);
}

}  // namespace

Image<glm::u8vec4> round_to_8_bits(const Image<glm::u16vec4>& wide) {
  return map_texels<glm::u8vec4>(wide, [](const glm::u16vec4& t) {
    glm::u8vec4 codes;
    for (int c = 0; c < 4; ++c) codes[c] = static_cast<uint8_t>((t[c] * 255u + 32767u) / 65535u);
    return codes;
  });
}

GrayPicture first_channel(const ColorPicture& picture) {
  return std::visit(
      [](const auto& image) -> GrayPicture {
        using Channel = std::remove_cvref_t<decltype(image.data()->x)>;
        return map_texels<Channel>(image, [](const auto& texel) { return texel.x; });
      },
      picture);
}

Image<float> to_numbers(GrayPicture picture, const std::string& name) {
  const FloatMode float_mode;
  return std::visit([&](auto&& image) { return numbers(std::move(image), name); }, std::move(picture));
}

Image<glm::vec4> to_linear(ColorPicture picture, bool premultiplied, const std::string& name) {
  const FloatMode float_mode;
  return std::visit([&](auto&& image) { return linear(std::move(image), premultiplied, name); }, std::move(picture));
}

TextureImage to_texels(ColorPicture picture, ImageUse use, bool premultiplied, const std::string& name) {
  if (auto* codes = std::get_if<Image<glm::u8vec4>>(&picture)) return std::move(*codes);
  const auto* wide = std::get_if<Image<glm::u16vec4>>(&picture);
  if (wide == nullptr || use == ImageUse::colors) return to_linear(std::move(picture), premultiplied, name);
  const FloatMode float_mode;
  return map_texels<glm::vec4>(*wide, [](const glm::u16vec4& c) { return glm::vec4(c) / 65535.0f; });
}

Image<glm::u16vec4> to_codes16(const Image<glm::vec4>& numbers, ImageUse use) {
  const FloatMode float_mode;
  const auto encoded = [use](float x) {
    if (use == ImageUse::data) return x;
    return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
  };
  const auto code = [](float x) { return static_cast<uint16_t>(x * 65535.0f + 0.5f); };
  return map_texels<glm::u16vec4>(numbers, [&](const glm::vec4& number) {
    const glm::vec4 x = glm::clamp(number, 0.0f, 1.0f);
    return glm::u16vec4(code(encoded(x.x)), code(encoded(x.y)), code(encoded(x.z)), code(x.w));
  });
}

}  // namespace halfspace::HS_LANES
