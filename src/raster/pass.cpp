// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pass.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "halfspace/core/float_mode.h"
#include "halfspace/raster/amplify/emit_primitives.h"
#include "halfspace/raster/depth_pyramid.h"
#include "halfspace/raster/detail/clear_draw.h"
#include "halfspace/raster/detail/draw_placement.h"
#include "halfspace/raster/detail/emitted_draws.h"
#include "halfspace/raster/detail/run_pass.h"
#include "halfspace/raster/detail/state_checks.h"
#include "halfspace/raster/detail/target_checks.h"
#include "halfspace/raster/loop/pass_rounds.h"
#include "halfspace/raster/primitives/cull_clusters.h"
#include "halfspace/raster/primitives/primitive_assembly.h"
#include "halfspace/raster/primitives/vertex_stage.h"
#include "halfspace/raster/tile/blend.h"
#include "halfspace/raster/tile/tile_format.h"

namespace halfspace::HS_LANES {

namespace {

// Memory limit of a tile in bytes, chosen so that it stays in the L2 cache.
constexpr int kTileBudget = 160 << 10;

}  // namespace

namespace detail {

class PassState {
 public:
  PassState(int width, int height, std::span<const ColorTarget> colors, const DepthTarget& depth, const PassOptions& options);

  // Returns the memory for a new draw.
  std::pmr::memory_resource& memory();
  void add_draw(const ShaderKernels& kernels, KeptShader shader, const VertexView& vertices, std::shared_ptr<const Indices> indices,
                const DrawState& state);
  void set_post_step(PostStep post);
  // The last draw applies to all layers.
  void mark_clear() { context_.draws.back().is_clear = true; }
  const Attachments& attachments() const { return attachments_; }
  int layers() const { return options_.layers; }
  PassStatistics run(TileRunner& tiles, const Workers& workers);
  // Runs the pass, but keeps what the tiles of the last round read until release() is called.
  PassStatistics run_and_keep(TileRunner& tiles, const Workers& workers);
  void release();
  RecordedPass recorded() const { return {context_, attachments_, options_.layers}; }

 private:
  int tile_size() const;
  // Checks that the depths are those of ClusterCulling::hidden_by, or fail more.
  void check_pyramid(const DrawState& state) const;
  void note_depth_changes(const DepthState& depth);
  void check_color_types(const ShaderKernels& kernels) const;
  // Such passes are planned layer by layer, when they run.
  bool runs_layers() const { return has_emitting_ || options_.layers > 1; }
  PassStatistics run_layers(TileRunner& tiles, const Workers& workers);
  void return_draws();
  // Sets d.writes_color. Returns true if the draw replaces all colors of a pixel.
  bool set_color_writes(Draw& d) const;

  PassContext context_;
  Attachments attachments_;
  PassOptions options_;
  PassPlan plan_;
  PassMemory spare_;                                        // of the last run
  uint32_t layer_group_ = 0;                                // of the last draw
  bool may_lower_depth_ = false, may_raise_depth_ = false;  // what the draws so far can do to stored depths
  bool has_emitting_ = false;                               // some draw has emitting stages
};

PassState::PassState(int width, int height, std::span<const ColorTarget> colors, const DepthTarget& depth, const PassOptions& options)
    : options_(options), plan_(options.samples, options.tuning.chunk_triangles) {
  attachments_.colors.assign(colors.begin(), colors.end());
  attachments_.depth = depth;
  HS_CHECK(width >= 1 && width <= kMaxTargetSize && height >= 1 && height <= kMaxTargetSize,
           "Pass: the size is outside of its range; expected a width and a height from 1 to 16384");
  HS_CHECK(
      options.tuning.tile_size == 8 || options.tuning.tile_size == 16 || options.tuning.tile_size == 32 || options.tuning.tile_size == 64,
      "PassTuning: the tile size is not supported; expected 8, 16, 32 or 64");
  HS_CHECK(options.tuning.chunk_triangles >= 1 && options.tuning.chunk_triangles <= kMaxPrimitivesPerChunk,
           "PassTuning: the number of triangles per chunk is outside of its range; expected 1 to 8192");
  HS_CHECK(options.samples == 1 || options.samples == 2 || options.samples == 4 || options.samples == 8,
           "PassOptions: the number of samples is not supported; expected 1, 2, 4 or 8");
  HS_CHECK(options.layers >= 1 && options.layers <= kMaxLayers,
           "PassOptions: the number of layers is outside of its range; expected 1 to 2048");
  HS_CHECK_OP(colors.size(), <=, std::size_t{kMaxColorTargets}, "Pass: too many color targets; expected at most 12");
  for (const ColorTarget& c : colors) {
    if (c.format == ColorFormat::none) continue;
    HS_CHECK(can_be_drawn(c.format),
             "Pass: the format of a color target cannot be drawn to; expected one that is neither a depth format nor rgb9_e5");
    check_target(c, width, height, options.samples, options.layers);
    for (const ColorTarget* other = colors.data(); other != &c; ++other) {
      if (other->format != ColorFormat::none) check_overlap(*other, c);
    }
    attachments_.has_color = true;
  }
  if (depth.format != DepthFormat::none) {
    HS_CHECK(is_depth(depth.format), "Pass: the format of the depth target has no depth; expected d16, d24, d32f, d24s8 or d32fs8");
    check_target(depth, width, height, options.samples, options.layers);
    for (const ColorTarget& c : colors) {
      if (c.format != ColorFormat::none) check_overlap(c, depth);
    }
  }
  context_.width = width;
  context_.height = height;
  context_.samples = options.samples;
  context_.samples_at = sample_span(options.samples);
  context_.tile_size = tile_size();
  context_.tiles_x = (width + context_.tile_size - 1) / context_.tile_size;
  context_.tiles_y = (height + context_.tile_size - 1) / context_.tile_size;
  context_.depth_format = depth_part(depth.format);
}

int PassState::tile_size() const {
  int sample_bytes = 9;  // depth, triangle id, stencil
  for (const ColorTarget& c : attachments_.colors) sample_bytes += bytes_in_tile(c.format);
  int size = std::min(options_.tuning.tile_size, largest_tile(options_.samples));
  while (size > kBlockSize && sample_bytes * options_.samples * size * size > kTileBudget) size /= 2;
  return size;
}

std::pmr::memory_resource& PassState::memory() {
  if (context_.arena == nullptr) {
    DrawList list = take_draw_list();
    context_.arena = std::move(list.arena);
    context_.draws = std::move(list.draws);
  }
  return *context_.arena;
}

void PassState::add_draw(const ShaderKernels& kernels, KeptShader shader, const VertexView& vertices,
                         std::shared_ptr<const Indices> indices, const DrawState& state) {
  check_vertices(vertices, *indices, state);
  check_instances(vertices, state);
  // Most draws have the same state as the one before.
  const Draw* const equal = !context_.draws.empty() && context_.draws.back().state == state ? &context_.draws.back() : nullptr;
  if (equal == nullptr) check_state(state, attachments_);
  HS_CHECK(
      !kernels.gives_point_sprite || draws_points(state),
      "Pass::draw: the shader computes rectangles of points, but no points are drawn; expected Topology::points or PolygonMode::point");
  HS_CHECK(!state.condition || options_.layers == 1, "DrawState::condition: the pass has several layers; expected one");
  HS_CHECK(!kernels.tests_early || !state.order_independent,
           "DrawState: order_independent is combined with a shader that has early_fragment_tests; expected one of them");
  check_color_types(kernels);
  check_topology(kernels, state);
  HS_CHECK(state.viewports == nullptr || kernels.gives_layer,
           "DrawState::viewports: the shader does not choose among them; expected null, or a shader that returns a LayeredVertex");
  for (std::size_t i = 0; i < attachments_.colors.size(); ++i) {
    const std::optional<BlendState>& blend = blend_of(state, i);
    HS_CHECK(!blend || !uses_second_source(*blend) || (kernels.color_count > 1 && attachments_.colors.size() == 1),
             "DrawState: blend factors use a second source; expected a shader with two colors and one color target");
  }
  const DrawPlacement placement =
      equal != nullptr ? static_cast<const DrawPlacement&>(*equal) : place_draw(state, context_, attachments_, options_.supersample);
  const DrawState& kept = equal != nullptr ? equal->state : keep(state, memory());
  Draw& d = context_.draws.emplace_back(kernels, std::move(shader), std::move(indices),
                                        keep_streams(vertices, state.base_instance, memory()), kept, placement);
  d.number = static_cast<uint32_t>(context_.draws.size() - 1);
  d.vertex_count = d.indices->used_count() * state.instances;
  count_primitives(d);
  if (state.clusters) check_clusters(d);
  check_pyramid(state);
  note_depth_changes(state.depth);
  const bool replaces = set_color_writes(d);
  const bool decides_visibility = (kernels.discards && !kernels.tests_early) || kernels.writes_depth;
  // Without color attachments, there is nothing to blend.
  const bool may_defer = !attachments_.has_color || (options_.tuning.defer && replaces && !state.order_independent);
  // After the tests, some fragments are not written, or not with their own color.
  const bool may_emit_smooth = kernels.emitting != nullptr && (state.line_smooth || state.polygon_smooth);
  const bool changes_colors = d.is_smooth || may_emit_smooth || d.covers_by_alpha || d.covers_by_shader || d.sets_alpha_to_one ||
                              (attachments_.has_color && (state.logic_op || (kernels.discards && kernels.tests_early)));
  d.deferred = may_defer && !changes_colors && (!decides_visibility || kernels.visibility != nullptr);
  if (d.writes_color && !state.order_independent) ++layer_group_;
  d.layer_group = layer_group_;
  has_emitting_ |= kernels.emitting != nullptr;
  if (!runs_layers()) plan_.add(d, context_.draws.size() - 1);
}

void PassState::check_pyramid(const DrawState& state) const {
  if (!state.clusters || state.clusters->hidden_by == nullptr) return;
  const DepthTarget& depth = attachments_.depth;
  HS_CHECK(
      depth.load == LoadOp::load && depth.samples == 1 && state.clusters->hidden_by->is_of(depth),
      "ClusterCulling::hidden_by: the pass does not load the depth from which the pyramid was built; expected LoadOp::load, one sample "
      "and the same target");
  const CompareOp compare = state.depth.compare;
  HS_CHECK(
      !(may_raise_depth_ && (compare == CompareOp::less || compare == CompareOp::less_equal)) &&
          !(may_lower_depth_ && (compare == CompareOp::greater || compare == CompareOp::greater_equal)),
      "ClusterCulling::hidden_by: a draw or clear before this draw can change depths so that more passes than in the pyramid; expected "
      "draws with the same direction of `compare`");
}

void PassState::note_depth_changes(const DepthState& depth) {
  if (!depth.test || !depth.write) return;
  switch (depth.compare) {
    case CompareOp::never:
    case CompareOp::equal: return;
    case CompareOp::less:
    case CompareOp::less_equal: may_lower_depth_ = true; return;
    case CompareOp::greater:
    case CompareOp::greater_equal: may_raise_depth_ = true; return;
    case CompareOp::not_equal:
    case CompareOp::always: may_lower_depth_ = may_raise_depth_ = true; return;
  }
}

void PassState::check_color_types(const ShaderKernels& kernels) const {
  if (kernels.fragment == nullptr || kernels.color_types == nullptr) return;
  for (std::size_t i = 0; i < std::min(attachments_.colors.size(), static_cast<std::size_t>(kernels.color_count)); ++i) {
    const ColorFormat format = attachments_.colors[i].format;
    HS_CHECK(
        format == ColorFormat::none || kernels.color_types[i] == color_type(format),
        "Pass::draw: a color of the shader has another type than its attachment; expected ivec4 for signed integers, uvec4 for unsigned "
        "integers, and vec4 for all others");
  }
}

bool PassState::set_color_writes(Draw& d) const {
  bool replaces = true;
  for (std::size_t i = 0; i < attachments_.colors.size(); ++i) {
    const std::optional<BlendState>& blend = blend_of(d.state, i);
    const ColorMask& mask = color_mask_of(d.state, i);
    if (attachments_.colors[i].format == ColorFormat::none) continue;
    const bool has_color = d.kernels.fragment != nullptr && static_cast<int>(i) < d.kernels.color_count;
    replaces &= has_color && !blend && mask.all();
    d.writes_color |= has_color && (mask.r || mask.g || mask.b || mask.a);
  }
  return replaces;
}

PassStatistics PassState::run_layers(TileRunner& tiles, const Workers& workers) {
  PassStatistics statistics;
  EmittedDraws draws(context_, attachments_, options_.layers, options_.supersample, workers, statistics);
  for (int layer = 0; layer < options_.layers; ++layer) {
    draws.set_layer(layer);
    PassPlan plan(context_.samples, options_.tuning.chunk_triangles);
    for (std::size_t i = 0; i < context_.draws.size(); ++i) plan.add(context_.draws[i], i);
    Attachments attachments = attachments_;
    for (ColorTarget& c : attachments.colors) c = layer_of(c, layer);
    attachments.depth = layer_of(attachments.depth, layer);
    statistics += run_rounds(context_, attachments, std::move(plan), options_.tuning.bin_budget, tiles, workers, spare_);
    release_rounds(context_, std::exchange(spare_, {}));
  }
  context_.draws.clear();
  return statistics;
}

PassStatistics PassState::run(TileRunner& tiles, const Workers& workers) {
  if (!runs_layers()) {
    PassStatistics statistics = run_and_keep(tiles, workers);
    release();
    return statistics;
  }
  const FloatMode float_mode;
  PassStatistics statistics = run_layers(tiles, workers);
  plan_ = PassPlan(context_.samples, options_.tuning.chunk_triangles);  // it has the draws before the first that emits primitives
  has_emitting_ = false;
  return_draws();
  return statistics;
}

PassStatistics PassState::run_and_keep(TileRunner& tiles, const Workers& workers) {
  HS_DCHECK(!runs_layers());
  const FloatMode float_mode;
  PassPlan plan = std::exchange(plan_, PassPlan(context_.samples, options_.tuning.chunk_triangles));
  return run_rounds(context_, attachments_, std::move(plan), options_.tuning.bin_budget, tiles, workers, spare_);
}

void PassState::release() {
  release_rounds(context_, std::exchange(spare_, {}));
  return_draws();
}

void PassState::return_draws() {
  if (context_.arena != nullptr) return_draw_list({std::exchange(context_.arena, {}), std::exchange(context_.draws, {})});
}

void PassState::set_post_step(PostStep post) {
  HS_CHECK(!attachments_.colors.empty() && attachments_.colors[0].format != ColorFormat::none,
           "Pass::post: the pass has no color target; expected one");
  HS_CHECK(options_.layers == 1, "Pass::post: the pass has several layers; expected one");
  HS_CHECK(post.target.format != ColorFormat::none, "Pass::post: the target has no format; expected an image");
  HS_CHECK(!is_integer(attachments_.colors[0].format), "Pass::post: the first color target has integers; expected another format");
  HS_CHECK(can_be_drawn(post.target.format) && !is_integer(post.target.format),
           "Pass::post: the target cannot store colors; expected a format that is neither integers, a depth format nor rgb9_e5");
  check_target(post.target, context_.width, context_.height, 1, 1);
  for (const ColorTarget& c : attachments_.colors) {
    if (c.format != ColorFormat::none && is_stored(c)) check_overlap(c, post.target);
  }
  attachments_.post = std::move(post);
}

std::pmr::memory_resource& memory_of(PassState& state) { return state.memory(); }

void add_draw(PassState& state, const ShaderKernels& kernels, KeptShader shader, const VertexView& vertices,
              std::shared_ptr<const Indices> indices, const DrawState& draw_state) {
  state.add_draw(kernels, std::move(shader), vertices, std::move(indices), draw_state);
}

void set_post_step(PassState& state, PostStep post) { state.set_post_step(std::move(post)); }

struct PassAccess {
  static PassState& state_of(Pass& pass) { return *pass.state_; }
  static const PassState& state_of(const Pass& pass) { return *pass.state_; }
};

}  // namespace detail

Pass::Pass(std::span<const ColorTarget> colors, int width, int height, const DepthTarget& depth, const PassOptions& options)
    : state_(std::make_unique<detail::PassState>(width, height, colors, depth, options)) {}
Pass::Pass(Pass&&) noexcept = default;
Pass::~Pass() = default;

namespace {

class DrawTiles : public TileRunner {
 public:
  void run(const PassContext& context, const Attachments& attachments, Round round, const Workers& workers,
           PassStatistics& statistics) override {
    run_tiles(context, attachments, round, workers, statistics);
  }
};

}  // namespace

void Pass::clear(const ClearValues& values) {
  detail::add_clear(*state_, state_->attachments(), values);
  state_->mark_clear();
}

PassStatistics Pass::run(const Workers& workers) {
  DrawTiles tiles;
  return state_->run(tiles, workers);
}

PassStatistics run_with(Pass& pass, TileRunner& tiles, const Workers& workers) {
  HS_CHECK(detail::PassAccess::state_of(pass).layers() == 1,
           "Pass: the stages of a pass with several layers cannot be inspected; expected one");
  return detail::PassAccess::state_of(pass).run(tiles, workers);
}
PassStatistics run_and_keep_triangles(Pass& pass, TileRunner& tiles, const Workers& workers) {
  return detail::PassAccess::state_of(pass).run_and_keep(tiles, workers);
}
void release_triangles(Pass& pass) { detail::PassAccess::state_of(pass).release(); }
RecordedPass recorded_pass(const Pass& pass) { return detail::PassAccess::state_of(pass).recorded(); }

}  // namespace halfspace::HS_LANES
