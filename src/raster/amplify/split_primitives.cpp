// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/amplify/split_primitives.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <map>
#include <span>

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kSplitPerTask = 4096;
// Instances with fewer vertices are listed as primitives, because many of them would be many draws.
constexpr std::size_t kMinInstanceVertices = 8;

Destination destination_of(const EmittedPrimitives& primitives, std::size_t vertex, const SplitOptions& options) {
  const float* const row = primitives.rows.data() + primitives.row * vertex;
  return {options.layers == 1 ? 0 : std::bit_cast<int32_t>(row[options.place]), std::bit_cast<int32_t>(row[options.place + 1])};
}

// Consecutive primitives of the same layer and viewport. Runs keep the search for a part from taking time for each primitive.
struct Run {
  Destination to;
  std::size_t begin, end;
};

// Returns the runs of primitives [begin, end), without those that no layer or viewport receives.
std::vector<Run> runs_of(const EmittedPrimitives& primitives, const SplitOptions& options, std::size_t begin, std::size_t end) {
  const std::size_t corners = primitives.vertices_per_primitive();
  const std::size_t provoking = options.first_provokes ? 0 : corners - 1;
  std::vector<Run> runs;
  for (std::size_t i = begin; i < end; ++i) {
    const Destination to = destination_of(primitives, primitives.indices[i * corners + provoking], options);
    if (!options.is_drawn(to)) continue;
    if (!runs.empty() && runs.back().to == to && runs.back().end == i)
      ++runs.back().end;
    else
      runs.push_back({to, i, i + 1});
  }
  return runs;
}

template <class T>
CacheLineVector<T> values_of(const std::vector<Run>& runs, const CacheLineVector<T>& from, std::size_t per_primitive) {
  std::size_t count = 0;
  for (const Run& r : runs) count += r.end - r.begin;
  CacheLineVector<T> values;
  values.reserve(count * per_primitive);
  for (const Run& r : runs) values.insert(values.end(), from.data() + r.begin * per_primitive, from.data() + r.end * per_primitive);
  return values;
}

}  // namespace

std::vector<PrimitivePart> split_primitives(const EmittedPrimitives& primitives, const SplitOptions& options, const Workers& workers) {
  const std::size_t count = primitives.primitive_count();
  std::vector<std::vector<Run>> found((count + kSplitPerTask - 1) / kSplitPerTask);
  workers.for_each(static_cast<int>(found.size()), [&](int i) {
    const std::size_t begin = static_cast<std::size_t>(i) * kSplitPerTask;
    found[static_cast<std::size_t>(i)] = runs_of(primitives, options, begin, std::min(begin + kSplitPerTask, count));
  });
  std::vector<PrimitivePart> parts;
  std::vector<std::vector<Run>> runs;        // of each part
  std::map<Destination, std::size_t> open;   // the part to which primitives of a layer and viewport are added
  std::map<int32_t, int32_t> last_viewport;  // of each layer
  for (const std::vector<Run>& list : found) {
    for (const Run& r : list) {
      const auto last = last_viewport.find(r.to.layer);
      const bool changes = options.viewports_overlap && last != last_viewport.end() && last->second != r.to.viewport;
      last_viewport[r.to.layer] = r.to.viewport;
      const auto [at, is_new] = open.try_emplace(r.to, parts.size());
      if (is_new || changes) {
        at->second = parts.size();
        parts.push_back({r.to, {}, {}, {}});
        runs.emplace_back();
      }
      runs[at->second].push_back(r);
    }
  }
  workers.for_each(static_cast<int>(parts.size()), [&](int i) {
    PrimitivePart& part = parts[static_cast<std::size_t>(i)];
    const std::vector<Run>& from = runs[static_cast<std::size_t>(i)];
    part.indices = values_of(from, primitives.indices, primitives.vertices_per_primitive());
    part.numbers = values_of(from, primitives.numbers, 1);
    part.instances = values_of(from, primitives.instances, 1);
  });
  return parts;
}

std::optional<std::vector<InstanceRun>> split_instances(const Draw& draw, VertexKernel layer, const SplitOptions& options,
                                                        const Workers& workers) {
  check_vertex_count(draw);
  const std::size_t vertices = draw.indices->used_count();
  if (vertices < kMinInstanceVertices) return std::nullopt;
  const std::size_t per_instance = (vertices + kVerticesPerTask - 1) / kVerticesPerTask;
  std::vector<std::optional<Destination>> found(draw.state.instances * per_instance);  // of each task
  std::atomic<bool> is_mixed = false;
  workers.for_each(static_cast<int>(found.size()), [&](int i) {
    if (is_mixed.load(std::memory_order_relaxed)) return;
    const auto task = static_cast<std::size_t>(i);
    const std::size_t first = task / per_instance * vertices, begin = task % per_instance * kVerticesPerTask;
    found[task] = common_destination(draw, layer, first + begin, first + std::min(begin + kVerticesPerTask, vertices), options.layers > 1);
    if (!found[task]) is_mixed.store(true, std::memory_order_relaxed);
  });
  if (is_mixed) return std::nullopt;
  std::vector<InstanceRun> runs;
  for (uint32_t i = 0; i < draw.state.instances; ++i) {
    const std::span of_instance = std::span(found).subspan(i * per_instance, per_instance);
    const Destination to = *of_instance[0];
    if (std::ranges::count(of_instance, to) != std::ssize(of_instance)) return std::nullopt;
    if (!options.is_drawn(to)) continue;
    if (!runs.empty() && runs.back().to == to && runs.back().first + runs.back().count == i)
      ++runs.back().count;
    else
      runs.push_back({to, i, 1});
  }
  return runs;
}

}  // namespace halfspace::HS_LANES
