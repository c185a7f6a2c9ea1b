// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/inspect/inspection.h"

#include "halfspace/raster/detail/run_pass.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace::HS_LANES {

namespace {

class TraceTiles : public TileRunner {
 public:
  explicit TraceTiles(PassTrace& trace) : trace_(trace) {}
  bool inspects_primitives() const override { return true; }

  void run(const PassContext& context, const Attachments& attachments, Round round, const Workers& workers,
           PassStatistics& statistics) override {
    if (round.first) begin(context, attachments);
    run_tiles(context, attachments, round, workers, statistics, {.trace = &trace_});
    name_primitives(context);
  }

 private:
  void begin(const PassContext& context, const Attachments& attachments) {
    trace_ = {};
    trace_.width = context.width;
    trace_.height = context.height;
    trace_.samples = context.samples;
    if (!attachments.colors.empty()) trace_.format = attachments.colors[0].format;
    trace_.resolved.resize(static_cast<std::size_t>(context.width) * static_cast<std::size_t>(context.height));
    trace_.values.resize(trace_.resolved.size() * static_cast<std::size_t>(context.samples));
  }

  // Sets the draw, instance and primitive of the fragments of the last round.
  void name_primitives(const PassContext& context) {
    std::vector<std::vector<SubmittedPrimitive>> primitives;
    for (const Chunk& c : context.chunks) primitives.push_back(submitted_primitives(context, c));
    for (TileFragments& tile : trace_.rounds.back()) {
      for (TracedFragment& f : tile.fragments) {
        const Chunk& chunk = context.chunks[chunk_of(f.id)];
        const DrawRange& range = chunk.ranges[chunk.triangles[index_in_chunk(f.id)].range()];
        const Draw& draw = context.draws[range.draw];
        const uint32_t primitive = primitives[chunk_of(f.id)][index_in_chunk(f.id)].primitive;
        const PrimitiveNumber number = submitted_primitive(draw, range.instance, primitive);
        f.draw = draw.number;
        f.instance = number.instance;
        f.primitive = number.primitive;
      }
    }
  }

  PassTrace& trace_;
};

class TimeTiles : public TileRunner {
 public:
  explicit TimeTiles(std::vector<float>& ms) : ms_(ms) {}

  void run(const PassContext& context, const Attachments& attachments, Round round, const Workers& workers,
           PassStatistics& statistics) override {
    if (round.first) ms_.assign(static_cast<std::size_t>(context.tiles_x) * static_cast<std::size_t>(context.tiles_y), 0.0f);
    run_tiles(context, attachments, round, workers, statistics, {.ms = ms_});
  }

 private:
  std::vector<float>& ms_;
};

class VisitSetUp : public TileRunner {
 public:
  explicit VisitSetUp(const std::function<void(const PassContext&, int)>& visit) : visit_(visit) {}
  bool inspects_primitives() const override { return true; }

  void run(const PassContext& context, const Attachments&, Round, const Workers&, PassStatistics&) override { visit_(context, round_++); }

 private:
  const std::function<void(const PassContext&, int)>& visit_;
  int round_ = 0;
};

}  // namespace

PassStatistics run_traced(Pass& pass, const Workers& workers, PassTrace& trace) {
  TraceTiles tiles(trace);
  return run_with(pass, tiles, workers);
}

PassStatistics run_timed(Pass& pass, const Workers& workers, std::vector<float>& ms) {
  TimeTiles tiles(ms);
  return run_with(pass, tiles, workers);
}

void visit_set_up(Pass& pass, const Workers& workers, const std::function<void(const PassContext& context, int round)>& visit) {
  VisitSetUp tiles(visit);
  run_with(pass, tiles, workers);
}

TriangleInspector::TriangleInspector(const PassContext& context) : context_(context) {
  for (const Chunk& chunk : context.chunks) primitives_.push_back(submitted_primitives(context, chunk));
}

void TriangleInspector::find(TriangleId id, InspectedTriangle& out) const {
  const Chunk& chunk = context_.chunks[chunk_of(id)];
  const DrawRange& range = chunk.ranges[chunk.triangles[index_in_chunk(id)].range()];
  const ShadedVertices& shaded = context_.shaded[range.draw];
  const SubmittedPrimitive& submitted = primitives_[chunk_of(id)][index_in_chunk(id)];
  find_triangle(context_, id, out.source);
  out.draw = &context_.draws[range.draw];
  out.primitive = submitted.primitive;
  out.instance = range.instance;
  out.slot = submitted.vertex;
  const uint32_t slot_base = shaded.first - range.instance * shaded.count;
  for (std::size_t i = 0; i < 3; ++i) out.index[i] = out.slot[i] + slot_base;
  out.position_cs = clip_positions(*out.draw, range.instance, out.index);
}

}  // namespace halfspace::HS_LANES
