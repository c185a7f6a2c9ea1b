// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/export/pack_maps.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "halfspace/core/resource_limits.h"
#include "halfspace/core/srgb.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/png.h"
#include "halfspace/render/prepare/soft_mask.h"

namespace halfspace::HS_LANES {

namespace {

using Picture = Image<glm::u8vec4>;

// The source of a channel of a new image: a channel of a map, or a constant.
struct Source {
  const Picture* picture = nullptr;
  Channel channel = Channel::red;
  uint8_t constant = 255;

  // Returns the texel nearest to the position of pixel (x, y) in an image of the given size.
  uint8_t at(int x, int y, int width, int height) const {
    if (picture == nullptr) return constant;
    const auto scaled = [](int i, int size, int own) { return static_cast<int>((2 * int64_t{i} + 1) * own / (2 * int64_t{size})); };
    return channel_value(picture->at(scaled(x, width, picture->width()), scaled(y, height, picture->height())), channel);
  }
};

class MapPacker {
 public:
  MapPacker(Model& model, const std::string& file) : model_(model), file_(file) {}

  void pack(ModelMaterial& m) {
    pack_metallic_roughness(m);
    resolve_mask(m);
    pack_opacity(m);
    pack_specular(m);
  }

 private:
  const Picture* picture_of(const TextureUse& use) {
    if (use.texture < 0) return nullptr;
    const int image = model_.textures[static_cast<std::size_t>(use.texture)].image;
    if (image < 0 || model_.images[static_cast<std::size_t>(image)].bytes == nullptr) return nullptr;
    const auto [known, added] = pictures_.try_emplace(image);
    if (added) {
      const ModelImage& source = model_.images[static_cast<std::size_t>(image)];
      try {
        known->second = read_image(*source.bytes, file_ + ": " + source.name);
      } catch (const LimitError&) {
        throw;
      } catch (const InputError& e) {
        model_.warnings.emplace_back(e.what());
      }
    }
    return known->second ? &*known->second : nullptr;
  }

  bool same_place(const TextureUse& a, const TextureUse& b) const {
    const Sampler& s = model_.textures[static_cast<std::size_t>(a.texture)].sampler;
    const Sampler& t = model_.textures[static_cast<std::size_t>(b.texture)].sampler;
    return a.uv_set == b.uv_set && a.uv_transform == b.uv_transform && s.wrap_s == t.wrap_s && s.wrap_t == t.wrap_t;
  }

  // Returns a use of a new texture with these channels that replaces `like`.
  TextureUse packed(const TextureUse& like, const std::array<Source, 4>& channels, PngCodes codes, const std::string& name) {
    int width = 1, height = 1;
    for (const Source& source : channels) {
      if (source.picture == nullptr) continue;
      width = std::max(width, source.picture->width());
      height = std::max(height, source.picture->height());
    }
    Picture picture(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (glm::length_t k = 0; k < 4; ++k) picture.at(x, y)[k] = channels[static_cast<std::size_t>(k)].at(x, y, width, height);
      }
    }
    const int image = static_cast<int>(model_.images.size());
    model_.images.push_back({name, {}, std::make_shared<const std::vector<std::byte>>(encode_png(picture, codes))});
    model_.textures.push_back({image, model_.textures[static_cast<std::size_t>(like.texture)].sampler});
    TextureUse use = like;
    use.texture = static_cast<int>(model_.textures.size()) - 1;
    return use;
  }

  void pack_metallic_roughness(ModelMaterial& m) {
    const bool has_metallic = m.metallic_map.texture >= 0, has_roughness = m.roughness_map.texture >= 0;
    if (!has_metallic && !has_roughness) return;
    const bool fits =
        m.roughness_map.channel == Channel::green && has_roughness &&
        (has_metallic ? m.metallic_map.channel == Channel::blue && m.metallic_map.texture == m.roughness_map.texture : m.metallic == 0.0f);
    if (fits || (has_metallic && has_roughness && !same_place(m.metallic_map, m.roughness_map))) return;
    const Picture* metallic = picture_of(m.metallic_map);
    const Picture* roughness = picture_of(m.roughness_map);
    if ((has_metallic && metallic == nullptr) || (has_roughness && roughness == nullptr)) return;
    const TextureUse like = has_roughness ? m.roughness_map : m.metallic_map;
    const TextureUse use = packed(like, {Source{}, {roughness, m.roughness_map.channel}, {metallic, m.metallic_map.channel}, {}},
                                  PngCodes::numbers, m.name + "_metallic_roughness");
    m.metallic_map = m.roughness_map = use;
    m.metallic_map.channel = Channel::blue;
    m.roughness_map.channel = Channel::green;
  }

  void resolve_mask(ModelMaterial& m) {
    if (!m.mask_unless_soft || m.alpha_mode != AlphaMode::mask) return;
    const bool separate = m.opacity_map.texture >= 0;
    const Picture* picture = picture_of(separate ? m.opacity_map : m.base_color_map);
    if (picture == nullptr) return;
    const Channel channel = separate ? m.opacity_map.channel : Channel::alpha;
    const auto texel = [&](int x, int y) { return picture->at(x, y); };
    if (is_soft(picture->width(), picture->height(), texel, channel)) m.alpha_mode = AlphaMode::blend;
  }

  void pack_opacity(ModelMaterial& m) {
    if (m.opacity_map.texture < 0) return;
    const bool has_color = m.base_color_map.texture >= 0;
    if (has_color && !same_place(m.base_color_map, m.opacity_map)) return;
    const Picture* color = picture_of(m.base_color_map);
    const Picture* opacity = picture_of(m.opacity_map);
    if (opacity == nullptr || (has_color && color == nullptr)) return;
    m.base_color_map = packed(
        m.opacity_map, {Source{color, Channel::red}, {color, Channel::green}, {color, Channel::blue}, {opacity, m.opacity_map.channel}},
        PngCodes::srgb, m.name + "_color_opacity");
    m.opacity_map = {};
  }

  void pack_specular(ModelMaterial& m) {
    if (m.specular_map.texture < 0 || m.specular_map.channel == Channel::alpha) return;
    const Picture* specular = picture_of(m.specular_map);
    if (specular == nullptr) return;
    m.specular_map =
        packed(m.specular_map, {Source{}, {}, {}, {specular, m.specular_map.channel}}, PngCodes::numbers, m.name + "_specular");
    m.specular_map.channel = Channel::alpha;
  }

  Model& model_;
  const std::string& file_;
  std::map<int, std::optional<Picture>> pictures_;  // decoded images
};

}  // namespace

void pack_maps(Model& model, const std::string& file) {
  MapPacker packer(model, file);
  for (ModelMaterial& material : model.materials) packer.pack(material);
}

}  // namespace halfspace::HS_LANES
