// SPDX-License-Identifier: Apache-2.0
//
// Frames of several passes, drawn by Halfspace and by Mesa: each pass draws into textures that later passes sample.
#pragma once

#include <optional>
#include <vector>

#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture_memory.h"
#include "mesa/mesa_draw.h"

namespace halfspace::test {

/// A texture in both renderers. Row 0 is the bottom row in both.
class TwinTexture {
 public:
  TwinTexture(TextureKind kind, TexelFormat format, const TextureSize& size, int levels = 1);
  TwinTexture(const TwinTexture&) = delete;
  TwinTexture& operator=(const TwinTexture&) = delete;
  ~TwinTexture();

  TextureMemory& ours() { return memory_; }
  template <TextureKind kind>
  TextureView<kind> view() const {
    return memory_.view<kind>();
  }
  unsigned mesa() const { return id_; }
  TextureKind kind() const { return memory_.kind(); }
  TexelFormat format() const { return format_; }
  const TextureSize& size() const { return size_; }

  /// Copies all levels of ours() to Mesa. Not for multisample textures.
  void upload();
  /// Copies level 0 of Mesa's texture to `texels`, which has the same kind, format and size. Not for multisample textures.
  void download(TextureMemory& texels) const;
  /// Copies the layers of a 2D array, which has been uploaded, to the samples of this texture, in both renderers.
  void copy_samples(TwinTexture& layers);
  /// Sets the texels of level 0 in both: color(x, y, layer) returns a glm::vec4.
  template <class F>
  void fill(const F& color) {
    for (int layer = 0; layer < size_.depth; ++layer)
      for (int y = 0; y < size_.height; ++y)
        for (int x = 0; x < size_.width; ++x) memory_.set(x, y, layer, 0, color(x, y, layer));
    upload();
  }
  /// Computes the other levels of level 0 and copies them to Mesa, so both sample the same texels.
  void generate_mipmaps() {
    memory_.generate_mipmaps();
    upload();
  }

 private:
  TextureMemory memory_;
  TexelFormat format_;
  TextureSize size_;
  unsigned id_ = 0;
};

/// A layer of level 0 of a texture that a pass clears and draws into.
struct TwinTarget {
  TwinTexture& texture;
  glm::vec4 clear = glm::vec4(0.0f);  ///< the first component of a depth
  int layer = 0;
};

/// A pass in both renderers.
class TwinStage {
 public:
  explicit TwinStage(std::vector<TwinTarget> colors, std::optional<TwinTarget> depth = {});

  /// Adds a draw to both. `set` receives a UniformSetter for the GLSL program. All that the draw refers to must outlive run(). An empty
  /// list of indices draws all vertices in order. A shader without a fragment function writes only depth.
  template <class S, class V, class F>
  void draw(const S& shader, const char* vertex_glsl, const char* fragment_glsl, const V& vertices, const std::vector<uint32_t>& indices,
            const F& set, const DrawState& state = {}) {
    if constexpr (!Shader<S>) {
      pass_.draw_depth(shader, vertices, indices, state);
    } else if (indices.empty()) {
      pass_.draw(shader, vertices, state);
    } else {
      pass_.draw(shader, vertices, indices, state);
    }
    add_to_mesa(vertex_glsl, fragment_glsl, vertices, indices, set, state);
  }
  void run();

 private:
  void add_to_mesa(const char* vertex_glsl, const char* fragment_glsl, const VertexView& vertices, const std::vector<uint32_t>& indices,
                   const std::function<void(const UniformSetter&)>& set, const DrawState& state);

  std::vector<TwinTarget> colors_;
  std::optional<TwinTarget> depth_;
  Pass pass_;
  std::vector<MesaDraw> mesa_draws_;
};

/// How two pictures may differ: at most `share` of the pixels may have a channel that differs by more than `codes` codes of 8 bits.
struct PictureTolerance {
  int codes = 1;
  double share = 0.0;
  const char* reason;  ///< is printed with the result
};
/// Compares the texels of a texture of format rgba8. Both must show something: at least `colors` different colors. If the
/// environment variable HALFSPACE_MESA_PIXELS is set, the pixels beyond the tolerance are printed.
void expect_same_picture(TwinTexture& texture, const PictureTolerance& tolerance, std::size_t colors = 50);

}  // namespace halfspace::test
