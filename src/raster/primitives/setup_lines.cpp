// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/setup_lines.h"

#include "halfspace/raster/primitives/append_lines.h"
#include "halfspace/raster/primitives/setup_clipped.h"

namespace halfspace::HS_LANES {

namespace {

void submit_line(SetupRange& r) {
  const PrimitiveSlots id = r.next_slots();
  const ShadedVertices& shaded = r.shaded;
  const Outcode any = shaded.outcodes[id[0]] | shaded.outcodes[id[1]];
  const Outcode all = shaded.outcodes[id[0]] & shaded.outcodes[id[1]] & kOutView;
  const uint32_t beyond_0 = r.beyond_distances(id[0]), beyond_1 = r.beyond_distances(id[1]);
  if (any & kOutNonFinite) {
    ++r.chunk.statistics.culled_non_finite;
  } else if (all || (beyond_0 & beyond_1) != 0) {
    ++r.chunk.statistics.culled_outside;
  } else if (const bool is_cut = (any & kOutNeedsClip) != 0 || r.is_clipped_by(beyond_0 | beyond_1); is_cut || r.context.samples > 1) {
    set_up_clipped(r, id, clip_line, is_cut);
  } else {
    const uint32_t provoking = r.draw.state.provoking == ProvokingVertex::first ? 0 : 1;
    r.count(append_line(r, {&shaded.screen[id[0]], &shaded.screen[id[1]]}, {id[0], id[1]}, 0, provoking, Facing::front));
  }
}

}  // namespace

void set_up_lines(SetupRange& range, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    submit_line(range);
    range.record_primitive(i);
  }
}

}  // namespace halfspace::HS_LANES
