// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/assets/texture_image.h"

#include <algorithm>
#include <cmath>

#include "halfspace/core/half.h"
#include "halfspace/core/resource_limits.h"
#include "halfspace/image/image_limits.h"

namespace halfspace::HS_LANES {

namespace {

bool is_half(float x) { return half_to_float(float_to_half(x)) == x; }

bool are_halfs(const Image<glm::vec4>& image) {
  return std::ranges::all_of(image.texels(),
                             [](const glm::vec4& t) { return is_half(t.x) && is_half(t.y) && is_half(t.z) && is_half(t.w); });
}

template <class Texel>
bool has_no_blue(const Image<Texel>& image) {
  return std::ranges::all_of(image.texels(), [](const Texel& t) { return t.z == 0; });
}

Image<glm::vec4> numbers_of(const Image<glm::u8vec4>& codes) {
  Image<glm::vec4> numbers(codes.width(), codes.height());
  std::ranges::transform(codes.texels(), numbers.data(), [](const glm::u8vec4& t) { return glm::vec4(t) / 255.0f; });
  return numbers;
}

}  // namespace

Texture2D texture_of(const TextureImage& image, ImageUse use, const Workers& workers, const std::string& place) {
  if (const auto* codes = std::get_if<Image<glm::u8vec4>>(&image))
    return Texture2D(*codes, use == ImageUse::colors ? TexelFormat::srgb8a8 : TexelFormat::rgba8, &workers);
  const auto& numbers = std::get<Image<glm::vec4>>(image);
  const TexelFormat format = are_halfs(numbers) ? TexelFormat::rgba16f : TexelFormat::rgba32f;
  const MemoryClaim claim(
      texture_memory(static_cast<uint64_t>(numbers.width()), static_cast<uint64_t>(numbers.height()), texel_info(format).bytes), place);
  return Texture2D(numbers, format, &workers);
}

void complete_normals(TextureImage& image) {
  const bool lacks_z = std::visit([](const auto& texels) { return has_no_blue(texels); }, image);
  if (const auto* codes = std::get_if<Image<glm::u8vec4>>(&image); codes != nullptr && lacks_z) image = numbers_of(*codes);
  auto* numbers = std::get_if<Image<glm::vec4>>(&image);
  if (numbers == nullptr) return;
  const bool is_signed = std::ranges::any_of(numbers->texels(), [](const glm::vec4& t) { return t.x < 0.0f || t.y < 0.0f || t.z < 0.0f; });
  if (!is_signed && !lacks_z) return;
  for (std::size_t i = 0; i < numbers->texels().size(); ++i) {
    glm::vec4& t = numbers->data()[i];
    if (is_signed) t = glm::vec4(0.5f * glm::vec3(t) + 0.5f, t.w);
    if (!lacks_z) continue;
    const float x = 2.0f * t.x - 1.0f, y = 2.0f * t.y - 1.0f;
    t.z = 0.5f * std::sqrt(std::max(1.0f - x * x - y * y, 0.0f)) + 0.5f;
  }
}

}  // namespace halfspace::HS_LANES
