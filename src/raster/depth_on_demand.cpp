// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/depth_on_demand.h"

#include <mutex>
#include <new>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/raster/detail/run_pass.h"

namespace halfspace::HS_LANES {

namespace {

// Leaves the tiles of a pass with one round for later, and draws those of a pass with several rounds.
class DeferTiles final : public TileRunner {
 public:
  bool drew_all_tiles = false;

  void run(const PassContext& context, const Attachments& attachments, Round round, const Workers& workers,
           PassStatistics& statistics) override {
    drew_all_tiles = !(round.first && round.last);
    if (drew_all_tiles) run_tiles(context, attachments, round, workers, statistics);
  }
};

// Returns what the pass has recorded, if it can be drawn on demand.
RecordedPass checked(const Pass& pass) {
  const RecordedPass recorded = recorded_pass(pass);
  const DepthTarget& depth = recorded.attachments.depth;
  HS_CHECK(recorded.layers == 1, "DepthOnDemand: the pass has several layers; expected one");
  HS_CHECK(recorded.context.samples == 1, "DepthOnDemand: the pass has several samples; expected one");
  HS_CHECK(!recorded.attachments.has_color, "DepthOnDemand: the pass has a color target; expected none");
  HS_CHECK(depth.format != DepthFormat::none && depth.data != nullptr && depth.store == StoreOp::store,
           "DepthOnDemand: the pass stores no depth; expected a depth target with an image and StoreOp::store");
  for (const Draw& d : recorded.context.draws) {
    HS_CHECK(d.kernels.emitting == nullptr, "DepthOnDemand: the shader of a draw emits primitives; expected a vertex function only");
    HS_CHECK(!d.state.query && !d.state.timer && !d.state.condition,
             "DepthOnDemand: a draw has a query, a timer or a condition; expected none of them");
  }
  return recorded;
}

}  // namespace

class DepthOnDemand::State final : public TilesOnDemand {
 public:
  State(Pass&& pass, const RecordedPass& recorded, const Workers& workers)
      : TilesOnDemand(recorded.context.width, recorded.context.height, recorded.context.tile_size),
        recorded_(recorded),
        pass_(std::move(pass)),
        statistics_(run_and_keep_triangles(pass_, tiles_, workers)) {
    if (tiles_.drew_all_tiles) release_triangles(pass_);
  }
  ~State() override {
    if (tiles_.drew_all_tiles) return;
    try {
      release_triangles(pass_);
    } catch (const std::bad_alloc&) {  // the memory is freed with the pass
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void draw_all(const Workers& workers) const {
    const int tiles_x = recorded_.context.tiles_x;
    workers.for_each(tiles_x * recorded_.context.tiles_y, [&](int i) { require_tile(i % tiles_x, i / tiles_x); });
  }
  PassStatistics statistics() const {
    const std::lock_guard lock(mutex_);
    return statistics_;
  }

 private:
  void draw(int tile_x, int tile_y) const override {
    if (tiles_.drew_all_tiles) return;
    const FloatMode float_mode;
    PassStatistics of_tile;
    run_single_tile(recorded_.context, recorded_.attachments, tile_x, tile_y, of_tile);
    const std::lock_guard lock(mutex_);
    statistics_ += of_tile;  // counters, whose sum does not depend on the order
  }

  const RecordedPass recorded_;  // of pass_
  Pass pass_;
  DeferTiles tiles_;
  mutable std::mutex mutex_;  // for statistics_
  mutable PassStatistics statistics_;
};

DepthOnDemand::DepthOnDemand(Pass pass, const Workers& workers)
    : state_(std::make_unique<State>(std::move(pass), checked(pass), workers)) {}
DepthOnDemand::~DepthOnDemand() = default;
const TilesOnDemand& DepthOnDemand::tiles() const { return *state_; }
void DepthOnDemand::draw_all(const Workers& workers) const { state_->draw_all(workers); }
PassStatistics DepthOnDemand::statistics() const { return state_->statistics(); }

}  // namespace halfspace::HS_LANES
