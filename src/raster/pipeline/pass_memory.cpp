// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/pipeline/pass_memory.h"

#include <mutex>

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kMaxKept = std::size_t{256} << 20;

struct Kept {
  std::mutex mutex;
  std::vector<PassMemory> idle;
  std::vector<std::vector<Draw>> idle_draws;
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

}  // namespace

std::vector<Draw> take_draw_list() {
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (k.idle_draws.empty()) return {};
  std::vector<Draw> draws = std::move(k.idle_draws.back());
  k.idle_draws.pop_back();
  k.bytes -= draws.capacity() * sizeof(Draw);
  return draws;
}

void return_draw_list(std::vector<Draw> draws) {
  draws.clear();
  const std::size_t bytes = draws.capacity() * sizeof(Draw);
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (bytes == 0 || k.bytes + bytes > kMaxKept) return;
  k.bytes += bytes;
  k.idle_draws.push_back(std::move(draws));
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
  Kept& k = kept();
  const std::lock_guard lock(k.mutex);
  if (k.bytes + bytes > kMaxKept) return;
  k.bytes += bytes;
  k.idle.push_back(std::move(memory));
}

}  // namespace halfspace::HS_LANES
