// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/lanes.h"
#include "limits/limits.h"

namespace halfspace {

namespace {

using R = RealN<kLanes >= 4 ? kLanes : 4>;
using I = IntN<kLanes >= 4 ? kLanes : 4>;
constexpr int kWidth = kLanes >= 4 ? kLanes : 4;

// A chain of dependent additions, which executes one addition per cycle.
void add_chain(int repeats) {
  uint64_t x = 1;
  for (int r = 0; r < repeats; ++r) {
    for (int k = 0; k < 1000; ++k) asm volatile("add %0, %0" : "+r"(x));
  }
}

// Twelve independent chains saturate two FMA units with a latency of four to five cycles.
constexpr int kChains = 12;
void multiply_add(int repeats) {
  std::array<R, kChains> x;
  x.fill(R(1.0f));
  R a(0.999f), b(0.001f);
  asm volatile("" : "+x"(a.v), "+x"(b.v));
  for (int r = 0; r < repeats; ++r) {
    for (R& c : x) c = fma(c, a, b);
  }
  for (const R& c : x) asm volatile("" : : "x"(c.v));
}

// Gathers from pseudorandom indices. Each lane has its own sequence; the low bits are dropped. The indices do not depend on gathered
// values, so gathers can overlap.
void gather_from(const std::vector<float>& table, int repeats) {
  I place(1);
  for (int i = 0; i < kWidth; ++i) set_lane(place, i, 7919 * i + 1);
  const I mask(static_cast<int32_t>(table.size()) - 1);
  R sum(0.0f);
  for (int r = 0; r < repeats; ++r) {
    place = place * I(1664525) + I(1013904223);
    sum += gather(table.data(), (place >> 8) & mask);
  }
  asm volatile("" : : "x"(sum.v));
}

}  // namespace

std::vector<Limit> compute_limits(const LimitTimer& timer) {
  std::vector<Limit> limits;
  const double adds = timer.best_rate(1000e-9, [](int, int repeats) { add_chain(repeats); });
  limits.push_back({"clock", "GHz", adds / timer.threads()});
  limits.push_back({"fma", "GFLOP/s", timer.best_rate(2e-9 * kChains * kWidth, [](int, int repeats) { multiply_add(repeats); })});
  for (const auto& [name, bytes] :
       {std::pair{"gather L1", 16 << 10}, std::pair{"gather L2", 512 << 10}, std::pair{"gather 8 MiB", 8 << 20}}) {
    const std::vector<float> table(static_cast<std::size_t>(bytes) / sizeof(float), 1.0f);
    limits.push_back({name, "10^9 lanes/s", timer.best_rate(1e-9 * kWidth, [&](int, int repeats) { gather_from(table, repeats); })});
  }
  return limits;
}

}  // namespace halfspace
