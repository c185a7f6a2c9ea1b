// SPDX-License-Identifier: Apache-2.0
#include "halfspace/shading/texture/texture_table.h"

#include <algorithm>
#include <cstdlib>

#include "halfspace/core/check.h"
#include "halfspace/shading/texture/texel_reader.h"

namespace halfspace::HS_LANES::detail {

namespace {

void check_layers(TextureKind kind, const ConstTexelView& level) {
  switch (kind) {
    case TextureKind::one_d:
      HS_CHECK(level.height == 1 && level.layers == 1,
               "TextureView: a 1D texture has rows or layers; expected a height of 1 and one layer");
      break;
    case TextureKind::one_d_array: HS_CHECK_OP(level.height, ==, 1, "TextureView: a 1D array has rows; expected a height of 1"); break;
    case TextureKind::two_d:
    case TextureKind::rectangle:
      HS_CHECK_OP(level.layers, ==, 1, "TextureView: a texture without layers has several; expected one, or another kind of texture");
      break;
    case TextureKind::cube:
      HS_CHECK(level.layers == 6 && level.width == level.height, "TextureView: a cube has other faces; expected six squares");
      break;
    case TextureKind::cube_array:
      HS_CHECK(level.layers % 6 == 0 && level.width == level.height,
               "TextureView: a cube array has other faces; expected squares, six for each cube");
      break;
    case TextureKind::multisample:
      HS_CHECK(level.layers == 2 || level.layers == 4 || level.layers == 8,
               "TextureView: a multisample texture has another number of layers; expected one for each of 2, 4 or 8 samples");
      break;
    case TextureKind::three_d:
    case TextureKind::two_d_array: break;
  }
}

// Checks that level k follows from level 0, and that its texels can be addressed.
void check_level(TextureKind kind, const ConstTexelView& base, const ConstTexelView& level, std::size_t k) {
  const int shift = static_cast<int>(k);
  HS_CHECK(level.format == base.format && level.format != TexelFormat::none,
           "TextureView: a level has no format or another one than level 0; expected the same format");
  HS_CHECK(level.width >= 1 && level.height >= 1 && level.layers >= 1, "TextureView: a level is empty; expected at least one texel");
  HS_CHECK(level.width == std::max(base.width >> shift, 1) && level.height == std::max(base.height >> shift, 1) &&
               level.layers == (kind == TextureKind::three_d ? std::max(base.layers >> shift, 1) : base.layers),
           "TextureView: a level has the wrong size; expected half of the level before, and as many layers");
  const int unit = texel_unit(level.format);
  HS_CHECK(level.data != nullptr && reinterpret_cast<uintptr_t>(level.data) % static_cast<uintptr_t>(unit) == 0 &&
               level.row_pitch % unit == 0 && level.layer_pitch % unit == 0,
           "TextureView: texels are not aligned; expected data and pitches that are multiples of 4 bytes, or 2 or 1 for small texels");
  const std::ptrdiff_t bytes = texel_info(level.format).bytes;
  HS_CHECK(std::abs(level.row_pitch) >= bytes * level.width || level.height == 1,
           "TextureView: rows overlap; expected a row pitch of at least the width in bytes");
  const std::ptrdiff_t span =
      bytes * level.width + std::abs(level.row_pitch) * (level.height - 1) + std::abs(level.layer_pitch) * (level.layers - 1);
  HS_CHECK_OP(span / unit, <, std::ptrdiff_t{1} << 31, "TextureView: a level is too large; expected fewer than 2^31 units of its texels");
  check_layers(kind, level);
}

}  // namespace

TextureTable make_texture_table(TextureKind kind, const ConstTexelView* levels, std::size_t count) {
  HS_CHECK(count >= 1 && count <= static_cast<std::size_t>(kMaxLevels), "TextureView: there are no levels or too many; expected 1 to 16");
  HS_CHECK(count == 1 || (kind != TextureKind::rectangle && kind != TextureKind::multisample),
           "TextureView: rectangle and multisample textures have one level; expected no more");
  TextureTable table;
  table.kind = kind;
  table.format = levels[0].format;
  for (std::size_t k = 0; k < count; ++k) {
    const ConstTexelView& view = levels[k];
    check_level(kind, levels[0], view, k);
    const int unit = texel_unit(view.format);
    TextureLevel& level = table.level[static_cast<std::size_t>(table.levels++)];
    level.offset = reinterpret_cast<intptr_t>(view.data) - reinterpret_cast<intptr_t>(levels[0].data);
    level.width = view.width;
    level.height = view.height;
    level.depth = view.layers;
    level.row_pitch = static_cast<int32_t>(view.row_pitch / unit);
    level.layer_pitch = static_cast<int32_t>(view.layer_pitch / unit);
  }
  return table;
}

}  // namespace halfspace::HS_LANES::detail
