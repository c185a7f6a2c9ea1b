// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pipeline/pass_memory.h"

#include <mutex>

namespace halfspace::HS_LANES {

namespace {

// Two passes with full bins (PassTuning::bin_budget), one of which may be a shadow map (depth_on_demand.h).
constexpr std::size_t kMaxKept = std::size_t{512} << 20;

struct Kept {
  std::mutex mutex;
  std::vector<PassMemory> idle;
  std::vector<DrawList> idle_draws;
  std::size_t bytes = 0;
};
Kept& kept() {
  static Kept k;
  return k;
}

std::size_t bytes_of(const PassMemory& m) {
  std::size_t bytes = 0;
  for (const Chunk& c : m.chunks) bytes += c.bytes();
  for (const ShadedVertices& v : m.shaded) bytes += v.bytes();
  return bytes;
}

std::size_t bytes_of(const DrawList& list) { return list.draws.capacity() * sizeof(Draw) + list.arena->bytes(); }

}  // namespace

DrawList take_draw_list() {
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (k.idle_draws.empty()) return {std::make_unique<DrawArena>(), {}};
  DrawList list = std::move(k.idle_draws.back());
  k.idle_draws.pop_back();
  k.bytes -= bytes_of(list);
  return list;
}

void return_draw_list(DrawList list) {
  list.draws.clear();
  list.arena->reset();
  const std::size_t bytes = bytes_of(list);
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (k.bytes + bytes > kMaxKept) return;
  k.bytes += bytes;
  k.idle_draws.push_back(std::move(list));
}

PassMemory take_pass_memory() {
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (k.idle.empty()) return {};
  PassMemory memory = std::move(k.idle.back());
  k.idle.pop_back();
  k.bytes -= bytes_of(memory);
  return memory;
}

void return_pass_memory(PassMemory memory) {
  const std::size_t bytes = bytes_of(memory);
  std::vector<PassMemory> oldest;  // freed after the lock is released
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  while (!k.idle.empty() && k.bytes + bytes > kMaxKept) {
    k.bytes -= bytes_of(k.idle.front());
    oldest.push_back(std::move(k.idle.front()));
    k.idle.erase(k.idle.begin());
  }
  if (k.bytes + bytes > kMaxKept) return;
  k.bytes += bytes;
  k.idle.push_back(std::move(memory));
}

}  // namespace halfspace::HS_LANES
