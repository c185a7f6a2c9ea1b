// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/amplify/emitted_primitives.h"

#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

namespace {

// Where a part starts.
struct Place {
  std::size_t value = 0, index = 0, primitive = 0;
};

template <class T>
void copy_to(CacheLineVector<T>& to, std::size_t begin, const CacheLineVector<T>& from) {
  std::ranges::copy(from, to.begin() + static_cast<std::ptrdiff_t>(begin));
}

}  // namespace

EmittedPrimitives joined(std::vector<EmittedPrimitives> parts, std::size_t row, Topology topology, const Workers& workers) {
  std::vector<Place> places;
  Place end;
  for (const EmittedPrimitives& p : parts) {
    places.push_back(end);
    end = {end.value + p.rows.size(), end.index + p.indices.size(), end.primitive + p.numbers.size()};
  }
  HS_CHECK_OP(end.value / row, <, std::size_t{1} << 32, "Pass::run: the stages of a draw emit too many vertices; expected fewer than 2^32");
  EmittedPrimitives all{.rows = CacheLineVector<float>(end.value),
                        .row = row,
                        .topology = topology,
                        .indices = CacheLineVector<uint32_t>(end.index),
                        .numbers = CacheLineVector<int32_t>(end.primitive),
                        .instances = CacheLineVector<int32_t>(end.primitive)};
  workers.for_each(static_cast<int>(parts.size()), [&](int i) {
    const EmittedPrimitives part = std::move(parts[static_cast<std::size_t>(i)]);
    const Place& place = places[static_cast<std::size_t>(i)];
    const auto first = static_cast<uint32_t>(place.value / row);
    copy_to(all.rows, place.value, part.rows);
    for (std::size_t k = 0; k < part.indices.size(); ++k) all.indices[place.index + k] = first + part.indices[k];
    copy_to(all.numbers, place.primitive, part.numbers);
    copy_to(all.instances, place.primitive, part.instances);
  });
  return all;
}

}  // namespace halfspace::HS_LANES
