// SPDX-License-Identifier: Apache-2.0
//
// Pairs of lanes: two independent groups of lanes that are processed together, one operation at a time.
//
// A shader is a long chain of dependent operations, and an out-of-order window of a few hundred instructions finds little else to execute.
// Interleaving two such chains keeps the execution units busy. RealPair<H>, IntPair<H> and MaskPair<H>, where H is float or RealN<W>, are
// used like lanes (lanes.h). The results of each half are bit-identical to those of a separate computation.
#pragma once

#include <functional>

#include "halfspace/core/transpose.h"

namespace halfspace::HS_LANES {

template <class H>
struct RealPair;
template <class H>
struct IntPair;

namespace detail {

/// Applies f, a sum, difference or product, with wrapping arithmetic. Also works for plain int32_t.
template <class I, class F>
HS_INLINE I wrapping(I a, I b, F f) {
  if constexpr (std::is_same_v<I, int32_t>) {
    return static_cast<int32_t>(f(static_cast<uint32_t>(a), static_cast<uint32_t>(b)));
  } else {
    return f(a, b);
  }
}

}  // namespace detail

/// Booleans that belong to a RealPair<H>.
template <class H>
struct MaskPair {
  using Half = MaskOf<H>;
  Half low, high;

  MaskPair() = default;
  HS_INLINE MaskPair(bool b) : low(b), high(b) {}
  HS_INLINE static MaskPair of(Half l, Half h) {
    MaskPair m;
    m.low = l;
    m.high = h;
    return m;
  }

  friend HS_INLINE MaskPair operator&(MaskPair a, MaskPair b) { return of(Half(a.low & b.low), Half(a.high & b.high)); }
  friend HS_INLINE MaskPair operator|(MaskPair a, MaskPair b) { return of(Half(a.low | b.low), Half(a.high | b.high)); }
  friend HS_INLINE MaskPair operator^(MaskPair a, MaskPair b) { return of(Half(a.low ^ b.low), Half(a.high ^ b.high)); }
  friend HS_INLINE MaskPair operator!(MaskPair a) { return of(!a.low, !a.high); }
  friend HS_INLINE MaskPair operator&&(MaskPair a, MaskPair b) { return a & b; }
  friend HS_INLINE MaskPair operator||(MaskPair a, MaskPair b) { return a | b; }
  HS_INLINE MaskPair& operator&=(MaskPair b) { return *this = *this & b; }
  HS_INLINE MaskPair& operator|=(MaskPair b) { return *this = *this | b; }

  friend HS_INLINE bool any(MaskPair m) { return halfspace::any(Half(m.low | m.high)); }
  friend HS_INLINE bool all(MaskPair m) { return halfspace::all(Half(m.low & m.high)); }
  friend HS_INLINE bool none(MaskPair m) { return !any(m); }
  friend HS_INLINE MaskPair select(MaskPair m, MaskPair a, MaskPair b) {
    return of(halfspace::select(m.low, a.low, b.low), halfspace::select(m.high, a.high, b.high));
  }
};

/// The integer counterpart of RealPair<H>.
template <class H>
struct IntPair {
  using Half = IntOf<H>;
  using M = MaskPair<H>;
  Half low, high;

  IntPair() = default;
  HS_INLINE IntPair(int32_t s) : low(s), high(s) {}
  HS_INLINE IntPair(Half l, Half h) : low(l), high(h) {}

  friend HS_INLINE IntPair operator+(IntPair a, IntPair b) { return wrapping(a, b, std::plus()); }
  friend HS_INLINE IntPair operator-(IntPair a, IntPair b) { return wrapping(a, b, std::minus()); }
  friend HS_INLINE IntPair operator*(IntPair a, IntPair b) { return wrapping(a, b, std::multiplies()); }
  friend HS_INLINE IntPair operator-(IntPair a) { return IntPair(0) - a; }
  friend HS_INLINE IntPair operator&(IntPair a, IntPair b) { return {a.low & b.low, a.high & b.high}; }
  friend HS_INLINE IntPair operator|(IntPair a, IntPair b) { return {a.low | b.low, a.high | b.high}; }
  friend HS_INLINE IntPair operator^(IntPair a, IntPair b) { return {a.low ^ b.low, a.high ^ b.high}; }
  friend HS_INLINE IntPair operator~(IntPair a) { return {~a.low, ~a.high}; }
  friend HS_INLINE IntPair operator<<(IntPair a, int n) { return {a.low << (n & 31), a.high << (n & 31)}; }
  friend HS_INLINE IntPair operator>>(IntPair a, int n) { return {a.low >> (n & 31), a.high >> (n & 31)}; }
  friend HS_INLINE IntPair operator<<(IntPair a, IntPair n) { return {a.low << (n.low & 31), a.high << (n.high & 31)}; }
  friend HS_INLINE IntPair operator>>(IntPair a, IntPair n) { return {a.low >> (n.low & 31), a.high >> (n.high & 31)}; }

  friend HS_INLINE IntPair int_divide(IntPair a, IntPair b) { return {int_divide(a.low, b.low), int_divide(a.high, b.high)}; }
  friend HS_INLINE IntPair int_modulo(IntPair a, IntPair b) { return {int_modulo(a.low, b.low), int_modulo(a.high, b.high)}; }
  friend HS_INLINE IntPair operator/(IntPair a, IntPair b) { return int_divide(a, b); }
  friend HS_INLINE IntPair operator%(IntPair a, IntPair b) { return int_modulo(a, b); }
  HS_INLINE IntPair& operator+=(IntPair b) { return *this = *this + b; }
  HS_INLINE IntPair& operator-=(IntPair b) { return *this = *this - b; }

  friend HS_INLINE M operator<(IntPair a, IntPair b) { return M::of(a.low < b.low, a.high < b.high); }
  friend HS_INLINE M operator<=(IntPair a, IntPair b) { return M::of(a.low <= b.low, a.high <= b.high); }
  friend HS_INLINE M operator>(IntPair a, IntPair b) { return M::of(a.low > b.low, a.high > b.high); }
  friend HS_INLINE M operator>=(IntPair a, IntPair b) { return M::of(a.low >= b.low, a.high >= b.high); }
  friend HS_INLINE M operator==(IntPair a, IntPair b) { return M::of(a.low == b.low, a.high == b.high); }
  friend HS_INLINE M operator!=(IntPair a, IntPair b) { return M::of(a.low != b.low, a.high != b.high); }

  friend HS_INLINE IntPair min(IntPair a, IntPair b) { return {halfspace::min(a.low, b.low), halfspace::min(a.high, b.high)}; }
  friend HS_INLINE IntPair max(IntPair a, IntPair b) { return {halfspace::max(a.low, b.low), halfspace::max(a.high, b.high)}; }
  friend HS_INLINE IntPair select(M m, IntPair a, IntPair b) {
    return {halfspace::select(m.low, a.low, b.low), halfspace::select(m.high, a.high, b.high)};
  }

 private:
  template <class F>
  HS_INLINE static IntPair wrapping(IntPair a, IntPair b, F f) {
    return {detail::wrapping(a.low, b.low, f), detail::wrapping(a.high, b.high, f)};
  }
};

/// Floating-point numbers in two halves of type H.
template <class H>
struct RealPair {
  using Half = H;
  using I = IntPair<H>;
  using M = MaskPair<H>;
  H low, high;

  RealPair() = default;
  HS_INLINE RealPair(float s) : low(s), high(s) {}
  HS_INLINE RealPair(H l, H h) : low(l), high(h) {}

  friend HS_INLINE RealPair operator+(RealPair a, RealPair b) { return {a.low + b.low, a.high + b.high}; }
  friend HS_INLINE RealPair operator-(RealPair a, RealPair b) { return {a.low - b.low, a.high - b.high}; }
  friend HS_INLINE RealPair operator*(RealPair a, RealPair b) { return {a.low * b.low, a.high * b.high}; }
  friend HS_INLINE RealPair operator/(RealPair a, RealPair b) { return {a.low / b.low, a.high / b.high}; }
  friend HS_INLINE RealPair operator-(RealPair a) { return {-a.low, -a.high}; }
  friend HS_INLINE RealPair operator+(RealPair a) { return a; }
  HS_INLINE RealPair& operator+=(RealPair b) { return *this = *this + b; }
  HS_INLINE RealPair& operator-=(RealPair b) { return *this = *this - b; }
  HS_INLINE RealPair& operator*=(RealPair b) { return *this = *this * b; }
  HS_INLINE RealPair& operator/=(RealPair b) { return *this = *this / b; }

  friend HS_INLINE M operator<(RealPair a, RealPair b) { return M::of(a.low < b.low, a.high < b.high); }
  friend HS_INLINE M operator<=(RealPair a, RealPair b) { return M::of(a.low <= b.low, a.high <= b.high); }
  friend HS_INLINE M operator>(RealPair a, RealPair b) { return M::of(a.low > b.low, a.high > b.high); }
  friend HS_INLINE M operator>=(RealPair a, RealPair b) { return M::of(a.low >= b.low, a.high >= b.high); }
  friend HS_INLINE M operator==(RealPair a, RealPair b) { return M::of(a.low == b.low, a.high == b.high); }
  friend HS_INLINE M operator!=(RealPair a, RealPair b) { return M::of(a.low != b.low, a.high != b.high); }

  friend HS_INLINE RealPair min(RealPair a, RealPair b) { return {halfspace::min(a.low, b.low), halfspace::min(a.high, b.high)}; }
  friend HS_INLINE RealPair max(RealPair a, RealPair b) { return {halfspace::max(a.low, b.low), halfspace::max(a.high, b.high)}; }
  friend HS_INLINE RealPair abs(RealPair a) { return {halfspace::abs(a.low), halfspace::abs(a.high)}; }
  friend HS_INLINE RealPair sqrt(RealPair a) { return {halfspace::sqrt(a.low), halfspace::sqrt(a.high)}; }
  friend HS_INLINE RealPair floor(RealPair a) { return {halfspace::floor(a.low), halfspace::floor(a.high)}; }
  friend HS_INLINE RealPair round_even(RealPair a) { return {halfspace::round_even(a.low), halfspace::round_even(a.high)}; }
  friend HS_INLINE RealPair fma(RealPair a, RealPair b, RealPair c) {
    return {halfspace::fma(a.low, b.low, c.low), halfspace::fma(a.high, b.high, c.high)};
  }
  friend HS_INLINE RealPair select(M m, RealPair a, RealPair b) {
    return {halfspace::select(m.low, a.low, b.low), halfspace::select(m.high, a.high, b.high)};
  }
  friend HS_INLINE I as_int(RealPair a) { return {halfspace::as_int(a.low), halfspace::as_int(a.high)}; }
  friend HS_INLINE I truncate_to_int(RealPair a) { return {halfspace::truncate_to_int(a.low), halfspace::truncate_to_int(a.high)}; }
  friend HS_INLINE I round_to_int(RealPair a) { return {halfspace::round_to_int(a.low), halfspace::round_to_int(a.high)}; }
};

template <class H>
struct LaneTraits<RealPair<H>> {
  static constexpr int width = 2 * kWidthOf<H>;
  using Int = IntPair<H>;
  using Uint = UintLanes<IntPair<H>>;
  using Mask = MaskPair<H>;
};
template <class H>
inline constexpr bool kIsLanes<RealPair<H>> = true;
template <class H>
inline constexpr bool kIsIntLanes<IntPair<H>> = true;
template <class R>
inline constexpr bool kIsPair = false;
template <class H>
inline constexpr bool kIsPair<RealPair<H>> = true;
template <class H>
inline constexpr uint32_t kAllBits<MaskPair<H>> = kAllBits<MaskOf<H>> << kWidthOf<H> | kAllBits<MaskOf<H>>;

/// Returns half i of a pair: 0 is low, 1 is high.
template <int i, class T>
HS_INLINE auto& half(T& pair) {
  if constexpr (i == 0) {
    return pair.low;
  } else {
    return pair.high;
  }
}

/// The number type of fragment shading: two SIMD packets of the width of this build.
using FragmentReal = RealPair<Real>;

template <class H>
HS_INLINE uint32_t bits(MaskPair<H> m) {
  return bits(m.low) | bits(m.high) << kWidthOf<H>;
}

template <class H>
HS_INLINE RealPair<H> gather(const float* base, IntPair<H> i) {
  return {gather(base, i.low), gather(base, i.high)};
}
template <class H>
HS_INLINE IntPair<H> gather(const int32_t* base, IntPair<H> i) {
  return {gather(base, i.low), gather(base, i.high)};
}
template <int N, class Word, class H>
HS_INLINE auto gather_row(const Word* base, IntPair<H> i) {
  const auto low = gather_row<N>(base, i.low), high = gather_row<N>(base, i.high);
  std::array<decltype(gather(base, i)), N> row;
  for (std::size_t n = 0; n < N; ++n) row[n] = {low[n], high[n]};
  return row;
}
template <class H>
HS_INLINE IntPair<H> look_up(const std::array<int32_t, 16>& table, IntPair<H> i) {
  return {look_up(table, i.low), look_up(table, i.high)};
}
template <class H>
HS_INLINE RealPair<H> as_real(IntPair<H> i) {
  return {as_real(i.low), as_real(i.high)};
}
template <class R, class H>
HS_INLINE RealPair<H> to_real(IntPair<H> i) {
  return {to_real<H>(i.low), to_real<H>(i.high)};
}
template <class H>
HS_INLINE float lane(RealPair<H> r, int i) {
  return i < kWidthOf<H> ? lane(r.low, i) : lane(r.high, i - kWidthOf<H>);
}
template <class H>
HS_INLINE int32_t lane(IntPair<H> r, int i) {
  return i < kWidthOf<H> ? lane(r.low, i) : lane(r.high, i - kWidthOf<H>);
}
template <class H>
HS_INLINE bool lane(MaskPair<H> r, int i) {
  return i < kWidthOf<H> ? lane(r.low, i) : lane(r.high, i - kWidthOf<H>);
}
template <class H>
HS_INLINE void set_lane(RealPair<H>& r, int i, float x) {
  i < kWidthOf<H> ? set_lane(r.low, i, x) : set_lane(r.high, i - kWidthOf<H>, x);
}
template <class H>
HS_INLINE void set_lane(IntPair<H>& r, int i, int32_t x) {
  i < kWidthOf<H> ? set_lane(r.low, i, x) : set_lane(r.high, i - kWidthOf<H>, x);
}

}  // namespace halfspace::HS_LANES
