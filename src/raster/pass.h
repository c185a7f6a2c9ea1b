// SPDX-License-Identifier: Apache-2.0
//
// A pass: colour and depth attachments, what happens to them at start and end, and draws in order. Start here to draw with shaders of your
// own; shading/contract.h says what a shader is, and apps/examples has complete programs.
//
//   Image<glm::u8vec4> image(640, 480);
//   Pass pass(640, 480, srgb8a8_target(image), {.format = DepthFormat::d32f});
//   std::vector<glm::vec3> positions = ...;
//   std::vector<glm::vec2> uvs = ...;
//   std::vector<uint32_t> indices = ...;
//   pass.draw(MyShader{...}, make_vertex_view(stream(positions), stream(uvs)), indices);
//   Workers workers(Workers::cores());
//   PassStatistics statistics = pass.run(workers);
#pragma once

#include <memory>
#include <span>

#include "halfspace/core/parallel.h"
#include "halfspace/raster/detail/pass_kernels.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/statistics.h"
#include "halfspace/raster/target.h"
#include "halfspace/raster/vertex_input.h"

namespace halfspace {

/// Samples per pixel, and how a pass does its work. Only `samples` and `supersample` change pixels.
struct PassOptions {
  int samples = 1;                   ///< 1, 2, 4 or 8, at the standard positions. Stored are their mean, of depth and stencil sample 0
  bool supersample = false;          ///< every draw is shaded per sample, as by DrawState::sample_shading
  int tile_size = 64;                ///< 8, 16, 32 or 64 px; less is taken where samples and attachments need the memory
  uint32_t chunk_triangles = 8192;   ///< submitted primitives per setup task, at most; 1 … 8192
  std::size_t bin_budget = 1 << 28;  ///< bytes of set-up triangles and bins before the tiles are flushed
  bool defer = true;                 ///< false: every fragment is shaded at once, in submission order
};

class Pass {
 public:
  /// A pass over images of width x height px, each 1 … 16384. The images of all targets must outlive the pass.
  Pass(int width, int height, const ColorTarget& color, const DepthTarget& depth, const PassOptions& options = {})
      : Pass(std::span(&color, 1), width, height, depth, options) {}
  /// The same with a range of up to kMaxColorTargets colour attachments. Fragment output n is written to attachment n; attachments without
  /// an output are left unchanged.
  template <class Colors>
  requires std::convertible_to<const Colors&, std::span<const ColorTarget>> Pass(int width, int height, const Colors& colors,
                                                                                 const DepthTarget& depth, const PassOptions& options = {})
      : Pass(std::span<const ColorTarget>(colors), width, height, depth, options) {}
  Pass(Pass&&) noexcept;  ///< a moved-from pass may only be destroyed
  Pass& operator=(Pass&&) = delete;
  ~Pass();

  /// Adds an indexed draw. The shader is copied. Vertices, indices and what the shader points to are not: they must exist and stay
  /// unchanged until run() returns. indices is an Indices, or a vector, array or span of uint32_t or uint16_t, which is scanned at each
  /// call: make an Indices once for lists that are drawn often. Every index plus DrawState::base_vertex must be a vertex of the view.
  /// Trailing indices that complete no primitive are ignored, as in OpenGL. The view's streams must match the members of the shader's
  /// Attributes.
  template <class S, class V, detail::IndexList I>
  void draw(const S& shader, const V& vertices, I&& indices, const DrawState& state = {}) {
    check_lifetime<I>();
    if constexpr (detail::require_draw<S, V>())
      detail::draw<detail::DrawKind::color>(*state_, shader, vertices, detail::view_indices(indices, vertices.vertex_count), state);
  }
  /// Adds a draw without an index list: vertices 0, 1, 2, ... of the view.
  template <class S, class V>
  void draw(const S& shader, const V& vertices, const DrawState& state = {}) {
    if constexpr (detail::require_draw<S, V>())
      detail::draw<detail::DrawKind::color>(*state_, shader, vertices, sequential(vertices), state);
  }

  /// Adds a draw of depth and stencil only. The shader's fragment function, if it has one, is not run; a visibility function is.
  template <class S, class V, detail::IndexList I>
  void draw_depth(const S& shader, const V& vertices, I&& indices, const DrawState& state = {}) {
    check_lifetime<I>();
    if constexpr (detail::require_depth_draw<S, V>())
      detail::draw<detail::DrawKind::depth_only>(*state_, shader, vertices, detail::view_indices(indices, vertices.vertex_count), state);
  }
  template <class S, class V>
  void draw_depth(const S& shader, const V& vertices, const DrawState& state = {}) {
    if constexpr (detail::require_depth_draw<S, V>())
      detail::draw<detail::DrawKind::depth_only>(*state_, shader, vertices, sequential(vertices), state);
  }

  /// Sends the finished first colour of every pixel through a functor into another target of the pass's size, while the tile is in cache:
  /// for tone mapping and encoding. The functor has template <class R> vec4<R> operator()(vec4<R> color) const, from the pass's colour to
  /// that of the target, or the same with the pixel's window coordinates: operator()(vec4<R> color, IntOf<R> x, IntOf<R> y). It is copied.
  /// The pass must have a colour attachment with a format.
  template <class F>
  void post(const F& function, const ColorTarget& target) {
    detail::set_post_step(*state_, {std::make_shared<const F>(function), detail::post_kernel<F>, target});
  }

  /// Runs the draws and returns what was done. The pass is then empty and may be filled again. If run() throws (no memory, or a check
  /// handler that throws), the pass may only be destroyed.
  PassStatistics run(const Workers& workers);

 private:
  Pass(std::span<const ColorTarget> colors, int width, int height, const DepthTarget& depth, const PassOptions& options);

  template <class I>
  static constexpr void check_lifetime() {
    static_assert(std::is_lvalue_reference_v<I> || std::ranges::borrowed_range<I>,
                  "the index list is a temporary; it must exist until Pass::run() returns");
  }
  static std::shared_ptr<const Indices> sequential(const VertexView& vertices) {
    return std::make_shared<const Indices>(Indices::sequential(vertices.vertex_count));
  }

  std::unique_ptr<detail::PassState> state_;
};

}  // namespace halfspace
