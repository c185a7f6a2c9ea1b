// SPDX-License-Identifier: Apache-2.0
//
// SIMD lanes: W pixels, vertices or triangles processed at once.
//
// RealN<W>, IntN<W> and MaskN<W> wrap the vector extension of GCC and Clang. Every operation works lane by lane and is
// correctly rounded (IEEE 754 binary32), so each lane holds exactly the bits that scalar code would compute. A function template
// gives the same results with R = float, RealN<8> and RealN<16>. There are no horizontal sums. A mask does
// not convert to bool implicitly; use any(m), all(m), none(m) or select(m, a, b).
//
// At width 1 the types are float, int32_t and bool. All functions below are overloaded for them.
#pragma once

#include <immintrin.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "halfspace/core/namespace.h"

// HS_INLINE forces inlining, which keeps lanes in registers. HS_FLATTEN inlines everything that a function calls, including shaders.
#define HS_INLINE inline __attribute__((always_inline))
#define HS_FLATTEN __attribute__((flatten))

namespace halfspace::HS_LANES {

namespace detail {

// The vector types of the compiler, specialized per width because g++ 12 ignores a vector_size that depends on a template
// parameter. may_alias is also on the compiler's own __m128. Without it, g++ 12 treats reading a lane of as_real(i) at a
// variable index as an access to float memory and reorders it with writes to the integers (found by tests/core/lanes_test.cpp
// at -O2).
template <int W>
struct Vectors;
template <>
struct Vectors<4> {
  using F = float __attribute__((vector_size(16), may_alias));
  using I = int32_t __attribute__((vector_size(16), may_alias));
  using B = uint8_t __attribute__((vector_size(4)));
};
template <>
struct Vectors<8> {
  using F = float __attribute__((vector_size(32), may_alias));
  using I = int32_t __attribute__((vector_size(32), may_alias));
  using B = uint8_t __attribute__((vector_size(8)));
};
template <>
struct Vectors<16> {
  using F = float __attribute__((vector_size(64), may_alias));
  using I = int32_t __attribute__((vector_size(64), may_alias));
  using B = uint8_t __attribute__((vector_size(16)));
};

#ifdef __AVX512F__
// In g++ 12 the unmasked 512-bit intrinsics read an uninitialized register by design, which causes warnings. The masked
// variants do not, and a full mask costs nothing.
inline constexpr __mmask16 kAll16 = 0xffff;
#endif

}  // namespace detail

/// W booleans, each stored as an int of all zeros (false) or all ones (true).
template <int W>
struct MaskN {
  using V = typename detail::Vectors<W>::I;
  V v;

  MaskN() = default;
  HS_INLINE MaskN(bool b) : v(V{} - static_cast<int32_t>(b)) {}
  HS_INLINE explicit MaskN(V bits) : v(bits) {}

  friend HS_INLINE MaskN operator&(MaskN a, MaskN b) { return MaskN(a.v & b.v); }
  friend HS_INLINE MaskN operator|(MaskN a, MaskN b) { return MaskN(a.v | b.v); }
  friend HS_INLINE MaskN operator^(MaskN a, MaskN b) { return MaskN(a.v ^ b.v); }
  friend HS_INLINE MaskN operator!(MaskN a) { return MaskN(~a.v); }
  friend HS_INLINE MaskN operator&&(MaskN a, MaskN b) { return a & b; }
  friend HS_INLINE MaskN operator||(MaskN a, MaskN b) { return a | b; }
  HS_INLINE MaskN& operator&=(MaskN b) { return v &= b.v, *this; }
  HS_INLINE MaskN& operator|=(MaskN b) { return v |= b.v, *this; }
};

// Division of integers with a result for every operand. The operators / and % of lanes use it. Those of int32_t are C++'s own, and
// must not divide by zero.
/// Returns a/b, truncated towards zero. Division by zero gives -1, and INT32_MIN / -1 wraps to INT32_MIN.
HS_INLINE int32_t int_divide(int32_t a, int32_t b) {
  return b == 0 ? -1 : b == -1 ? static_cast<int32_t>(0u - static_cast<uint32_t>(a)) : a / b;
}
/// Returns a - b*int_divide(a, b). Modulo zero gives a.
HS_INLINE int32_t int_modulo(int32_t a, int32_t b) { return b == 0 ? a : b == -1 ? 0 : a % b; }

/// W 32-bit integers. Arithmetic wraps in two's complement; >> is an arithmetic shift. Of a variable shift count, the low five bits count.
template <int W>
struct IntN {
  using V = typename detail::Vectors<W>::I;
  using U = typename std::conditional_t<W == 4, std::type_identity<uint32_t __attribute__((vector_size(16)))>,
                                        std::conditional_t<W == 8, std::type_identity<uint32_t __attribute__((vector_size(32)))>,
                                                           std::type_identity<uint32_t __attribute__((vector_size(64)))>>>::type;
  V v;

  IntN() = default;
  HS_INLINE IntN(int32_t s) : v(V{} + s) {}
  HS_INLINE explicit IntN(V lanes) : v(lanes) {}

  // Sums and products are computed on unsigned integers, where wrapping is defined.
  friend HS_INLINE IntN operator+(IntN a, IntN b) { return IntN((V)((U)a.v + (U)b.v)); }
  friend HS_INLINE IntN operator-(IntN a, IntN b) { return IntN((V)((U)a.v - (U)b.v)); }
  friend HS_INLINE IntN operator*(IntN a, IntN b) { return IntN((V)((U)a.v * (U)b.v)); }
  friend HS_INLINE IntN operator-(IntN a) { return IntN((V)(U{} - (U)a.v)); }
  friend HS_INLINE IntN operator&(IntN a, IntN b) { return IntN(a.v & b.v); }
  friend HS_INLINE IntN operator|(IntN a, IntN b) { return IntN(a.v | b.v); }
  friend HS_INLINE IntN operator^(IntN a, IntN b) { return IntN(a.v ^ b.v); }
  friend HS_INLINE IntN operator~(IntN a) { return IntN(~a.v); }
  friend HS_INLINE IntN operator<<(IntN a, int n) { return IntN((V)((U)a.v << (n & 31))); }
  friend HS_INLINE IntN operator>>(IntN a, int n) { return IntN(a.v >> (n & 31)); }
  friend HS_INLINE IntN operator<<(IntN a, IntN n) { return IntN((V)((U)a.v << ((U)n.v & 31))); }
  friend HS_INLINE IntN operator>>(IntN a, IntN n) { return IntN(a.v >> (n.v & 31)); }

  friend HS_INLINE IntN int_divide(IntN a, IntN b) {
    const V zero = b.v == 0;  // all ones if true, which is also the result
    return IntN((a.v / nonzero(a.v, b.v)) | zero);
  }
  friend HS_INLINE IntN int_modulo(IntN a, IntN b) {
    const V zero = b.v == 0;
    return IntN((a.v % nonzero(a.v, b.v)) | (zero & a.v));
  }
  friend HS_INLINE IntN operator/(IntN a, IntN b) { return int_divide(a, b); }
  friend HS_INLINE IntN operator%(IntN a, IntN b) { return int_modulo(a, b); }
  HS_INLINE IntN& operator+=(IntN b) { return *this = *this + b; }
  HS_INLINE IntN& operator-=(IntN b) { return *this = *this - b; }

  friend HS_INLINE MaskN<W> operator<(IntN a, IntN b) { return MaskN<W>(a.v < b.v); }
  friend HS_INLINE MaskN<W> operator<=(IntN a, IntN b) { return MaskN<W>(a.v <= b.v); }
  friend HS_INLINE MaskN<W> operator>(IntN a, IntN b) { return MaskN<W>(a.v > b.v); }
  friend HS_INLINE MaskN<W> operator>=(IntN a, IntN b) { return MaskN<W>(a.v >= b.v); }
  friend HS_INLINE MaskN<W> operator==(IntN a, IntN b) { return MaskN<W>(a.v == b.v); }
  friend HS_INLINE MaskN<W> operator!=(IntN a, IntN b) { return MaskN<W>(a.v != b.v); }

 private:
  // Replaces the divisors that the processor traps on by 1.
  HS_INLINE static V nonzero(V a, V b) {
    const V traps = (b == 0) | ((a == std::numeric_limits<int32_t>::min()) & (b == -1));
    return traps ? V{} + 1 : b;
  }
};

/// W unsigned 32-bit integers, or a pair of W each, stored as the IntN or IntPair with the same bits (lane_uint.h).
template <class I>
struct UintLanes;

/// W floats (IEEE 754 binary32).
template <int W>
struct RealN {
  using V = typename detail::Vectors<W>::F;
  V v;

  RealN() = default;
  HS_INLINE RealN(float s) : v(s - V{}) {}  // s − 0 keeps the sign of a zero, 0 + s does not
  HS_INLINE explicit RealN(V lanes) : v(lanes) {}

  friend HS_INLINE RealN operator+(RealN a, RealN b) { return RealN(a.v + b.v); }
  friend HS_INLINE RealN operator-(RealN a, RealN b) { return RealN(a.v - b.v); }
  friend HS_INLINE RealN operator*(RealN a, RealN b) { return RealN(a.v * b.v); }
  friend HS_INLINE RealN operator/(RealN a, RealN b) { return RealN(a.v / b.v); }
  friend HS_INLINE RealN operator-(RealN a) { return RealN(-a.v); }
  friend HS_INLINE RealN operator+(RealN a) { return a; }
  HS_INLINE RealN& operator+=(RealN b) { return v += b.v, *this; }
  HS_INLINE RealN& operator-=(RealN b) { return v -= b.v, *this; }
  HS_INLINE RealN& operator*=(RealN b) { return v *= b.v, *this; }
  HS_INLINE RealN& operator/=(RealN b) { return v /= b.v, *this; }

  friend HS_INLINE MaskN<W> operator<(RealN a, RealN b) { return MaskN<W>(a.v < b.v); }
  friend HS_INLINE MaskN<W> operator<=(RealN a, RealN b) { return MaskN<W>(a.v <= b.v); }
  friend HS_INLINE MaskN<W> operator>(RealN a, RealN b) { return MaskN<W>(a.v > b.v); }
  friend HS_INLINE MaskN<W> operator>=(RealN a, RealN b) { return MaskN<W>(a.v >= b.v); }
  friend HS_INLINE MaskN<W> operator==(RealN a, RealN b) { return MaskN<W>(a.v == b.v); }
  friend HS_INLINE MaskN<W> operator!=(RealN a, RealN b) { return MaskN<W>(a.v != b.v); }
};

// ---- types that belong to a number type R ----------------------------------------------------------------------

/// Properties of a number type R: its width in lanes, and the matching integer, unsigned integer and mask types.
template <class R>
struct LaneTraits;
template <>
struct LaneTraits<float> {
  static constexpr int width = 1;
  using Int = int32_t;
  using Uint = uint32_t;
  using Mask = bool;
};
template <>
struct LaneTraits<double> : LaneTraits<float> {};
template <int W>
struct LaneTraits<RealN<W>> {
  static constexpr int width = W;
  using Int = IntN<W>;
  using Uint = UintLanes<IntN<W>>;
  using Mask = MaskN<W>;
};

template <class R>
using IntOf = typename LaneTraits<R>::Int;
template <class R>
using UintOf = typename LaneTraits<R>::Uint;
template <class R>
using MaskOf = typename LaneTraits<R>::Mask;
template <class R>
inline constexpr int kWidthOf = LaneTraits<R>::width;

template <class T>
inline constexpr bool kIsLanes = false;
template <int W>
inline constexpr bool kIsLanes<RealN<W>> = true;

/// Whether T is the IntOf a number type: int32_t or lanes of it.
template <class T>
inline constexpr bool kIsIntLanes = std::is_same_v<T, int32_t>;
template <int W>
inline constexpr bool kIsIntLanes<IntN<W>> = true;

/// float, double or lanes of float: the types that can be the parameter R of a shader.
template <class R>
concept Number = std::is_same_v<R, float> || std::is_same_v<R, double> || kIsLanes<R>;
template <class R>
concept Scalar = Number<R> && !kIsLanes<R>;

// The SIMD width of this build. CMake sets HALFSPACE_LANES to 1, 4, 8 or 16.
inline constexpr int kLanes = HALFSPACE_LANES;
using Real = std::conditional_t<kLanes == 1, std::type_identity<float>, std::type_identity<RealN<kLanes == 1 ? 4 : kLanes>>>::type;
using Int = IntOf<Real>;
using Mask = MaskOf<Real>;

// ---- masks -----------------------------------------------------------------------------------------------------

HS_INLINE uint32_t negative_bits(int32_t i) { return i < 0 ? 1u : 0u; }
/// Returns one bit per lane, set where the lane is negative. Lane 0 is the lowest bit.
template <int W>
HS_INLINE uint32_t negative_bits(IntN<W> i) {
#ifdef __AVX512DQ__
  if constexpr (W == 16) return static_cast<uint32_t>(_mm512_movepi32_mask((__m512i)i.v));
#endif
#ifdef __AVX__
  if constexpr (W == 8) return static_cast<uint32_t>(_mm256_movemask_ps((__m256)i.v));
#endif
  if constexpr (W == 4) return static_cast<uint32_t>(_mm_movemask_ps((__m128)i.v));
  uint32_t b = 0;
  for (int k = 0; k < W; ++k) b |= (i.v[k] < 0 ? 1u : 0u) << k;
  return b;
}

HS_INLINE uint32_t bits(bool m) { return m ? 1u : 0u; }
/// Returns one bit per lane, set where the mask is true. Lane 0 is the lowest bit.
template <int W>
HS_INLINE uint32_t bits(MaskN<W> m) {
  return negative_bits(IntN<W>(m.v));
}
template <class M>
inline constexpr uint32_t kAllBits = 1u;
template <int W>
inline constexpr uint32_t kAllBits<MaskN<W>> = (W == 32 ? 0u : (1u << W)) - 1u;

template <class M>
HS_INLINE bool any(M m) {
  return bits(m) != 0;
}
template <class M>
HS_INLINE bool all(M m) {
  return bits(m) == kAllBits<M>;
}
template <class M>
HS_INLINE bool none(M m) {
  return bits(m) == 0;
}

HS_INLINE float select(bool m, float a, float b) { return m ? a : b; }
HS_INLINE double select(bool m, double a, double b) { return m ? a : b; }
HS_INLINE int32_t select(bool m, int32_t a, int32_t b) { return m ? a : b; }
HS_INLINE bool select(bool m, bool a, bool b) { return m ? a : b; }
/// Selects a where m is true and b elsewhere, lane by lane.
template <int W>
HS_INLINE RealN<W> select(MaskN<W> m, RealN<W> a, std::type_identity_t<RealN<W>> b) {
  return RealN<W>(m.v ? a.v : b.v);
}
template <int W>
HS_INLINE RealN<W> select(MaskN<W> m, float a, std::type_identity_t<RealN<W>> b) {
  return select(m, RealN<W>(a), b);
}
template <int W>
HS_INLINE IntN<W> select(MaskN<W> m, IntN<W> a, std::type_identity_t<IntN<W>> b) {
  return IntN<W>(m.v ? a.v : b.v);
}
template <int W>
HS_INLINE IntN<W> select(MaskN<W> m, int32_t a, std::type_identity_t<IntN<W>> b) {
  return select(m, IntN<W>(a), b);
}
template <int W>
HS_INLINE MaskN<W> select(MaskN<W> m, MaskN<W> a, std::type_identity_t<MaskN<W>> b) {
  return MaskN<W>((m.v & a.v) | (~m.v & b.v));
}

// ---- memory ----------------------------------------------------------------------------------------------------

/// Loads a T from consecutive values of type S. p need not be aligned.
template <class T, class S>
HS_INLINE T load(const S* p) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(S) == 0, "lanes must consist of whole values of type S");
  T t;
  std::memcpy(&t, p, sizeof t);
  return t;
}
/// Stores all lanes of t to consecutive values of type S. p need not be aligned.
template <class S, class T>
HS_INLINE void store(S* p, const T& t) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(S) == 0, "lanes must consist of whole values of type S");
  std::memcpy(p, &t, sizeof t);
}

HS_INLINE float gather(const float* base, int32_t i) { return base[i]; }
HS_INLINE int32_t gather(const int32_t* base, int32_t i) { return base[i]; }
/// Loads base[i] lane by lane. Every lane must have a valid index, even if its result is not used.
template <int W>
HS_INLINE RealN<W> gather(const float* base, IntN<W> i) {
#ifdef __AVX512F__
  if constexpr (W == 16)
    return RealN<W>((typename RealN<W>::V)_mm512_mask_i32gather_ps(_mm512_setzero_ps(), detail::kAll16, (__m512i)i.v, base, 4));
#endif
#ifdef __AVX2__
  if constexpr (W == 8) return RealN<W>((typename RealN<W>::V)_mm256_i32gather_ps(base, (__m256i)i.v, 4));
  if constexpr (W == 4) return RealN<W>((typename RealN<W>::V)_mm_i32gather_ps(base, (__m128i)i.v, 4));
#endif
  RealN<W> r;
  for (int k = 0; k < W; ++k) r.v[k] = base[i.v[k]];
  return r;
}
template <int W>
HS_INLINE IntN<W> gather(const int32_t* base, IntN<W> i) {
#ifdef __AVX512F__
  if constexpr (W == 16)
    return IntN<W>((typename IntN<W>::V)_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), detail::kAll16, (__m512i)i.v, base, 4));
#endif
#ifdef __AVX2__
  if constexpr (W == 8) return IntN<W>((typename IntN<W>::V)_mm256_i32gather_epi32(base, (__m256i)i.v, 4));
  if constexpr (W == 4) return IntN<W>((typename IntN<W>::V)_mm_i32gather_epi32(base, (__m128i)i.v, 4));
#endif
  IntN<W> r;
  for (int k = 0; k < W; ++k) r.v[k] = base[i.v[k]];
  return r;
}

HS_INLINE int32_t look_up(const std::array<int32_t, 16>& table, int32_t i) { return table[static_cast<std::size_t>(i)]; }
/// Returns table[i] lane by lane, for i in 0 … 15. Cheaper than gather, because the table is kept in registers.
template <int W>
HS_INLINE IntN<W> look_up(const std::array<int32_t, 16>& table, IntN<W> i) {
  using V [[maybe_unused]] = typename IntN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) return IntN<W>((V)_mm512_maskz_permutexvar_epi32(detail::kAll16, (__m512i)i.v, load<__m512i>(table.data())));
#endif
#ifdef __AVX2__
  if constexpr (W == 8) {
    const auto permuted = [&](int first) { return (V)_mm256_permutevar8x32_epi32(load<__m256i>(table.data() + first), (__m256i)i.v); };
    return select(i < 8, IntN<W>(permuted(0)), IntN<W>(permuted(8)));
  }
#endif
  return gather(table.data(), i);
}

// Access to a single lane.
HS_INLINE float lane(float r, int) { return r; }
HS_INLINE double lane(double r, int) { return r; }
HS_INLINE int32_t lane(int32_t r, int) { return r; }
HS_INLINE bool lane(bool r, int) { return r; }
template <int W>
HS_INLINE float lane(RealN<W> r, int i) {
  return r.v[i];
}
template <int W>
HS_INLINE int32_t lane(IntN<W> r, int i) {
  return r.v[i];
}
template <int W>
HS_INLINE bool lane(MaskN<W> r, int i) {
  return r.v[i] != 0;
}
HS_INLINE void set_lane(float& r, int, float x) { r = x; }
HS_INLINE void set_lane(double& r, int, double x) { r = x; }
HS_INLINE void set_lane(int32_t& r, int, int32_t x) { r = x; }
template <int W>
HS_INLINE void set_lane(RealN<W>& r, int i, float x) {
  r.v[i] = x;
}
template <int W>
HS_INLINE void set_lane(IntN<W>& r, int i, int32_t x) {
  r.v[i] = x;
}

/// Returns 0, 1, 2, … in consecutive lanes.
template <class I>
HS_INLINE I iota() {
  I r{};
  for (int i = 0; i < static_cast<int>(sizeof(I) / 4); ++i) set_lane(r, i, i);
  return r;
}

/// Returns a mask with lanes 0 … n−1 true.
template <class M>
HS_INLINE M first_lanes(int n) {
  if constexpr (std::is_same_v<M, bool>) {
    return n > 0;
  } else {
    return iota<IntN<static_cast<int>(sizeof(M) / 4)>>() < n;
  }
}

/// Returns the mask m for which bits(m) == b. The inverse of bits().
template <class M>
HS_INLINE M mask_from_bits(uint32_t b) {
  if constexpr (std::is_same_v<M, bool>) {
    return (b & 1) != 0;
  } else {
    using I = IntN<static_cast<int>(sizeof(M) / 4)>;
    I lane_bit{};
    for (int i = 0; i < static_cast<int>(sizeof(M) / 4); ++i) set_lane(lane_bit, i, 1 << i);
    return (I(static_cast<int32_t>(b)) & lane_bit) != I(0);
  }
}

// ---- bit patterns and conversions ------------------------------------------------------------------------------

HS_INLINE int32_t as_int(float r) { return std::bit_cast<int32_t>(r); }
HS_INLINE float as_real(int32_t i) { return std::bit_cast<float>(i); }
template <int W>
HS_INLINE IntN<W> as_int(RealN<W> r) {
  return IntN<W>((typename IntN<W>::V)r.v);
}
template <int W>
HS_INLINE IntN<W> as_int(MaskN<W> m) {
  return IntN<W>(m.v);
}
template <int W>
HS_INLINE RealN<W> as_real(IntN<W> i) {
  return RealN<W>((typename RealN<W>::V)i.v);
}

/// Converts to the nearest float, ties to even.
template <class R>
HS_INLINE R to_real(int32_t i) {
  return static_cast<R>(i);
}
template <class R, int W>
HS_INLINE RealN<W> to_real(IntN<W> i) {
  static_assert(std::is_same_v<R, RealN<W>>);
  return RealN<W>(__builtin_convertvector(i.v, typename RealN<W>::V));
}

// Rounding to an integer. NaN and values outside the range of int32_t give INT32_MIN at every width, as x86 does.
HS_INLINE int32_t truncate_to_int(float r) { return _mm_cvttss_si32(_mm_set_ss(r)); }
HS_INLINE int32_t round_to_int(float r) { return _mm_cvtss_si32(_mm_set_ss(r)); }
HS_INLINE int32_t truncate_to_int(double r) { return _mm_cvttsd_si32(_mm_set_sd(r)); }
HS_INLINE int32_t round_to_int(double r) { return _mm_cvtsd_si32(_mm_set_sd(r)); }
template <int W>
HS_INLINE IntN<W> truncate_to_int(RealN<W> r) {
#ifdef __AVX512F__
  if constexpr (W == 16) return IntN<W>((typename IntN<W>::V)_mm512_maskz_cvttps_epi32(detail::kAll16, (__m512)r.v));
#endif
#ifdef __AVX__
  if constexpr (W == 8) return IntN<W>((typename IntN<W>::V)_mm256_cvttps_epi32((__m256)r.v));
#endif
  if constexpr (W == 4) return IntN<W>((typename IntN<W>::V)_mm_cvttps_epi32((__m128)r.v));
  IntN<W> i;
  for (int k = 0; k < W; ++k) i.v[k] = truncate_to_int(r.v[k]);
  return i;
}
/// Rounds to the nearest integer, ties to even.
template <int W>
HS_INLINE IntN<W> round_to_int(RealN<W> r) {
#ifdef __AVX512F__
  if constexpr (W == 16) return IntN<W>((typename IntN<W>::V)_mm512_maskz_cvtps_epi32(detail::kAll16, (__m512)r.v));
#endif
#ifdef __AVX__
  if constexpr (W == 8) return IntN<W>((typename IntN<W>::V)_mm256_cvtps_epi32((__m256)r.v));
#endif
  if constexpr (W == 4) return IntN<W>((typename IntN<W>::V)_mm_cvtps_epi32((__m128)r.v));
  IntN<W> i;
  for (int k = 0; k < W; ++k) i.v[k] = round_to_int(r.v[k]);
  return i;
}

// ---- correctly rounded functions -------------------------------------------------------------------------------

// The scalar overloads of functions that C also declares are templates. After `using namespace halfspace`, an unqualified call then prefers
// the function of C, which returns the same bits, instead of being ambiguous.

template <Scalar R>
HS_INLINE R fma(R a, std::type_identity_t<R> b, std::type_identity_t<R> c) {
  if constexpr (std::is_same_v<R, float>) {
    return __builtin_fmaf(a, b, c);
  } else {
    return __builtin_fma(a, b, c);
  }
}
/// Returns a·b + c, rounded once.
template <int W>
HS_INLINE RealN<W> fma(RealN<W> a, std::type_identity_t<RealN<W>> b, std::type_identity_t<RealN<W>> c) {
  using V [[maybe_unused]] = typename RealN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) return RealN<W>((V)_mm512_fmadd_ps((__m512)a.v, (__m512)b.v, (__m512)c.v));
#endif
#ifdef __FMA__
  if constexpr (W == 8) return RealN<W>((V)_mm256_fmadd_ps((__m256)a.v, (__m256)b.v, (__m256)c.v));
  if constexpr (W == 4) return RealN<W>((V)_mm_fmadd_ps((__m128)a.v, (__m128)b.v, (__m128)c.v));
#endif
  RealN<W> r;
  for (int k = 0; k < W; ++k) r.v[k] = __builtin_fmaf(a.v[k], b.v[k], c.v[k]);
  return r;
}

template <Scalar R>
HS_INLINE R sqrt(R a) {
  if constexpr (std::is_same_v<R, float>) {
    return __builtin_sqrtf(a);
  } else {
    return __builtin_sqrt(a);
  }
}
template <int W>
HS_INLINE RealN<W> sqrt(RealN<W> a) {
  using V [[maybe_unused]] = typename RealN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) return RealN<W>((V)_mm512_maskz_sqrt_ps(detail::kAll16, (__m512)a.v));
#endif
#ifdef __AVX__
  if constexpr (W == 8) return RealN<W>((V)_mm256_sqrt_ps((__m256)a.v));
#endif
  if constexpr (W == 4) return RealN<W>((V)_mm_sqrt_ps((__m128)a.v));
  RealN<W> r;
  for (int k = 0; k < W; ++k) r.v[k] = __builtin_sqrtf(a.v[k]);
  return r;
}

template <Scalar R>
HS_INLINE R floor(R a) {
  if constexpr (std::is_same_v<R, float>) {
    return __builtin_floorf(a);
  } else {
    return __builtin_floor(a);
  }
}
template <int W>
HS_INLINE RealN<W> floor(RealN<W> a) {
  using V [[maybe_unused]] = typename RealN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16)
    return RealN<W>((V)_mm512_maskz_roundscale_ps(detail::kAll16, (__m512)a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
#endif
#ifdef __AVX__
  if constexpr (W == 8) return RealN<W>((V)_mm256_floor_ps((__m256)a.v));
#endif
#ifdef __SSE4_1__
  if constexpr (W == 4) return RealN<W>((V)_mm_floor_ps((__m128)a.v));
#endif
  RealN<W> r;
  for (int k = 0; k < W; ++k) r.v[k] = __builtin_floorf(a.v[k]);
  return r;
}

HS_INLINE float round_even(float a) { return __builtin_rintf(a); }
HS_INLINE double round_even(double a) { return __builtin_rint(a); }
/// Rounds to the nearest integer, ties to even, and returns it as a float.
template <int W>
HS_INLINE RealN<W> round_even(RealN<W> a) {
  using V [[maybe_unused]] = typename RealN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16)
    return RealN<W>((V)_mm512_maskz_roundscale_ps(detail::kAll16, (__m512)a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
#endif
#ifdef __AVX__
  if constexpr (W == 8) return RealN<W>((V)_mm256_round_ps((__m256)a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
#endif
  RealN<W> r;
  for (int k = 0; k < W; ++k) r.v[k] = __builtin_rintf(a.v[k]);
  return r;
}

template <Scalar R>
HS_INLINE R abs(R a) {
  if constexpr (std::is_same_v<R, float>) {
    return __builtin_fabsf(a);
  } else {
    return __builtin_fabs(a);
  }
}
template <int W>
HS_INLINE RealN<W> abs(RealN<W> a) {
  return as_real(as_int(a) & 0x7fffffff);
}

// min and max return the second argument if either is NaN, like the SSE instructions, at every width. (They use intrinsics
// because compilers turn a > b ? a : b into a comparison and a blend.) Both arguments take part in the deduction of W, so that the
// overloads are more specialized than std::min and std::max.
HS_INLINE float min(float a, float b) { return a < b ? a : b; }
HS_INLINE float max(float a, float b) { return a > b ? a : b; }
HS_INLINE double min(double a, double b) { return a < b ? a : b; }
HS_INLINE double max(double a, double b) { return a > b ? a : b; }
HS_INLINE int32_t min(int32_t a, int32_t b) { return a < b ? a : b; }
HS_INLINE int32_t max(int32_t a, int32_t b) { return a > b ? a : b; }
template <int W>
HS_INLINE RealN<W> min(RealN<W> a, RealN<W> b) {
  using V [[maybe_unused]] = typename RealN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) return RealN<W>((V)_mm512_maskz_min_ps(detail::kAll16, (__m512)a.v, (__m512)b.v));
#endif
#ifdef __AVX__
  if constexpr (W == 8) return RealN<W>((V)_mm256_min_ps((__m256)a.v, (__m256)b.v));
#endif
  if constexpr (W == 4) return RealN<W>((V)_mm_min_ps((__m128)a.v, (__m128)b.v));
  return RealN<W>(a.v < b.v ? a.v : b.v);
}
template <int W>
HS_INLINE RealN<W> max(RealN<W> a, RealN<W> b) {
  using V [[maybe_unused]] = typename RealN<W>::V;
#ifdef __AVX512F__
  if constexpr (W == 16) return RealN<W>((V)_mm512_maskz_max_ps(detail::kAll16, (__m512)a.v, (__m512)b.v));
#endif
#ifdef __AVX__
  if constexpr (W == 8) return RealN<W>((V)_mm256_max_ps((__m256)a.v, (__m256)b.v));
#endif
  if constexpr (W == 4) return RealN<W>((V)_mm_max_ps((__m128)a.v, (__m128)b.v));
  return RealN<W>(a.v > b.v ? a.v : b.v);
}
template <int W>
HS_INLINE RealN<W> min(float a, RealN<W> b) {
  return min(RealN<W>(a), b);
}
template <int W>
HS_INLINE RealN<W> min(RealN<W> a, float b) {
  return min(a, RealN<W>(b));
}
template <int W>
HS_INLINE RealN<W> max(float a, RealN<W> b) {
  return max(RealN<W>(a), b);
}
template <int W>
HS_INLINE RealN<W> max(RealN<W> a, float b) {
  return max(a, RealN<W>(b));
}
template <int W>
HS_INLINE IntN<W> min(IntN<W> a, IntN<W> b) {
  return IntN<W>(a.v < b.v ? a.v : b.v);
}
template <int W>
HS_INLINE IntN<W> min(IntN<W> a, int32_t b) {
  return min(a, IntN<W>(b));
}
template <int W>
HS_INLINE IntN<W> max(IntN<W> a, IntN<W> b) {
  return IntN<W>(a.v > b.v ? a.v : b.v);
}
template <int W>
HS_INLINE IntN<W> max(IntN<W> a, int32_t b) {
  return max(a, IntN<W>(b));
}

/// Returns x in all lanes, with the same bits even if they are those of an integer. R(x) may change a signaling NaN.
template <class R>
HS_INLINE R spread(float x) {
  return as_real(IntOf<R>(as_int(x)));
}

/// Clamps x to [lo, hi]. NaN gives lo.
template <Number R>
HS_INLINE R clamp(R x, std::type_identity_t<R> lo, std::type_identity_t<R> hi) {
  return min(max(x, lo), hi);
}
template <int W>
HS_INLINE RealN<W> clamp(RealN<W> x, RealN<W> lo, RealN<W> hi) {
  return min(max(x, lo), hi);
}

/// Returns a·b − c·d with an error of at most 1.5 ulp. This is Kahan's algorithm; see Jeannerod, Louvet and Muller, "Further
/// analysis of Kahan's algorithm for the accurate computation of 2x2 determinants", Math. Comp. 82, 2013.
template <Number R>
HS_INLINE R difference_of_products(R a, std::type_identity_t<R> b, std::type_identity_t<R> c, std::type_identity_t<R> d) {
  const R cd = c * d;
  const R error = fma(-c, d, cd);
  return fma(a, b, -cd) + error;
}

}  // namespace halfspace::HS_LANES
