// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/assets/converted_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include "halfspace/core/resource_limits.h"
#include "halfspace/core/srgb.h"
#include "halfspace/model/gltf/specular_glossiness.h"
#include "halfspace/render/assets/texture_image.h"

namespace halfspace::HS_LANES {

namespace {

// Returns the image of a texture, or one white texel if there is none or if it cannot be read.
TextureImage source_picture(const Model& model, int texture, const std::string& place, std::vector<std::string>& problems) {
  Image<glm::u8vec4> white(1, 1);
  white.at(0, 0) = glm::u8vec4(255);
  if (texture < 0) return white;
  const int image = model.textures[static_cast<std::size_t>(texture)].image;
  if (image < 0) return white;
  const ModelImage& source = model.images[static_cast<std::size_t>(image)];
  try {
    if (source.has_content()) return texels_of(source, TextureRole::colors, place);
  } catch (const LimitError&) {
    throw;
  } catch (const InputError& e) {
    problems.emplace_back(e.what());
  }
  return white;
}

int width_of(const TextureImage& picture) {
  return std::visit([](const auto& texels) { return texels.width(); }, picture);
}
int height_of(const TextureImage& picture) {
  return std::visit([](const auto& texels) { return texels.height(); }, picture);
}

int wrapped(int i, int size, Wrap wrap) {
  const auto modulo = [](int a, int n) { return (a % n + n) % n; };
  switch (wrap) {
    case Wrap::repeat: return modulo(i, size);
    case Wrap::mirrored: {
      const int k = modulo(i, 2 * size);
      return k < size ? k : 2 * size - 1 - k;
    }
    case Wrap::mirrored_clamp: return std::min(i < 0 ? -1 - i : i, size - 1);
    case Wrap::clamp:
    case Wrap::border: break;
  }
  return std::clamp(i, 0, size - 1);
}

// One of the texels that an output texel is a weighted mean of, along one axis.
struct Tap {
  int texel;
  float weight;
};

// Returns the taps of each of `to` output texels: linear interpolation, or, if there are fewer output texels than texels, a tent that
// covers the distance between two output texels to both sides.
std::vector<std::vector<Tap>> taps_of(int from, int to, Wrap wrap, bool nearest) {
  std::vector<std::vector<Tap>> taps(static_cast<std::size_t>(to));
  const double step = static_cast<double>(from) / to, reach = std::max(step, 1.0);
  for (int i = 0; i < to; ++i) {
    std::vector<Tap>& list = taps[static_cast<std::size_t>(i)];
    const double center = (i + 0.5) * step - 0.5;
    if (from == to || nearest) {
      list.push_back({std::min(static_cast<int>((i + 0.5) * step), from - 1), 1.0f});
      continue;
    }
    double sum = 0.0;
    for (int k = static_cast<int>(std::floor(center - reach)) + 1; k < center + reach; ++k) sum += reach - std::fabs(k - center);
    for (int k = static_cast<int>(std::floor(center - reach)) + 1; k < center + reach; ++k)
      list.push_back({wrapped(k, from, wrap), static_cast<float>((reach - std::fabs(k - center)) / sum)});
  }
  return taps;
}

// A picture at another resolution with at least as many texels.
class Resampled {
 public:
  Resampled(const TextureImage& picture, const Sampler& sampler, int width, int height, const std::string& place)
      : picture_(picture),
        across_(taps_of(width_of(picture), width, sampler.wrap_s, sampler.mag == Filter::nearest)),
        down_(taps_of(height_of(picture), height, sampler.wrap_t, sampler.mag == Filter::nearest)) {
    // At most one axis has fewer texels than before. Its means are computed first, because they can have thousands of taps.
    const bool narrower = width < width_of(picture), lower = height < height_of(picture);
    if (!narrower && !lower) return;
    const int columns = narrower ? width : width_of(picture), rows = lower ? height : height_of(picture);
    const MemoryClaim claim(sizeof(glm::vec4) * static_cast<uint64_t>(columns) * static_cast<uint64_t>(rows), place);
    Image<glm::vec4> reduced(columns, rows);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        for (const Tap& tap : narrower ? across_[static_cast<std::size_t>(x)] : down_[static_cast<std::size_t>(y)])
          reduced.at(x, y) += (narrower ? texel(tap.texel, y) : texel(x, tap.texel)) * tap.weight;
      }
    }
    reduced_ = std::move(reduced);
    (narrower ? across_ : down_) = taps_of(narrower ? width : height, narrower ? width : height, Wrap::clamp, true);
  }

  // Returns linear color and alpha.
  glm::vec4 at(int x, int y) const {
    glm::vec4 sum(0.0f);
    for (const Tap& row : down_[static_cast<std::size_t>(y)]) {
      for (const Tap& column : across_[static_cast<std::size_t>(x)]) sum += texel(column.texel, row.texel) * (row.weight * column.weight);
    }
    return sum;
  }

 private:
  glm::vec4 texel(int x, int y) const {
    if (!reduced_.empty()) return reduced_.at(x, y);
    if (const auto* numbers = std::get_if<Image<glm::vec4>>(&picture_)) return numbers->at(x, y);
    const glm::u8vec4 t = std::get<Image<glm::u8vec4>>(picture_).at(x, y);
    return {kSrgbToLinear[t.x], kSrgbToLinear[t.y], kSrgbToLinear[t.z], static_cast<float>(t.w) / 255.0f};
  }

  const TextureImage& picture_;
  std::vector<std::vector<Tap>> across_, down_;
  Image<glm::vec4> reduced_;
};

uint8_t code_of(double x) { return static_cast<uint8_t>(linear_to_unorm8(static_cast<float>(x))); }
uint8_t srgb_code_of(double x) { return static_cast<uint8_t>(linear_to_srgb(static_cast<float>(x))); }

const Sampler& sampler_of(const Model& model, int texture) {
  static const Sampler standard;
  return texture < 0 ? standard : model.textures[static_cast<std::size_t>(texture)].sampler;
}

}  // namespace

ConvertedImages converted_images(const Model& model, const SpecularGlossiness& source, const std::string& place, const Workers& workers) {
  ConvertedImages out;
  const TextureImage diffuse = source_picture(model, source.diffuse_texture, place, out.problems);
  const TextureImage specular = source_picture(model, source.specular_texture, place, out.problems);
  const auto texels = [](const TextureImage& picture) { return int64_t{width_of(picture)} * height_of(picture); };
  const TextureImage& larger = texels(diffuse) >= texels(specular) ? diffuse : specular;
  const int width = width_of(larger), height = height_of(larger);
  const MemoryClaim claim(uint64_t{2} * sizeof(glm::u8vec4) * static_cast<uint64_t>(width) * static_cast<uint64_t>(height), place);
  out.base_color = Image<glm::u8vec4>(width, height);
  out.metallic_roughness = Image<glm::u8vec4>(width, height);
  const Resampled diffuse_map(diffuse, sampler_of(model, source.diffuse_texture), width, height, place);
  const Resampled specular_map(specular, sampler_of(model, source.specular_texture), width, height, place);
  workers.for_each(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const glm::vec4 d = diffuse_map.at(x, y), s = specular_map.at(x, y);
      const MetallicColor c = metallic_color(glm::clamp(glm::dvec3(glm::vec3(d) * source.diffuse), 0.0, 1.0),
                                             glm::clamp(glm::dvec3(glm::vec3(s) * source.specular), 0.0, 1.0));
      out.base_color.at(x, y) = {srgb_code_of(c.base.x), srgb_code_of(c.base.y), srgb_code_of(c.base.z), code_of(d.w)};
      out.metallic_roughness.at(x, y) = {0, code_of(1.0 - s.w * source.glossiness), code_of(c.metallic), 255};
    }
  });
  return out;
}

}  // namespace halfspace::HS_LANES
