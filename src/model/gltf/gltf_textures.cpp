// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "halfspace/core/trig_double.h"
#include "halfspace/model/gltf/gltf_uri.h"

namespace halfspace::HS_LANES {

namespace {

// OpenGL constants.
constexpr uint64_t kNearest = 9728, kLinear = 9729, kNearestMipmapNearest = 9984, kLinearMipmapNearest = 9985, kNearestMipmapLinear = 9986,
                   kLinearMipmapLinear = 9987;
constexpr uint64_t kRepeat = 10497, kClampToEdge = 33071, kMirroredRepeat = 33648;

Wrap wrap_of(const GltfDocument& document, const GltfValue& json, const char* key) {
  switch (document.integer(json, key, kRepeat)) {
    case kRepeat: return Wrap::repeat;
    case kClampToEdge: return Wrap::clamp;
    case kMirroredRepeat: return Wrap::mirrored;
    default: document.fail(json, key, "is not a wrap mode; expected 10497, 33071 or 33648");
  }
}

Filter min_filter_of(const GltfDocument& document, const GltfValue& json) {
  switch (document.integer(json, "minFilter", kLinearMipmapLinear)) {
    case kNearest: return Filter::nearest;
    case kLinear: return Filter::bilinear;
    case kNearestMipmapNearest: return Filter::nearest_mipmap_nearest;
    case kLinearMipmapNearest: return Filter::bilinear_mipmap_nearest;
    case kNearestMipmapLinear: return Filter::nearest_mipmap_linear;
    case kLinearMipmapLinear: return Filter::trilinear;
    default: document.fail(json, "minFilter", "is not a filter; expected 9728, 9729 or 9984 to 9987");
  }
}

Sampler sampler_of(const GltfDocument& document, const GltfValue& json) {
  Sampler sampler;
  const uint64_t mag = document.integer(json, "magFilter", kLinear);
  if (mag != kNearest && mag != kLinear) document.fail(json, "magFilter", "is not a filter; expected 9728 or 9729");
  sampler.mag = mag == kNearest ? Filter::nearest : Filter::bilinear;
  sampler.min = min_filter_of(document, json);
  if (sampler.min == Filter::trilinear) sampler.anisotropy = kModelAnisotropy;
  sampler.wrap_s = wrap_of(document, json, "wrapS");
  sampler.wrap_t = wrap_of(document, json, "wrapT");
  return sampler;
}

// Returns the image of a texture, or −1 if it has none. The DDS image is read only if there is no other: it is usually a compressed copy of
// the PNG or JPEG, and a build without halfspace-image-tool cannot read it.
int image_of(GltfDocument& document, const GltfValue& json) {
  const std::size_t images = document.list("images").size();
  const auto image_in = [&](const GltfValue* texture) { return texture == nullptr ? -1 : document.index(*texture, "source", images); };
  for (const GltfValue* texture : {document.extension(json, "EXT_texture_webp"), &json, document.extension(json, "MSFT_texture_dds")}) {
    if (const int image = image_in(texture); image >= 0) return image;
  }
  return -1;
}

// The rotation is counter-clockwise as seen in an image whose v axis points down. (The matrix in the text of the extension has the
// opposite direction, unlike its description and its test model.)
glm::mat3x2 uv_transform(const GltfDocument& document, const GltfValue& json) {
  const auto offset = document.numbers<2>(json, "offset", {0.0, 0.0}), scale = document.numbers<2>(json, "scale", {1.0, 1.0});
  const double angle = document.number(json, "rotation", 0.0, -1e6, 1e6);
  const auto [s, c] = sincos_radians(angle);
  const auto vector = [](double x, double y) { return glm::vec2(static_cast<float>(x), static_cast<float>(y)); };
  return {vector(c * scale[0], -s * scale[0]), vector(s * scale[1], c * scale[1]), vector(offset[0], offset[1])};
}

}  // namespace

GltfTextures::GltfTextures(GltfDocument& document, GltfBuffers& buffers, References& references, Model& model)
    : document_(document), buffers_(buffers), references_(references), model_(model), tried_(document.list("images").size()) {
  for (const GltfValue& json : document.list("images")) {
    std::string name = document.string(json, "name");
    const std::string uri = document.string(json, "uri");
    if (name.empty() && !is_data_uri(uri)) name = percent_decoded(uri);
    if (name.empty()) name = fmt::format("images[{}]", model.images.size());
    model.images.push_back({.name = std::move(name), .file = {}, .bytes = nullptr});
  }
  std::vector<Sampler> samplers;
  for (const GltfValue& json : document.list("samplers")) samplers.push_back(sampler_of(document, json));
  const Sampler standard = sampler_of(document, GltfValue::object());
  for (const GltfValue& json : document.list("textures")) {
    const int sampler = document.index(json, "sampler", samplers.size());
    model.textures.push_back({image_of(document, json), sampler < 0 ? standard : samplers[static_cast<std::size_t>(sampler)]});
  }
}

bool GltfTextures::locate_image(int index) {
  if (index < 0) return false;
  const auto i = static_cast<std::size_t>(index);
  const GltfValue& json = document_.list("images")[i];
  ModelImage& image = model_.images[i];
  if (tried_[i]) return image.bytes != nullptr || !image.file.empty();
  tried_[i] = true;
  const std::string uri = document_.string(json, "uri");
  const int view = document_.index(json, "bufferView", document_.list("bufferViews").size());
  if (view >= 0) {
    const std::span<const std::byte> bytes = buffers_.view(static_cast<std::size_t>(view)).bytes;
    document_.take_memory(json, bytes.size(), 1);
    image.bytes = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
  } else if (is_data_uri(uri)) {
    document_.take_memory(json, uri.size(), 1);
    std::optional<std::vector<std::byte>> data = data_of_uri(uri);
    if (!data) document_.fail(json, "uri", "the data URI is invalid; expected data:...;base64,...");
    image.bytes = std::make_shared<const std::vector<std::byte>>(std::move(*data));
  } else if (!uri.empty()) {
    if (const auto path = references_.find(percent_decoded(uri), fmt::format("image {}", index))) image.file = *path;
  } else {
    document_.warn_at(json, "", "has neither a file nor data; it is skipped");
  }
  image.missing = image.bytes == nullptr && image.file.empty();
  return !image.missing;
}

namespace {

// Returns the index of the set of texture coordinates in the file.
int uv_set_of(const GltfDocument& document, const GltfValue& json, int fallback) {
  constexpr uint64_t kMaxSet = 1000;  // no mesh has a larger one
  return static_cast<int>(std::min(document.integer(json, "texCoord", static_cast<uint64_t>(fallback)), kMaxSet));
}

}  // namespace

TextureUse GltfTextures::use(const GltfValue& object, const char* key, Channel channel) {
  const GltfValue* json = document_.find(object, key);
  if (json == nullptr) return {};
  TextureUse use;
  use.channel = channel;
  const GltfValue& info = document_.object(object, key);
  const int texture = document_.required_index(info, "index", document_.list("textures").size());
  use.uv_set = uv_set_of(document_, info, 0);
  if (const GltfValue* transform = document_.extension(info, "KHR_texture_transform")) {
    use.uv_set = uv_set_of(document_, *transform, use.uv_set);
    use.uv_transform = uv_transform(document_, *transform);
  }
  if (model_.textures[static_cast<std::size_t>(texture)].image < 0) {
    document_.warn_at(info, "index", "the texture has no image in a supported format; it is skipped");
    return {};
  }
  if (locate_image(model_.textures[static_cast<std::size_t>(texture)].image)) use.texture = texture;
  return use;
}

int GltfTextures::add_converted(const SpecularGlossiness& source, const std::string& name) {
  const std::array<float, 9> key{static_cast<float>(source.diffuse_texture),
                                 static_cast<float>(source.specular_texture),
                                 source.diffuse.x,
                                 source.diffuse.y,
                                 source.diffuse.z,
                                 source.specular.x,
                                 source.specular.y,
                                 source.specular.z,
                                 source.glossiness};
  const auto [known, added] = converted_.try_emplace(key, static_cast<int>(model_.textures.size()));
  if (!added) return known->second;
  // Each result is sampled like the source that determines it most.
  const std::array sources{source.diffuse_texture, source.specular_texture};
  for (const auto result : {SpecularGlossiness::Result::base_color, SpecularGlossiness::Result::metallic_roughness}) {
    const bool is_color = result == SpecularGlossiness::Result::base_color;
    const int like = sources[is_color ? 0 : 1] >= 0 ? sources[is_color ? 0 : 1] : sources[is_color ? 1 : 0];
    const Sampler sampler = model_.textures[static_cast<std::size_t>(like)].sampler;
    model_.textures.push_back({static_cast<int>(model_.images.size()), sampler});
    ModelImage image;
    image.name = name + (is_color ? "_base_color" : "_metallic_roughness");
    image.converted = source;
    image.converted->result = result;
    model_.images.push_back(std::move(image));
  }
  return known->second;
}

}  // namespace halfspace::HS_LANES
