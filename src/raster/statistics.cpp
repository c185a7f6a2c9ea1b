// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/statistics.h"

namespace halfspace::HS_LANES {

PassStatistics& PassStatistics::operator+=(const PassStatistics& o) {
  vertices_in += o.vertices_in;
  vertices_shaded += o.vertices_shaded;
  patches_in += o.patches_in;
  vertices_evaluated += o.vertices_evaluated;
  geometry_invocations += o.geometry_invocations;
  primitives_in += o.primitives_in;
  culled_cluster += o.culled_cluster;
  culled_non_finite += o.culled_non_finite;
  culled_outside += o.culled_outside;
  culled_face += o.culled_face;
  culled_degenerate += o.culled_degenerate;
  culled_no_sample += o.culled_no_sample;
  clipped += o.clipped;
  triangles_binned += o.triangles_binned;
  bin_entries += o.bin_entries;
  samples_tested += o.samples_tested;
  samples_passed += o.samples_passed;
  fragments_shaded += o.fragments_shaded;
  layers_merged += o.layers_merged;
  tiles_touched += o.tiles_touched;
  flushes += o.flushes;
  for (std::size_t i = 0; i < o.queries.size(); ++i) add_to_query(i, o.queries[i], o.query_primitives[i]);
  for (std::size_t i = 0; i < o.times.size(); ++i) add_time(i, o.times[i]);
  return *this;
}

DrawTime& DrawTime::operator+=(const DrawTime& o) {
  setup += o.setup;
  visibility += o.visibility;
  shading += o.shading;
  return *this;
}

void PassStatistics::add_time(std::size_t timer, const DrawTime& time) {
  if (times.size() <= timer) times.resize(timer + 1);
  times[timer] += time;
}

void PassStatistics::add_to_query(std::size_t query, uint64_t samples, uint64_t primitives) {
  if (queries.size() <= query) {
    queries.resize(query + 1);
    query_primitives.resize(query + 1);
  }
  queries[query] += samples;
  query_primitives[query] += primitives;
}

}  // namespace halfspace::HS_LANES
