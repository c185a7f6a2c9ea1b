// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/depth_on_demand.h"

#include <utility>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/raster/detail/run_pass.h"

namespace halfspace::HS_LANES {

namespace {

// Keeps the last round of a pass, if it is the only one; otherwise draws all tiles.
class KeepRound final : public TileRunner {
 public:
  const PassContext* context = nullptr;
  const Attachments* attachments = nullptr;
  bool is_drawn = false;

  void run(const PassContext& c, const Attachments& a, Round round, const Workers& workers, PassStatistics& statistics) override {
    context = &c;
    attachments = &a;
    is_drawn = !(round.first && round.last);
    if (is_drawn) run_tiles(c, a, round, workers, statistics);
  }
};

// Runs the pass up to binning.
struct BinnedPass {
  Pass pass;
  KeepRound round;
  PassStatistics statistics;

  BinnedPass(Pass p, const Workers& workers) : pass(std::move(p)), statistics(run_and_keep(pass, round, workers)) {
    const Attachments& a = *round.attachments;
    HS_CHECK(!a.has_color, "DepthOnDemand: the pass has a color target; expected none");
    HS_CHECK(round.context->samples == 1, "DepthOnDemand: the pass has several samples; expected one");
    HS_CHECK(a.depth.format != DepthFormat::none && a.depth.data != nullptr && a.depth.store == StoreOp::store,
             "DepthOnDemand: the pass stores no depth; expected a depth target with an image and StoreOp::store");
    for (const Draw& d : round.context->draws) {
      HS_CHECK(!d.state.query && !d.state.timer && !d.state.condition,
               "DepthOnDemand: a draw has a query, a timer or a condition; expected none of them");
    }
    if (round.is_drawn) release(pass);
  }
  ~BinnedPass() {
    if (!round.is_drawn) release(pass);
  }
};

}  // namespace

class DepthOnDemand::State final : private BinnedPass, public TilesOnDemand {
 public:
  State(Pass p, const Workers& workers)
      : BinnedPass(std::move(p), workers),
        TilesOnDemand(round.context->width, round.context->height, round.context->tile_size),
        by_tile_(static_cast<std::size_t>(tile_count())) {}

  void draw_all(const Workers& workers) const {
    workers.for_each(tile_count(), [&](int i) { require_tile(i % round.context->tiles_x, i / round.context->tiles_x); });
  }
  PassStatistics sum() const {
    PassStatistics all = statistics;
    for (const PassStatistics& s : by_tile_) all += s;
    return all;
  }

 private:
  int tile_count() const { return round.context->tiles_x * round.context->tiles_y; }
  void draw(int tile_x, int tile_y) const override {
    if (round.is_drawn) return;
    const FloatMode float_mode;
    PassStatistics& tile = by_tile_[static_cast<std::size_t>(tile_y * round.context->tiles_x + tile_x)];
    tile = {};  // if a shader threw before
    run_single_tile(*round.context, *round.attachments, tile_x, tile_y, tile);
  }

  mutable std::vector<PassStatistics> by_tile_;
};

DepthOnDemand::DepthOnDemand(Pass pass, const Workers& workers) : state_(std::make_unique<State>(std::move(pass), workers)) {}
DepthOnDemand::~DepthOnDemand() = default;
const TilesOnDemand& DepthOnDemand::tiles() const { return *state_; }
void DepthOnDemand::draw_all(const Workers& workers) const { state_->draw_all(workers); }
PassStatistics DepthOnDemand::statistics() const { return state_->sum(); }

}  // namespace halfspace::HS_LANES
