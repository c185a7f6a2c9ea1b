// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/assets/texture_image.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

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

// Shaders expect data, for example a shininess or an occlusion, from 0 to 1.
void limit_data(TextureImage& image) {
  auto* numbers = std::get_if<Image<glm::vec4>>(&image);
  if (numbers == nullptr) return;
  for (glm::vec4& t : std::span(numbers->data(), numbers->texels().size())) t = glm::clamp(t, 0.0f, 1.0f);
}

TextureImage completed(TextureImage image, TextureRole role) {
  if (role == TextureRole::normals) complete_normals(image);
  if (role == TextureRole::data) limit_data(image);
  return image;
}

// Within the rounding of maps with 8 bits.
bool has_unit_length(const glm::vec3& v) { return std::fabs(glm::length(v) - 1.0f) < 0.01f; }

// Returns whether the texels of a normal map are vectors, instead of vectors mapped to 0 to 1: more of them have the length 1 as they are.
// If that does not decide, or z is missing, negative values do.
bool are_vectors(std::span<const glm::vec4> texels, bool lacks_z) {
  std::ptrdiff_t balance = 0;
  bool has_negative = false, is_black = true;
  for (const glm::vec4& t : texels) {
    const glm::vec3 v(t);
    balance += std::ptrdiff_t{has_unit_length(v)} - std::ptrdiff_t{has_unit_length(2.0f * v - 1.0f)};
    has_negative = has_negative || v.x < 0.0f || v.y < 0.0f || v.z < 0.0f;
    is_black = is_black && v == glm::vec3(0.0f);
  }
  return balance != 0 && !lacks_z ? balance > 0 : has_negative || is_black;
}

// Returns z for x and y. All of them are stored: 0 is −1 and 1 is +1.
float stored_z(float stored_x, float stored_y) {
  const float x = 2.0f * stored_x - 1.0f, y = 2.0f * stored_y - 1.0f;
  return 0.5f * std::sqrt(std::max(1.0f - x * x - y * y, 0.0f)) + 0.5f;
}

template <class Texel>
Image<Texel> level_0(const Texture2D& texture) {
  Image<Texel> image(texture.width(), texture.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if constexpr (std::is_same_v<Texel, glm::u8vec4>)
        image.at(x, y) = texture.texel(0, x, y);
      else
        image.at(x, y) = texture.value(0, x, y);
    }
  }
  return image;
}

}  // namespace

TextureRole role_of(TextureUse ModelMaterial::*map) {
  using M = ModelMaterial;
  if (map == &M::base_color_map || map == &M::specular_color_map || map == &M::emissive_map || map == &M::sheen_color_map)
    return TextureRole::colors;
  return map == &M::normal_map || map == &M::clearcoat_normal_map ? TextureRole::normals : TextureRole::data;
}

TextureImage texels_of(const std::filesystem::path& file, TextureRole role) { return completed(read_texels(file, image_use(role)), role); }

TextureImage texels_of(const ModelImage& image, TextureRole role, const std::string& file) {
  if (image.pixels != nullptr) return texels_of(*image.pixels, role, file + ": " + image.name);
  if (image.bytes == nullptr) return texels_of(image.file, role);
  return completed(read_texels(*image.bytes, file + ": " + image.name, image_use(role)), role);
}

TextureImage texels_of(const ColorPicture& picture, TextureRole role, const std::string& name) {
  return completed(to_texels(picture, image_use(role), false, name), role);
}

void complete_normals(TextureImage& image) {
  const bool lacks_z =
      std::visit([](const auto& texels) { return std::ranges::all_of(texels.texels(), [](const auto& t) { return t.z == 0; }); }, image);
  if (auto* codes = std::get_if<Image<glm::u8vec4>>(&image)) {
    if (!lacks_z) return;
    for (glm::u8vec4& t : std::span(codes->data(), codes->texels().size()))
      t.z = static_cast<uint8_t>(stored_z(static_cast<float>(t.x) / 255.0f, static_cast<float>(t.y) / 255.0f) * 255.0f + 0.5f);
    return;
  }
  auto& numbers = std::get<Image<glm::vec4>>(image);
  const std::span texels(numbers.data(), numbers.texels().size());
  if (are_vectors(texels, lacks_z)) {
    for (glm::vec4& t : texels) t = glm::vec4(0.5f * glm::vec3(t) + 0.5f, t.w);
  }
  if (!lacks_z) return;
  for (glm::vec4& t : texels) t.z = stored_z(t.x, t.y);
}

Texture2D texture_of(const TextureImage& image, TextureRole role, const std::string& place, const Workers* workers) {
  if (const auto* codes = std::get_if<Image<glm::u8vec4>>(&image))
    return Texture2D(*codes, role == TextureRole::colors ? TexelFormat::srgb8a8 : TexelFormat::rgba8, workers);
  const auto& numbers = std::get<Image<glm::vec4>>(image);
  const TexelFormat format = are_halfs(numbers) ? TexelFormat::rgba16f : TexelFormat::rgba32f;
  const MemoryClaim claim(
      texture_memory(static_cast<uint64_t>(numbers.width()), static_cast<uint64_t>(numbers.height()), texel_info(format).bytes), place);
  return Texture2D(numbers, format, workers);
}

TextureImage image_of(const Texture2D& texture) {
  if (has_codes(texture.format())) return level_0<glm::u8vec4>(texture);
  return level_0<glm::vec4>(texture);
}

}  // namespace halfspace::HS_LANES
