// SPDX-License-Identifier: Apache-2.0
//
// The integer functions of GLSL (section 8.8 of GLSL 4.60), for signed and unsigned scalars and vectors. All are exact.
#pragma once

#include "halfspace/core/discrete_vec.h"

namespace halfspace::HS_LANES {

namespace detail {

/// Where the lowest `count` bits are ones; 0 <= count <= 32.
template <class U>
HS_INLINE U low_bits(const SignedOf<U>& count) {
  return select(count >= SignedOf<U>(32), U(~0u), (U(1u) << (count & 31)) - U(1u));
}

template <class U>
HS_INLINE U count_bits(U u) {
  u = u - ((u >> 1) & U(0x55555555u));
  u = (u & U(0x33333333u)) + ((u >> 2) & U(0x33333333u));
  return (((u + (u >> 4)) & U(0x0f0f0f0fu)) * U(0x01010101u)) >> 24;
}

/// Exchanges neighboring groups of n bits, of which `low` are the lower ones.
template <class U>
HS_INLINE U exchange_bits(U u, int n, uint32_t low) {
  return ((u >> n) & U(low)) | ((u & U(low)) << n);
}
template <class U>
HS_INLINE U reverse_bits(U u) {
  u = exchange_bits(u, 1, 0x55555555u);
  u = exchange_bits(u, 2, 0x33333333u);
  u = exchange_bits(u, 4, 0x0f0f0f0fu);
  u = exchange_bits(u, 8, 0x00ff00ffu);
  return (u >> 16) | (u << 16);
}

/// Number of the highest bit that is set, −1 for 0.
template <class U>
HS_INLINE SignedOf<U> highest_bit(U u) {
  for (const int n : {1, 2, 4, 8, 16}) u = u | (u >> n);
  return SignedOf<U>(count_bits(u)) - 1;
}

/// The upper half of the product, which is the sum of four products of 16-bit halves.
template <class U>
HS_INLINE U high_product(U a, U b) {
  const U a_low = a & U(0xffffu), a_high = a >> 16, b_low = b & U(0xffffu), b_high = b >> 16;
  const U middle = a_high * b_low + ((a_low * b_low) >> 16);  // below 2^32
  const U other = a_low * b_high + (middle & U(0xffffu));
  return a_high * b_high + (middle >> 16) + (other >> 16);
}

template <class... X>
concept UnsignedIntegers = IntegerArguments<X...> && kIsUint<IntegerOf<X...>>;
template <class X>
concept IntegerCount = kLengthOf<X>
== 0 && (Integer<X> || std::is_integral_v<X>);

}  // namespace detail

/// Returns `bits` bits of value from bit `offset` on, in the lowest bits. Signed ones are extended by their sign. 0 bits give 0. The result
/// is unspecified unless offset and bits are >= 0 and their sum is <= 32. GLSL 8.8.
template <class X, detail::IntegerCount Offset, detail::IntegerCount Bits>
requires detail::IntegerArguments<X> HS_INLINE X bitfieldExtract(const X& value, const Offset& offset, const Bits& bits) {
  return detail::map_integers(
      [&]<class T>(T v) {
        using I = SignedOf<T>;
        const I from = detail::cast<I>(offset), count = detail::cast<I>(bits);
        if constexpr (detail::kIsUint<T>) {
          return T((v >> (from & 31)) & detail::low_bits<T>(count));
        } else {
          const T top = v << ((T(64) - (from & 31) - (count & 31)) & 31);
          return select(count == T(0), T(0), T(top >> ((T(32) - (count & 31)) & 31)));
        }
      },
      value);
}
/// Replaces `bits` bits of base from bit `offset` on by the lowest bits of insert. The result is unspecified unless offset and bits are >=
/// 0 and their sum is <= 32. GLSL 8.8.
template <class X, class Insert, detail::IntegerCount Offset, detail::IntegerCount Bits>
requires detail::IntegerArguments<X, Insert> HS_INLINE auto bitfieldInsert(const X& base, const Insert& insert, const Offset& offset,
                                                                           const Bits& bits) {
  return detail::map_integers(
      [&]<class T>(T b, T i) {
        using U = UnsignedOf<T>;
        using I = SignedOf<T>;
        const I from = detail::cast<I>(offset) & 31;
        const U mask = detail::low_bits<U>(detail::cast<I>(bits)) << from;
        return T((U(b) & ~mask) | ((U(i) << from) & mask));
      },
      base, insert);
}
/// Reverses the order of the bits. GLSL 8.8.
template <class X>
requires detail::IntegerArguments<X> HS_INLINE X bitfieldReverse(const X& x) {
  return detail::map_integers([]<class T>(T v) { return T(detail::reverse_bits(UnsignedOf<T>(v))); }, x);
}
/// Number of bits that are set, as a signed integer. GLSL 8.8.
template <class X>
requires detail::IntegerArguments<X> HS_INLINE auto bitCount(const X& x) {
  return detail::map_integers([]<class T>(T v) { return SignedOf<T>(detail::count_bits(UnsignedOf<T>(v))); }, x);
}
/// Number of the lowest bit that is set, as a signed integer; −1 for 0. GLSL 8.8.
template <class X>
requires detail::IntegerArguments<X> HS_INLINE auto findLSB(const X& x) {
  return detail::map_integers(
      []<class T>(T v) {
        using U = UnsignedOf<T>;
        using I = SignedOf<T>;
        const U u = U(v), below = ~u & (u - U(1u));
        return select(u == U(0u), I(-1), I(detail::count_bits(below)));
      },
      x);
}
/// Number of the highest bit that is set, or for negative numbers that is not set, as a signed integer; −1 for 0 and −1. GLSL 8.8.
template <class X>
requires detail::IntegerArguments<X> HS_INLINE auto findMSB(const X& x) {
  return detail::map_integers(
      []<class T>(T v) {
        if constexpr (detail::kIsUint<T>) {
          return detail::highest_bit(v);
        } else {
          return detail::highest_bit(UnsignedOf<T>(T(v ^ (v >> 31))));
        }
      },
      x);
}

/// Returns the sum modulo 2^32, and sets carry to 1 where it overflows and 0 elsewhere. GLSL 8.8.
template <class X, class Y, class C>
requires detail::UnsignedIntegers<X, Y> HS_INLINE auto uaddCarry(const X& x, const Y& y, C& carry) {
  const auto sum = detail::map_integers([]<class U>(U a, U b) { return U(a + b); }, x, y);  // before carry is set, which may be x or y
  carry = detail::map_integers([]<class U>(U a, U b) { return select(U(a + b) < a, U(1u), U(0u)); }, x, y);
  return sum;
}
/// Returns the difference modulo 2^32, and sets borrow to 1 where x < y and 0 elsewhere. GLSL 8.8.
template <class X, class Y, class B>
requires detail::UnsignedIntegers<X, Y> HS_INLINE auto usubBorrow(const X& x, const Y& y, B& borrow) {
  const auto difference = detail::map_integers([]<class U>(U a, U b) { return U(a - b); }, x, y);
  borrow = detail::map_integers([]<class U>(U a, U b) { return select(a < b, U(1u), U(0u)); }, x, y);
  return difference;
}
/// Sets msb and lsb to the upper and lower 32 bits of the unsigned product. GLSL 8.8.
template <class X, class Y, class P>
requires detail::UnsignedIntegers<X, Y> HS_INLINE void umulExtended(const X& x, const Y& y, P& msb, P& lsb) {
  const P low = detail::map_integers([]<class U>(U a, U b) { return U(a * b); }, x, y);
  msb = detail::map_integers([](auto a, auto b) { return detail::high_product(a, b); }, x, y);
  lsb = low;
}
/// Sets msb and lsb to the upper and lower 32 bits of the signed product. GLSL 8.8.
template <class X, class Y, class P>
requires detail::IntegerArguments<X, Y> && detail::kIsInt<detail::IntegerOf<X, Y>> HS_INLINE void imulExtended(const X& x, const Y& y,
                                                                                                               P& msb, P& lsb) {
  const P low = detail::map_integers([](auto a, auto b) { return detail::wrapping(a, b, std::multiplies()); }, x, y);
  msb = detail::map_integers(
      []<class I>(I a, I b) {
        // As an unsigned number, a negative a is larger by 2^32, and the product by 2^32·b.
        using U = UnsignedOf<I>;
        return I(detail::high_product(U(a), U(b)) - (U(a >> 31) & U(b)) - (U(b >> 31) & U(a)));
      },
      x, y);
  lsb = low;
}

}  // namespace halfspace::HS_LANES
