// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/texture/texture_memory.h"

#include <algorithm>
#include <bit>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/texel_codec.h"
#include "halfspace/shading/texture/mip_taps.h"
#include "halfspace/shading/texture/texel_reader.h"
#include "halfspace/shading/texture/texels.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kAlignment = 64;  // of levels, in bytes

TextureSize size_of_level(TextureKind kind, const TextureSize& base, int level) {
  const auto shifted = [level](int size) { return std::max(size >> level, 1); };
  return {shifted(base.width), shifted(base.height), kind == TextureKind::three_d ? shifted(base.depth) : base.depth};
}

/// The slices that are averaged together: those of a 3D texture, or a single layer. Values are in the units of TexelReader.
struct Slices {
  TextureSize size;
  std::vector<glm::dvec4> values;

  explicit Slices(const TextureSize& s) : size(s), values(static_cast<std::size_t>(s.width) * static_cast<std::size_t>(rows())) {}
  int rows() const { return size.height * size.depth; }
  glm::dvec4* row(int r) { return values.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(size.width); }
  const glm::dvec4* row(int r) const { return values.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(size.width); }
};

Slices read_slices(const ConstTexelView& view, const Workers* workers) {
  Slices slices({view.width, view.height, view.layers});
  detail::for_each_row(workers, slices.rows(), [&](int r) {
    for (int x = 0; x < view.width; ++x) {
      const vec4<double> v = detail::TexelReader<double>{view.format, view.at(x, r % view.height, r / view.height)}(0);
      slices.row(r)[x] = {v.x, v.y, v.z, v.w};
    }
  });
  return slices;
}

Slices next_slices(const Slices& from, const Workers* workers) {
  Slices to(size_of_level(TextureKind::three_d, from.size, 1));
  std::vector<detail::MipTaps<double>> columns;
  for (int x = 0; x < to.size.width; ++x) columns.push_back(detail::mip_taps<double>(from.size.width, x));
  detail::for_each_row(workers, to.rows(), [&](int r) {
    const FloatMode float_mode;
    const auto slices = detail::mip_taps<double>(from.size.depth, r / to.size.height);
    const auto rows = detail::mip_taps<double>(from.size.height, r % to.size.height);
    for (int k = 0; k < slices.count; ++k) {
      for (int j = 0; j < rows.count; ++j) {
        const glm::dvec4* const row = from.row((slices.first + k) * from.size.height + rows.first + j);
        for (int x = 0; x < to.size.width; ++x) {
          const detail::MipTaps<double>& taps = columns[static_cast<std::size_t>(x)];
          for (int i = 0; i < taps.count; ++i) to.row(r)[x] += slices.weight[k] * rows.weight[j] * taps.weight[i] * row[taps.first + i];
        }
      }
    }
  });
  return to;
}

/// Encodes a value in the units of TexelReader. The codes of normalized formats are rounded to the nearest integer, ties to even.
void encode_units(TexelFormat format, const glm::dvec4& v, std::byte* texel) {
  const TexelInfo& info = texel_info(format);
  const glm::ivec4 codes(round_to_int(v.x), round_to_int(v.y), round_to_int(v.z), round_to_int(v.w));
  const auto integers = [&](TexelFormat with_one_channel) {
    return static_cast<TexelFormat>(static_cast<int>(with_one_channel) + info.channels - 1);
  };
  glm::vec4 color(v);
  if (info.kind == TexelKind::unorm && info.bits == 0) {  // packed
    for (int k = 0; k < info.channels; ++k) color[k] = decode_unorm<float>(codes[k], channel_bits(format, k));
    return encode_texel(format, color, texel);
  }
  if (info.kind == TexelKind::unorm)
    return encode_integers(integers(info.bits == 8 ? TexelFormat::r8ui : TexelFormat::r16ui), codes, texel);
  if (info.kind == TexelKind::snorm) return encode_integers(integers(info.bits == 8 ? TexelFormat::r8i : TexelFormat::r16i), codes, texel);
  if (info.kind == TexelKind::srgb) color.w = unorm8_to_linear(static_cast<float>(codes.w));
  encode_texel(format, color, texel);
}

void write_slices(const Slices& slices, const TexelView& view, const Workers* workers) {
  detail::for_each_row(workers, slices.rows(), [&](int r) {
    const FloatMode float_mode;
    for (int x = 0; x < view.width; ++x) encode_units(view.format, slices.row(r)[x], view.at(x, r % view.height, r / view.height));
  });
}

}  // namespace

int full_levels(TextureKind kind, const TextureSize& size) {
  const int largest = std::max({size.width, size.height, kind == TextureKind::three_d ? size.depth : 1});
  return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(largest, 1))));
}

TextureMemory::TextureMemory(TextureKind kind, TexelFormat format, const TextureSize& size, int levels) : kind_(kind), format_(format) {
  HS_CHECK(format != TexelFormat::none, "TextureMemory: there is no format; expected one with texels");
  HS_CHECK(std::min({size.width, size.height, size.depth}) >= 1, "TextureMemory: the texture is empty; expected sizes of at least 1");
  HS_CHECK(levels >= 1 && levels <= std::min(full_levels(kind, size), detail::kMaxLevels),
           "TextureMemory: there are too few or too many levels; expected 1 to full_levels(), and at most 16");
  std::vector<std::size_t> begins;
  std::size_t end = 0;
  for (int k = 0; k < levels; ++k) {
    const TextureSize s = size_of_level(kind, size, k);
    const std::ptrdiff_t row = std::ptrdiff_t{texel_info(format).bytes} * s.width, layer = row * s.height;
    levels_.push_back({format, nullptr, s.width, s.height, s.depth, row, layer});
    begins.push_back(end);
    end += (static_cast<std::size_t>(layer) * static_cast<std::size_t>(s.depth) + kAlignment - 1) / kAlignment * kAlignment;
  }
  texels_.resize(end);
  for (std::size_t k = 0; k < levels_.size(); ++k) levels_[k].data = texels_.data() + begins[k];
  detail::make_texture_table(kind, levels_.data(), levels_.size());  // checks that the sizes suit the kind
}

TexelView TextureMemory::level(int k) {
  HS_CHECK(k >= 0 && k < levels(), "TextureMemory: there is no such level; expected 0 to levels() - 1");
  const ConstTexelView& v = levels_[static_cast<std::size_t>(k)];
  return {v.format, texels_.data() + (v.data - texels_.data()), v.width, v.height, v.layers, v.row_pitch, v.layer_pitch};
}

void TextureMemory::set(int x, int y, int layer, int level, const glm::vec4& color) {
  HS_CHECK(!is_integer(format_), "TextureMemory::set: the texture has integers; expected a call of set_integers");
  encode_texel(format_, color, this->level(level).part(x, y, 1, 1).part_of_layers(layer).data);
}

void TextureMemory::set_integers(int x, int y, int layer, int level, const glm::ivec4& values) {
  HS_CHECK(is_integer(format_), "TextureMemory::set_integers: the texture has no integers; expected a call of set");
  encode_integers(format_, values, this->level(level).part(x, y, 1, 1).part_of_layers(layer).data);
}

void TextureMemory::generate_mipmaps(const Workers* workers) {
  HS_CHECK(!is_integer(format_) && !has_stencil(format_),
           "TextureMemory: integers and stencil values have no mean; expected another format for mipmaps");
  const bool volume = kind_ == TextureKind::three_d;
  for (int part = 0; part < (volume ? 1 : levels_[0].layers); ++part) {
    const auto slices_of = [&](int k) { return volume ? level(k) : layer(part, k); };
    Slices slices = read_slices(slices_of(0), workers);
    for (int k = 1; k < levels(); ++k) {
      slices = next_slices(slices, workers);
      write_slices(slices, slices_of(k), workers);
    }
  }
}

}  // namespace halfspace::HS_LANES
