// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pipeline/pass_memory.h"

#include <mutex>
#include <utility>

namespace halfspace::HS_LANES {

namespace {

// The memory of two passes with full bins (PassTuning::bin_budget): a picture and its shadow map (depth_on_demand.h).
constexpr std::size_t kMaxKept = std::size_t{512} << 20;

struct Kept {
  std::mutex mutex;
  std::vector<PassMemory> idle;  // the oldest first
  std::vector<DrawList> idle_draws;
  std::size_t bytes = 0, draw_bytes = 0;  // of `idle` and of `idle_draws`
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

// Takes the oldest idle pass memory out of the pool until there is room for that many bytes. Returns false, and takes nothing, if there
// cannot be. freed: receives the memory, which is to be freed when the pool is not locked.
bool make_room(Kept& k, std::size_t bytes, std::vector<PassMemory>& freed) {
  if (k.draw_bytes + bytes > kMaxKept) return false;
  while (k.bytes + k.draw_bytes + bytes > kMaxKept) {
    freed.push_back(std::move(k.idle.front()));
    k.idle.erase(k.idle.begin());
    k.bytes -= bytes_of(freed.back());
  }
  return true;
}

}  // namespace

DrawList take_draw_list() {
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (k.idle_draws.empty()) return {std::make_unique<DrawArena>(), {}};
  DrawList list = std::move(k.idle_draws.back());
  k.idle_draws.pop_back();
  k.draw_bytes -= bytes_of(list);
  return list;
}

void return_draw_list(DrawList list) {
  list.draws.clear();
  list.arena->reset();
  const std::size_t bytes = bytes_of(list);
  std::vector<PassMemory> freed;
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (!make_room(k, bytes, freed)) return;
  k.idle_draws.push_back(std::move(list));
  k.draw_bytes += bytes;
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
  std::vector<PassMemory> freed;
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (!make_room(k, bytes, freed)) return;
  k.idle.push_back(std::move(memory));
  k.bytes += bytes;
}

}  // namespace halfspace::HS_LANES
