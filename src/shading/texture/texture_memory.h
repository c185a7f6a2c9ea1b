// SPDX-License-Identifier: Apache-2.0
//
// The texels of a texture of any kind and format, with all levels and layers in one allocation: to draw into, to fill, and to sample.
#pragma once

#include <vector>

#include "halfspace/core/cache_line_allocator.h"
#include "halfspace/core/parallel.h"
#include "halfspace/core/texel_view.h"
#include "halfspace/shading/texture/texture_view.h"

namespace halfspace::HS_LANES {

/// Width, height, and depth of level 0: slices (3D), array layers, faces (6 for a cube, or six for each cube of an array) or samples.
struct TextureSize {
  int width = 1, height = 1, depth = 1;
};

/// Returns the number of levels down to 1 x 1 (x 1 for 3D textures).
int full_levels(TextureKind kind, const TextureSize& size);

/// Owns the texels of a texture (OpenGL's glTexStorage). Views refer to it, so it must neither move nor end while they are used.
class TextureMemory {
 public:
  /// Allocates texels that are 0. The size must suit the kind as TextureView demands.
  TextureMemory(TextureKind kind, TexelFormat format, const TextureSize& size, int levels = 1);
  TextureMemory(const TextureMemory&) = delete;
  TextureMemory& operator=(const TextureMemory&) = delete;

  TextureKind kind() const { return kind_; }
  int levels() const { return static_cast<int>(levels_.size()); }
  /// Returns all layers of a level, or one of them: to draw into (color_target, depth_target) or to fill. It must exist.
  TexelView level(int k = 0);
  TexelView layer(int layer, int level = 0) { return this->level(level).part_of_layers(layer); }

  /// Returns a view to sample. The kind must be that of the texture.
  template <TextureKind kind>
  TextureView<kind> view() const {
    HS_CHECK(kind == kind_, "TextureMemory: the view has another kind than the texture; expected the same");
    return TextureView<kind>(std::span<const ConstTexelView>(levels_));
  }

  /// Encodes a color in a texel (texel_codec.h); texels of integer formats take the integers of set_integers. The texel must exist.
  void set(int x, int y, int layer, int level, const glm::vec4& color);
  void set_integers(int x, int y, int layer, int level, const glm::ivec4& values);

  /// Computes all levels from level 0 (glGenerateMipmap). Each texel is the mean of the texels of the level before, weighted by area as in
  /// mip_chain() (texture.h), before that is rounded; sRGB is averaged in linear light. Not for integers and formats with stencil. If
  /// workers are given they share the rows; the result is bit-identical.
  void generate_mipmaps(const Workers* workers = nullptr);

 private:
  TextureKind kind_;
  TexelFormat format_;
  std::vector<std::byte, CacheLineAllocator<std::byte>> texels_;
  std::vector<ConstTexelView> levels_;
};

}  // namespace halfspace::HS_LANES
