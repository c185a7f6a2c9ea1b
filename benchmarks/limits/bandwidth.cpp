// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>

#include "halfspace/core/lanes.h"
#include "limits/limits.h"

namespace halfspace {

namespace {

// The vector width of the build, but at least 128 bits, because scalar builds also use 128-bit stores.
constexpr int kWidth = kLanes >= 4 ? kLanes : 4;
using Vector = IntN<kWidth>;
constexpr std::size_t kStep = 8;  // vectors per loop iteration

// These keep the compiler from optimizing away unused results.
HS_INLINE void keep(const Vector& v) { asm volatile("" : : "x"(v.v)); }
HS_INLINE void keep_memory() { asm volatile("" : : : "memory"); }

using Buffer = std::vector<Vector>;

void store_to(Buffer& to, int repeats) {
  const Vector value(1);
  for (int r = 0; r < repeats; ++r) {
    for (std::size_t i = 0; i < to.size(); i += kStep) {
      for (std::size_t k = 0; k < kStep; ++k) to[i + k] = value;
    }
    keep_memory();
  }
}

void store_past_caches(Buffer& to, int repeats) {
  for (int r = 0; r < repeats; ++r) {
    const __m128i value = _mm_set1_epi32(r);
    auto* const p = reinterpret_cast<__m128i*>(to.data());
    const std::size_t n = to.size() * sizeof(Vector) / sizeof(__m128i);
    for (std::size_t i = 0; i < n; i += 4) {
      for (std::size_t k = 0; k < 4; ++k) _mm_stream_si128(p + i + k, value);
    }
    _mm_sfence();
  }
}

void read_from(const Buffer& from, int repeats) {
  std::array<Vector, kStep> sum;
  sum.fill(Vector(0));
  for (int r = 0; r < repeats; ++r) {
    keep_memory();
    for (std::size_t i = 0; i < from.size(); i += kStep) {
      for (std::size_t k = 0; k < kStep; ++k) sum[k] = sum[k] ^ from[i + k];
    }
  }
  for (const Vector& v : sum) keep(v);
}

void copy(Buffer& to, const Buffer& from, int repeats) {
  for (int r = 0; r < repeats; ++r) {
    for (std::size_t i = 0; i < to.size(); i += kStep) {
      for (std::size_t k = 0; k < kStep; ++k) to[i + k] = from[i + k];
    }
    keep_memory();
  }
}

struct Place {
  const char* name;
  std::size_t bytes;  // per thread
};
// Sizes: half of a 32 KiB L1 cache, half of a 1 MiB L2 cache, and far more than one core's share of the last-level cache.
constexpr std::array<Place, 3> kPlaces{{{"L1", 16 << 10}, {"L2", 512 << 10}, {"memory", 256 << 20}}};

void add_place(const Place& place, const LimitTimer& timer, std::vector<Limit>& limits) {
  const auto threads = static_cast<std::size_t>(timer.threads());
  std::vector<Buffer> a(threads, Buffer(place.bytes / sizeof(Vector))), b = a;
  const double gb = 1e-9 * static_cast<double>(place.bytes);
  const auto add = [&](const char* what, double units, const std::function<void(Buffer&, Buffer&, int)>& work) {
    const double rate = timer.best_rate(units, [&](int t, int repeats) {
      const auto i = static_cast<std::size_t>(t);
      work(a[i], b[i], repeats);
    });
    limits.push_back({std::string(what) + " " + place.name, "GB/s", rate});
  };
  add("store", gb, [](Buffer& x, Buffer&, int repeats) { store_to(x, repeats); });
  add("read", gb, [](Buffer& x, Buffer&, int repeats) { read_from(x, repeats); });
  // Source and destination share the cache, so each gets half of it.
  if (place.bytes < (1 << 20)) {
    for (std::size_t t = 0; t < threads; ++t) {
      a[t].resize(a[t].size() / 2);
      b[t].resize(b[t].size() / 2);
    }
    add("copy", gb / 2, [](Buffer& x, Buffer& y, int repeats) { copy(x, y, repeats); });
    return;
  }
  add("copy", gb, [](Buffer& x, Buffer& y, int repeats) { copy(x, y, repeats); });
  add("store past caches", gb, [](Buffer& x, Buffer&, int repeats) { store_past_caches(x, repeats); });
}

}  // namespace

std::vector<Limit> bandwidth_limits(const LimitTimer& timer) {
  std::vector<Limit> limits;
  for (const Place& place : kPlaces) add_place(place, timer, limits);
  return limits;
}

std::vector<Limit> frame_limits(const LimitTimer& timer) {
  std::vector<Limit> limits;
  for (const auto& [name, width, height] : {std::tuple{"memset 1920x1080", 1920, 1080}, std::tuple{"memset 512x512", 512, 512}}) {
    const std::size_t bytes = 4u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::size_t share = bytes / static_cast<std::size_t>(timer.threads());
    std::vector<unsigned char> frame(bytes);
    const double rate = timer.best_rate(1e-9 * static_cast<double>(share), [&](int t, int repeats) {
      for (int r = 0; r < repeats; ++r) {
        std::memset(&frame[static_cast<std::size_t>(t) * share], r, share);
        keep_memory();
      }
    });
    limits.push_back({name, "GB/s", rate});
  }
  return limits;
}

}  // namespace halfspace
