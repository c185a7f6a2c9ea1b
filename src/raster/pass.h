// SPDX-License-Identifier: Apache-2.0
//
// A pass: color and depth attachments, load and store operations for them, and a list of draws that are executed in order. To draw with
// your own shaders, start with this header. shading/contract.h describes shaders; apps/examples contains complete programs.
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

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "halfspace/core/parallel.h"
#include "halfspace/raster/clear_values.h"
#include "halfspace/raster/detail/pass_kernels.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/pass_tuning.h"
#include "halfspace/raster/statistics.h"
#include "halfspace/raster/target.h"
#include "halfspace/raster/vertex_input.h"

namespace halfspace::HS_LANES {

/// Options of a pass.
struct PassOptions {
  /// Samples per pixel: 1, 2, 4 or 8, at the standard positions. Colors are resolved to the mean of the samples; depth and stencil are
  /// taken from sample 0. Targets with images for all samples keep them instead: see ColorTarget::samples.
  int samples = 1;
  /// Run all fragment functions once per sample, as if every draw had DrawState::sample_shading. With one sample, there is no difference.
  bool supersample = false;
  /// Layers of the targets, 1 to 2048 (layered framebuffers, OpenGL 4.6, section 9.8). All targets must have that many, and if there are
  /// several, none can store samples. A primitive is
  /// drawn into the layer that LayeredVertex states, and into layer 0 if the shader has none. A layer of the result is the same as that of
  /// a pass of its own; layers are drawn one after the other. Clears apply to all layers. There is no post step.
  int layers = 1;
  PassTuning tuning{};
};

/// A list of draws that render to the same attachments. draw() and draw_depth() record draws, and run() executes them. A Pass must only be
/// used by one thread at a time. All that tessellation and geometry functions emit is in memory while run() executes: 16 bytes and the
/// varyings of each vertex.
class Pass {
 public:
  /// Creates a pass for images of width x height pixels, each 1 to 16384. The images of all targets must have this size and must not
  /// overlap, which is checked, and must outlive the pass.
  Pass(int width, int height, const ColorTarget& color, const DepthTarget& depth, const PassOptions& options = {})
      : Pass(std::span(&color, 1), width, height, depth, options) {}
  /// Creates a pass with up to kMaxColorTargets color attachments. Fragment output n is written to attachment n. As in OpenGL, attachments
  /// without an output are left unchanged, and outputs without an attachment are ignored. A draw that leaves an attachment unchanged is
  /// slower: it is shaded at once, also where later draws cover it.
  template <class Colors>
  requires std::convertible_to<const Colors&, std::span<const ColorTarget>> Pass(int width, int height, const Colors& colors,
                                                                                 const DepthTarget& depth, const PassOptions& options = {})
      : Pass(std::span<const ColorTarget>(colors), width, height, depth, options) {}
  Pass(Pass&&) noexcept;  ///< a moved-from pass can only be destroyed
  Pass& operator=(Pass&&) = delete;
  ~Pass();

  /// Adds an indexed draw. The shader is copied. The vertices, the indices and all data that the shader points to are not copied; they must
  /// stay valid and unchanged until run() returns or, with DepthOnDemand, until that is destroyed.
  ///
  /// indices is an Indices object or a raw list without restarts: a vector, array or span of uint32_t, uint16_t or uint8_t. Raw lists are
  /// scanned on every call, so create an Indices object once for a list that is drawn repeatedly. DrawState::first and count select a part
  /// of it. Incomplete primitives at the end of a list are ignored, as in OpenGL.
  ///
  /// Every index plus DrawState::base_vertex must be a valid vertex of the view, and per-instance streams must have rows for all instances
  /// from DrawState::base_instance on. The streams must match the members of the shader's Attributes one by one; this is checked at compile
  /// time where the vertex type is known. Of a plain VertexView, the components of the streams are checked when the draw is added. Other
  /// violations fail an HS_CHECK (core/check.h), also when the draw is added.
  template <class S, class V, detail::IndexList I>
  void draw(const S& shader, const V& vertices, I&& indices, const DrawState& state = {}) {
    check_lifetime<I>();
    if constexpr (detail::require_draw<S, V>())
      detail::draw<detail::DrawKind::color>(*state_, shader, vertices, detail::view_indices(indices, vertices.vertex_count, state), state);
  }
  /// Adds a draw without indices: vertices 0, 1, 2, ... of the view, or those that DrawState::first and count select.
  template <class S, class V>
  void draw(const S& shader, const V& vertices, const DrawState& state = {}) {
    if constexpr (detail::require_draw<S, V>())
      detail::draw<detail::DrawKind::color>(*state_, shader, vertices, detail::sequential_indices(vertices.vertex_count, state), state);
  }

  /// Adds a draw for each record, in order (glMultiDrawElementsIndirect). The fields of a record replace those of the state. All draws have
  /// the same shader; a value for each draw can come from a per-instance stream, from the row DrawRecord::base_instance.
  template <class S, class V, detail::IndexList I>
  void draw_records(const S& shader, const V& vertices, I&& indices, std::span<const DrawRecord> records, const DrawState& state = {}) {
    check_lifetime<I>();
    for (const DrawRecord& r : records) draw(shader, vertices, indices, with_record(state, r));
  }
  /// The same without indices (glMultiDrawArraysIndirect, whose records have no base_vertex): `first` is a vertex.
  template <class S, class V>
  void draw_records(const S& shader, const V& vertices, std::span<const DrawRecord> records, const DrawState& state = {}) {
    for (const DrawRecord& r : records) draw(shader, vertices, with_record(state, r));
  }

  /// Adds a draw that only writes depth and stencil. The shader's fragment function, if any, is not called. Its visibility function, if
  /// any, determines coverage, and the depth if the fragment function returns one. A shader whose fragment function discards or returns a
  /// depth must have a visibility function; otherwise compilation fails.
  template <class S, class V, detail::IndexList I>
  void draw_depth(const S& shader, const V& vertices, I&& indices, const DrawState& state = {}) {
    check_lifetime<I>();
    if constexpr (detail::require_depth_draw<S, V>())
      detail::draw<detail::DrawKind::depth_only>(*state_, shader, vertices, detail::view_indices(indices, vertices.vertex_count, state),
                                                 state);
  }
  /// Adds a depth-only draw without indices.
  template <class S, class V>
  void draw_depth(const S& shader, const V& vertices, const DrawState& state = {}) {
    if constexpr (detail::require_depth_draw<S, V>())
      detail::draw<detail::DrawKind::depth_only>(*state_, shader, vertices, detail::sequential_indices(vertices.vertex_count, state),
                                                 state);
  }

  /// Sets colors, depth or stencil of a part of the target, after the draws that were added before. It counts as a draw of one triangle.
  void clear(const ClearValues& values);

  /// Passes the final color of each pixel in the first attachment through a functor and stores the result in another target of the same
  /// size. This happens while the tile is in cache and is intended for tone mapping and encoding. The functor is copied. It must have
  /// `template <class R> vec4<R> operator()(vec4<R> color) const`, or the same with window coordinates: `operator()(vec4<R> color,
  /// IntOf<R> x, IntOf<R> y)`. The format of the first color attachment must not be none. The target must have an image of the size of the
  /// pass with one sample, which must not overlap those that are stored; this is checked.
  template <class F>
  void post(const F& function, const ColorTarget& target) {
    detail::set_post_step(*state_, {std::make_shared<const F>(function), detail::post_kernel<F>, target});
  }

  /// Executes all draws, removes them from the pass and returns statistics. The pass can then be reused with the same attachments and post
  /// step. If run() throws (out of memory, or an exception from the check handler), the pass can only be destroyed.
  PassStatistics run(const Workers& workers);

 private:
  friend detail::PassAccess;

  Pass(std::span<const ColorTarget> colors, int width, int height, const DepthTarget& depth, const PassOptions& options);

  template <class I>
  static constexpr void check_lifetime() {
    static_assert(std::is_lvalue_reference_v<I> || std::ranges::borrowed_range<I>,
                  "the index list is a temporary; it must stay valid until Pass::run() returns");
  }
  std::unique_ptr<detail::PassState> state_;
};

}  // namespace halfspace::HS_LANES
