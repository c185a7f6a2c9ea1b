// SPDX-License-Identifier: Apache-2.0
//
// Unsigned integers per lane: UintOf<R> is uint32_t for a scalar R, and UintLanes otherwise. Arithmetic wraps, >> shifts in zeros, and of a
// variable shift count the low five bits count. IntOf<R>(u) and UintOf<R>(i) convert between the types and keep the bits, to_real<R>(u)
// rounds to the nearest float, and truncate_to_uint(x) converts back.
//
// The operators of the scalar types are C++'s own: dividing by zero or shifting by 32 is an error for uint32_t and int32_t, but has a
// result for lanes. Code that is compiled for both and may meet such operands calls int_divide and int_modulo, and masks shift counts.
#pragma once

#include <concepts>

#include "halfspace/core/lane_pairs.h"

namespace halfspace::HS_LANES {

namespace detail {

template <class T>
inline constexpr bool kIsInt = std::is_same_v<T, int32_t>;
template <int W>
inline constexpr bool kIsInt<IntN<W>> = true;
template <class H>
inline constexpr bool kIsInt<IntPair<H>> = true;
template <class T>
inline constexpr bool kIsUint = std::is_same_v<T, uint32_t>;
template <class I>
inline constexpr bool kIsUint<UintLanes<I>> = true;
template <class T>
inline constexpr bool kIsMask = std::is_same_v<T, bool>;
template <int W>
inline constexpr bool kIsMask<MaskN<W>> = true;
template <class H>
inline constexpr bool kIsMask<MaskPair<H>> = true;

HS_INLINE uint32_t divide_unsigned(uint32_t a, uint32_t b) { return b == 0 ? ~0u : a / b; }
HS_INLINE uint32_t modulo_unsigned(uint32_t a, uint32_t b) { return b == 0 ? a : a % b; }

// The operations of UintLanes<I> that differ from those of I. Scalars are the halves of a pair.
HS_INLINE int32_t shift_right_unsigned(int32_t a, int32_t n) { return static_cast<int32_t>(static_cast<uint32_t>(a) >> (n & 31)); }
HS_INLINE int32_t divide_unsigned(int32_t a, int32_t b) {
  return static_cast<int32_t>(divide_unsigned(static_cast<uint32_t>(a), static_cast<uint32_t>(b)));
}
HS_INLINE int32_t modulo_unsigned(int32_t a, int32_t b) {
  return static_cast<int32_t>(modulo_unsigned(static_cast<uint32_t>(a), static_cast<uint32_t>(b)));
}
HS_INLINE bool less_unsigned(int32_t a, int32_t b) { return static_cast<uint32_t>(a) < static_cast<uint32_t>(b); }
template <int W>
HS_INLINE IntN<W> shift_right_unsigned(IntN<W> a, IntN<W> n) {
  using U = typename IntN<W>::U;
  return IntN<W>((typename IntN<W>::V)((U)a.v >> ((U)n.v & 31)));
}
template <int W>
HS_INLINE IntN<W> divide_unsigned(IntN<W> a, IntN<W> b) {
  using U = typename IntN<W>::U;
  const IntN<W> zero = as_int(b == IntN<W>(0));  // all ones if true, which is also the result
  return IntN<W>((typename IntN<W>::V)((U)a.v / (U)(b - zero).v)) | zero;
}
template <int W>
HS_INLINE IntN<W> modulo_unsigned(IntN<W> a, IntN<W> b) {
  using U = typename IntN<W>::U;
  const IntN<W> zero = as_int(b == IntN<W>(0));
  return IntN<W>((typename IntN<W>::V)((U)a.v % (U)(b - zero).v)) | (zero & a);
}
template <int W>
HS_INLINE MaskN<W> less_unsigned(IntN<W> a, IntN<W> b) {
  using U = typename IntN<W>::U;
  return MaskN<W>((typename IntN<W>::V)((U)a.v < (U)b.v));
}
template <class H>
HS_INLINE IntPair<H> shift_right_unsigned(IntPair<H> a, IntPair<H> n) {
  return {shift_right_unsigned(a.low, n.low), shift_right_unsigned(a.high, n.high)};
}
template <class H>
HS_INLINE IntPair<H> divide_unsigned(IntPair<H> a, IntPair<H> b) {
  return {divide_unsigned(a.low, b.low), divide_unsigned(a.high, b.high)};
}
template <class H>
HS_INLINE IntPair<H> modulo_unsigned(IntPair<H> a, IntPair<H> b) {
  return {modulo_unsigned(a.low, b.low), modulo_unsigned(a.high, b.high)};
}
template <class H>
HS_INLINE MaskPair<H> less_unsigned(IntPair<H> a, IntPair<H> b) {
  return MaskPair<H>::of(less_unsigned(a.low, b.low), less_unsigned(a.high, b.high));
}

}  // namespace detail

/// Unsigned integers with the bits of I, which is IntN<W> or IntPair<H>.
template <class I>
struct UintLanes {
  using M = decltype(std::declval<I>() == std::declval<I>());
  I bits;

  UintLanes() = default;
  HS_INLINE UintLanes(uint32_t s) : bits(static_cast<int32_t>(s)) {}
  HS_INLINE explicit UintLanes(I i) : bits(i) {}
  HS_INLINE explicit operator I() const { return bits; }

  friend HS_INLINE UintLanes operator+(UintLanes a, UintLanes b) { return UintLanes(a.bits + b.bits); }
  friend HS_INLINE UintLanes operator-(UintLanes a, UintLanes b) { return UintLanes(a.bits - b.bits); }
  friend HS_INLINE UintLanes operator*(UintLanes a, UintLanes b) { return UintLanes(a.bits * b.bits); }
  friend HS_INLINE UintLanes operator-(UintLanes a) { return UintLanes(-a.bits); }
  friend HS_INLINE UintLanes operator&(UintLanes a, UintLanes b) { return UintLanes(a.bits & b.bits); }
  friend HS_INLINE UintLanes operator|(UintLanes a, UintLanes b) { return UintLanes(a.bits | b.bits); }
  friend HS_INLINE UintLanes operator^(UintLanes a, UintLanes b) { return UintLanes(a.bits ^ b.bits); }
  friend HS_INLINE UintLanes operator~(UintLanes a) { return UintLanes(~a.bits); }
  friend HS_INLINE UintLanes operator<<(UintLanes a, int n) { return UintLanes(a.bits << n); }
  friend HS_INLINE UintLanes operator<<(UintLanes a, I n) { return UintLanes(a.bits << n); }
  friend HS_INLINE UintLanes operator<<(UintLanes a, UintLanes n) { return a << n.bits; }
  friend HS_INLINE UintLanes operator>>(UintLanes a, int n) { return a >> I(n); }
  friend HS_INLINE UintLanes operator>>(UintLanes a, I n) { return UintLanes(detail::shift_right_unsigned(a.bits, n)); }
  friend HS_INLINE UintLanes operator>>(UintLanes a, UintLanes n) { return a >> n.bits; }
  friend HS_INLINE I operator<<(I a, UintLanes n) { return a << n.bits; }
  friend HS_INLINE I operator>>(I a, UintLanes n) { return a >> n.bits; }
  HS_INLINE UintLanes& operator+=(UintLanes b) { return *this = *this + b; }
  HS_INLINE UintLanes& operator-=(UintLanes b) { return *this = *this - b; }

  friend HS_INLINE UintLanes int_divide(UintLanes a, UintLanes b) { return UintLanes(detail::divide_unsigned(a.bits, b.bits)); }
  friend HS_INLINE UintLanes int_modulo(UintLanes a, UintLanes b) { return UintLanes(detail::modulo_unsigned(a.bits, b.bits)); }
  friend HS_INLINE UintLanes operator/(UintLanes a, UintLanes b) { return int_divide(a, b); }
  friend HS_INLINE UintLanes operator%(UintLanes a, UintLanes b) { return int_modulo(a, b); }

  friend HS_INLINE M operator<(UintLanes a, UintLanes b) { return detail::less_unsigned(a.bits, b.bits); }
  friend HS_INLINE M operator>(UintLanes a, UintLanes b) { return b < a; }
  friend HS_INLINE M operator<=(UintLanes a, UintLanes b) { return !(b < a); }
  friend HS_INLINE M operator>=(UintLanes a, UintLanes b) { return !(a < b); }
  friend HS_INLINE M operator==(UintLanes a, UintLanes b) { return a.bits == b.bits; }
  friend HS_INLINE M operator!=(UintLanes a, UintLanes b) { return a.bits != b.bits; }

  friend HS_INLINE UintLanes select(M m, UintLanes a, UintLanes b) { return UintLanes(select(m, a.bits, b.bits)); }
  friend HS_INLINE UintLanes min(UintLanes a, UintLanes b) { return select(a < b, a, b); }
  friend HS_INLINE UintLanes max(UintLanes a, UintLanes b) { return select(a > b, a, b); }
  friend HS_INLINE uint32_t lane(UintLanes a, int i) { return static_cast<uint32_t>(lane(a.bits, i)); }
  friend HS_INLINE void set_lane(UintLanes& a, int i, uint32_t x) { set_lane(a.bits, i, static_cast<int32_t>(x)); }
};

// ---- scalars ---------------------------------------------------------------------------------------------------

HS_INLINE uint32_t select(bool m, uint32_t a, uint32_t b) { return m ? a : b; }
HS_INLINE uint32_t min(uint32_t a, uint32_t b) { return a < b ? a : b; }
HS_INLINE uint32_t max(uint32_t a, uint32_t b) { return a > b ? a : b; }
HS_INLINE uint32_t lane(uint32_t a, int) { return a; }
HS_INLINE void set_lane(uint32_t& a, int, uint32_t x) { a = x; }
/// Returns a/b. Division by zero gives 2^32 − 1.
HS_INLINE uint32_t int_divide(uint32_t a, uint32_t b) { return detail::divide_unsigned(a, b); }
/// Returns the remainder of a/b. Modulo zero gives a.
HS_INLINE uint32_t int_modulo(uint32_t a, uint32_t b) { return detail::modulo_unsigned(a, b); }

// ---- both ------------------------------------------------------------------------------------------------------

/// Signed or unsigned integers, scalar or per lane: IntOf<R> or UintOf<R>.
template <class T>
concept Integer = detail::kIsInt<T> || detail::kIsUint<T>;

namespace detail {
template <class T>
struct SignedT : std::type_identity<T> {};
template <>
struct SignedT<uint32_t> : std::type_identity<int32_t> {};
template <class I>
struct SignedT<UintLanes<I>> : std::type_identity<I> {};
template <class T>
struct UnsignedT : std::type_identity<UintLanes<T>> {};
template <class I>
struct UnsignedT<UintLanes<I>> : std::type_identity<UintLanes<I>> {};
template <std::same_as<int32_t> T>
struct UnsignedT<T> : std::type_identity<uint32_t> {};
template <std::same_as<uint32_t> T>
struct UnsignedT<T> : std::type_identity<uint32_t> {};
}  // namespace detail

/// The signed or unsigned integer type with as many lanes as T.
template <Integer T>
using SignedOf = typename detail::SignedT<T>::type;
template <Integer T>
using UnsignedOf = typename detail::UnsignedT<T>::type;

/// Integers per lane: not int32_t or uint32_t, whose operators are built in.
template <class T>
concept IntegerLanes = Integer<T> && std::is_class_v<T>;
template <IntegerLanes T>
HS_INLINE T& operator*=(T& a, std::type_identity_t<T> b) {
  return a = a * b;
}
template <IntegerLanes T>
HS_INLINE T& operator/=(T& a, std::type_identity_t<T> b) {
  return a = a / b;
}
template <IntegerLanes T>
HS_INLINE T& operator%=(T& a, std::type_identity_t<T> b) {
  return a = a % b;
}
template <IntegerLanes T>
HS_INLINE T& operator&=(T& a, std::type_identity_t<T> b) {
  return a = a & b;
}
template <IntegerLanes T>
HS_INLINE T& operator|=(T& a, std::type_identity_t<T> b) {
  return a = a | b;
}
template <IntegerLanes T>
HS_INLINE T& operator^=(T& a, std::type_identity_t<T> b) {
  return a = a ^ b;
}
template <IntegerLanes T, class N>
HS_INLINE T& operator<<=(T& a, N n) {
  return a = a << n;
}
template <IntegerLanes T, class N>
HS_INLINE T& operator>>=(T& a, N n) {
  return a = a >> n;
}

/// Converts to the nearest float, ties to even.
template <Number R>
HS_INLINE R to_real(UintOf<R> u) {
  if constexpr (Scalar<R>) {
    return static_cast<R>(u);
  } else {
    // Both halves are exact, and so is the product. Only the sum rounds.
    return fma(to_real<R>(IntOf<R>(u >> 16)), R(65536.0f), to_real<R>(IntOf<R>(u & 0xffff)));
  }
}

/// Rounds towards zero. NaN and numbers below 1 give 0, and numbers from 2^32 give 2^32 − 1.
template <Number R>
HS_INLINE UintOf<R> truncate_to_uint(R x) {
  const R above = max(x, R(0.0f));  // NaN becomes 0
  const MaskOf<R> high = above >= R(0x1p31f);
  const IntOf<R> low_bits = truncate_to_int(select(high, above - R(0x1p31f), above));
  const UintOf<R> u = UintOf<R>(low_bits) ^ select(high, UintOf<R>(0x80000000u), UintOf<R>(0u));
  return select(above < R(0x1p32f), u, UintOf<R>(0xffffffffu));
}

}  // namespace halfspace::HS_LANES
