// SPDX-License-Identifier: Apache-2.0
//
// A pass: a target, what happens to it at start and end, and draws in order. This is the header a renderer includes.
//
//   Image<glm::u8vec4> image(640, 480);
//   Pass pass(640, 480, srgb8a8_target(image), {.format = DepthFormat::d32f});
//   pass.draw(shader, vertices(stream(positions), stream(normals)), indices, state);
//   PassStatistics statistics = pass.run(workers);
#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "halfspace/core/parallel.h"
#include "halfspace/raster/primitives/primitive_stage.h"
#include "halfspace/raster/primitives/vertex_stage.h"
#include "halfspace/raster/shade/fragment_kernel.h"
#include "halfspace/raster/tile/blend.h"

namespace halfspace {

/// How many samples a pixel has, and how a pass does its work. But for the samples, none of these changes a pixel.
struct PassOptions {
  int samples = 1;               ///< 1, 2, 4 or 8, at the standard positions; their mean is stored (of depth and stencil the first)
  bool supersample = false;      ///< every draw is shaded for each sample, as by DrawState::sample_shading
  int tile_size = kMaxTileSize;  ///< 8, 16, 32 or 64 px; smaller where samples and attachments need the room
  uint32_t chunk_triangles = kMaxPrimitivesPerChunk;  ///< submitted primitives per setup task, at the most; 1 … kMaxPrimitivesPerChunk
  std::size_t bin_budget = std::size_t{256} << 20;    ///< bytes of set-up triangles and bins before the tiles are flushed
  bool defer = true;                                  ///< false: shade every fragment at once, in order
};

/// Packets of a tile at the end of the pass, and their colours, which are replaced.
struct PostBatch {
  int tile_x0, tile_y0;  ///< window coordinates of the tile's pixel (0, 0)
  std::span<const PacketMask> packets;
  PacketColor* colors;  ///< one a packet
};

/// A functor for the end of the pass: template <class R> vec4<R> operator()(vec4<R> color) const, from the pass's colour
/// to that of the post target; for tone mapping and encoding while the tile is in cache. It may take the pixel's window
/// coordinates too: operator()(vec4<R> color, IntOf<R> x, IntOf<R> y).
using PostKernel = void (*)(const void* function, const PostBatch& batch);

namespace detail {
template <class F>
void post_kernel(const void* function, const PostBatch& batch) {
  const F& f = *static_cast<const F*>(function);
  for (std::size_t i = 0; i < batch.packets.size(); ++i) {
    PacketColor& color = batch.colors[i];
    vec4<Real> out(color[0], color[1], color[2], color[3]);
    if constexpr (std::invocable<const F&, vec4<Real>, Int, Int>) {
      const int packet = batch.packets[i].packet;
      out = f(out, Int(batch.tile_x0 + packet_x(packet)) + lane_x(), Int(batch.tile_y0 + packet_y(packet)) + lane_y());
    } else {
      out = f(out);
    }
    color = {out.x, out.y, out.z, out.w};
  }
}

/// The kernels of a shader: what it lacks is left null.
template <class S>
constexpr ShaderKernels kernels_of() {
  using V = typename S::template Varyings<float>;
  ShaderKernels k;
  k.vertex = vertex_kernel<S, true>;
  k.position = vertex_kernel<S, false>;
  k.uses_centroid = kUsesCentroid<V>;
  k.gives_point_size = kGivesPointSize<S>;
  k.gives_sprite = kGivesSprite<S>;
  static_assert(kClipDistances<S> <= kMostClipDistances);
  k.clip_distance_count = static_cast<int>(kClipDistances<S>);
  k.varying_count = static_cast<int>(kComponents<V>);
  k.interpolations = kInterpolations<V>.data();
  if constexpr (HasPrimitive<S>) {
    k.primitive = primitive_kernel<S>;
    k.primitive_count = static_cast<int>(kComponents<typename S::template Primitive<float>>);
  }
  if constexpr (HasFragmentFunction<S>) {
    static_assert(kColors<S> <= kMaxColorTargets);
    k.fragment = fragment_kernel<S>;
    k.color_count = static_cast<int>(kColors<S>);
    k.discards = kDiscards<S>;
    k.writes_depth = kWritesDepth<S>;
    k.is_constant = kIsConstant<S>;
  }
  if constexpr (HasVisibilityFunction<S>) k.visibility = visibility_kernel<S>;
  return k;
}
template <class S>
inline constexpr ShaderKernels kKernels = kernels_of<S>();

/// A copy of the shader in memory that outlives it.
template <class S>
KeptShader keep_shader(const S& shader, std::pmr::memory_resource& memory) {
  return {::new (memory.allocate(sizeof(S), alignof(S))) S(shader), [](const void* kept) { static_cast<const S*>(kept)->~S(); }};
}
}  // namespace detail

struct CoverageList;
struct DrawInTile;

class Pass {
 public:
  /// width, height: 1 … 16384 px, the size of every target. Targets' images must outlive the pass.
  /// Up to kMaxColorTargets colours: the fragment function's n-th goes to the n-th, which keeps what it has where there is none.
  template <class Colors>
  requires std::convertible_to<const Colors&, std::span<const ColorTarget>> Pass(int width, int height, const Colors& colors,
                                                                                 const DepthTarget& depth, const PassOptions& options = {})
      : Pass(std::span<const ColorTarget>(colors), width, height, depth, options) {}
  Pass(int width, int height, const ColorTarget& color, const DepthTarget& depth, const PassOptions& options = {})
      : Pass(std::span(&color, 1), width, height, depth, options) {}
  Pass(Pass&&) = default;  ///< what was moved from may only be destroyed
  Pass& operator=(Pass&&) = delete;

  /// Adds a draw. The shader is copied; the vertices' and indices' memory, and whatever the shader points to, must stay
  /// unchanged until run() returns. Indices that make no whole primitive are ignored, as GL does.
  template <class S>
  void draw(const S& shader, const VertexView& vertices, const Indices& indices, const DrawState& state = {}) {
    if constexpr (require_shader<S>()) add(shader, vertices, std::shared_ptr<const Indices>(std::shared_ptr<void>(), &indices), state);
  }
  /// The same without an index list: vertices 0, 1, 2, …
  template <class S>
  void draw(const S& shader, const VertexView& vertices, const DrawState& state = {}) {
    if constexpr (require_shader<S>())
      add(shader, vertices, std::make_shared<const Indices>(Indices::sequential(vertices.vertex_count)), state);
  }
  /// Draws depth alone (and stencil); no colour changes.
  template <DepthOnlyShader S>
  void draw_depth(const S& shader, const VertexView& vertices, const Indices& indices, const DrawState& state = {}) {
    add(shader, vertices, std::shared_ptr<const Indices>(std::shared_ptr<void>(), &indices), state);
  }

  /// Sends the finished first colour of every pixel through function into another target of the same size. The pass must have one.
  template <class F>
  void post(const F& function, const ColorTarget& target) {
    HS_CHECK(!colors_.empty() && colors_[0].format != ColorFormat::none);
    post_function_ = std::make_shared<const F>(function);
    post_kernel_ = detail::post_kernel<F>;
    post_target_ = target;
  }

  /// Runs the draws and returns what was done. The pass is then empty and may be filled again; after an exception (no memory) it may
  /// only be destroyed.
  PassStatistics run(const Workers& workers);

 private:
  Pass(std::span<const ColorTarget> colors, int width, int height, const DepthTarget& depth, const PassOptions& options);

  template <class S>
  void add(const S& shader, const VertexView& vertices, std::shared_ptr<const Indices> indices, const DrawState& state) {
    HS_CHECK_OP(vertices.components, ==, static_cast<int>(kComponents<typename S::template Attributes<float>>));
    add_draw(detail::kKernels<S>, detail::keep_shader(shader, *frame_.memory), vertices, std::move(indices), state);
  }
  void add_draw(const ShaderKernels& kernels, KeptShader shader, const VertexView& vertices, std::shared_ptr<const Indices> indices,
                const DrawState& state);

  // Work for one thread: some of a large draw's vertices, or all of the small draws [draw, end_draw).
  struct VertexTask {
    std::size_t draw, end_draw;
    std::size_t begin, end;  ///< of the vertices that the draw's indices use; of small draws all together
    bool is_part;
    Outcode any = 0;  ///< the union of a part's outcodes
  };
  // What is to be done for the draws, kept up as they come.
  struct Plan {
    std::vector<VertexTask> vertex_tasks;
    std::vector<std::vector<Segment>> chunks;
    uint64_t primitives = 0;  ///< in all chunks
    uint32_t room = 0;        ///< for primitives in the last chunk
    uint32_t records = 0;     ///< for what they may become
    PassStatistics submitted;
  };
  void add_vertex_tasks(std::size_t draw);
  void run_vertex_stage(std::span<VertexTask> tasks, const Workers& workers);
  void add_segments(uint32_t draw);
  // The tiles run once, or several times where the bins outgrow their budget.
  struct Round {
    bool first, last;
  };
  int tile_size() const;
  // Sets d.viewport, d.bounds and the depth range.
  void place_draw(Draw& d) const;
  // Sets d.writes_color. Does the draw replace all colours of a pixel?
  bool look_at_attachments(Draw& d) const;
  void run_tiles(const Workers& workers, Round round, PassStatistics& statistics);
  // Is the round all there is, so that what is flat may go into the images at once?
  bool is_alone(Round round) const { return round.first && round.last && post_kernel_ == nullptr; }
  // Fills the rows of tiles that are flat and of one colour, each in one go, which is faster than tile by tile. Which rows are left.
  std::vector<int> fill_flat_rows(const Workers& workers, PassStatistics& statistics) const;
  // The tiles [tile_x0, tile_x1) of a row of tiles.
  void run_strip(int tile_x0, int tile_x1, int tile_y, Round round, PassStatistics& statistics) const;
  void run_tile(int tile_x, int tile_y, bool drawn, Round round, PassStatistics& statistics) const;
  bool is_drawn(int tile_x, int tile_y) const;
  // The pixels of the tiles [tile_x0, tile_x1) of a row of tiles.
  PixelBounds pixels_of(int tile_x0, int tile_x1, int tile_y) const;
  void place_tile(Tile& tile, int tile_x, int tile_y) const;
  // Pixels that get one colour, and that goes into the images at once: of a draw, or (null) what they are cleared to, with their depth.
  struct FlatArea {
    PixelBounds pixels;
    const Draw* draw;
  };
  // What such tiles, [tile_x0, tile_x1) of a row, get, where nothing is drawn in them, or one or two triangles alone cover them wholly with
  // one colour; and counts what it draws. Of a round that is alone.
  std::optional<const Draw*> flat_tiles(int tile_x0, int tile_x1, int tile_y, PassStatistics& statistics) const;
  void fill_images(const FlatArea& area) const;
  void run_post_step(const Tile& tile) const;
  void draw_triangle(const DrawInTile& d, uint32_t chunk, uint32_t index, bool& waiting, CoverageList& list,
                     PassStatistics& statistics) const;
  void draw_tile(Tile& tile, int tile_x, int tile_y, PassStatistics& statistics) const;
  void keep_between_flushes();

  Frame frame_;
  Plan plan_;
  std::vector<ColorTarget> colors_;
  bool has_color_ = false;
  DepthTarget depth_;
  PassOptions options_;
  std::shared_ptr<const void> post_function_;
  PostKernel post_kernel_ = nullptr;
  ColorTarget post_target_;
  // Hold from flush to flush what no image can: a target without one, or several samples.
  std::vector<std::vector<std::byte>> color_spills_;
  std::vector<std::byte> depth_spill_;
};

}  // namespace halfspace
