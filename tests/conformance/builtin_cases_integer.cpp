// SPDX-License-Identifier: Apache-2.0
//
// The packing and integer functions (GLSL 4.60, sections 8.4 and 8.8).
#include "conformance/builtin_calls.h"

namespace halfspace::conformance::builtins {

namespace {

// ---- packing -------------------------------------------------------------------------------------------------------

/// Splits an unsigned integer into codes of 32/L bits, without or with their signs.
template <int L, class T>
void split_codes(T& codes, const UintOf<Lanes>& packed) {
  constexpr int bits = 32 / L;
  for (int k = 0; k < L; ++k) {
    const UintOf<Lanes> top = packed << (32 - bits - bits * k);
    if constexpr (std::is_same_v<T, typename Int<L>::Value>) {
      codes[k] = IntOf<Lanes>(top) >> (32 - bits);
    } else {
      codes[k] = top >> (32 - bits);
    }
  }
}
template <int L>
std::string split_in_glsl(const std::string& type, const std::string& packed) {
  const std::string bits = std::to_string(32 - 32 / L), vector = type + "vec" + std::to_string(L);
  const std::string shifts = L == 2 ? "(16, 0)" : "(24, 16, 8, 0)";
  return "r = " + vector + "(uvec" + std::to_string(L) + "(" + packed + ") << ivec" + std::to_string(L) + shifts + ") >> " + bits + ";";
}
/// Codes of numbers from `low` to 1. The code is the nearest to the product that is rounded first.
template <int L, class Codes, int low, int scale, class F>
void add_pack(Cases& cases, const char* name, F) {
  const Domain range = between(1.5 * low - 0.2, 1.5, {0.0f, 1.0f, -1.0f, 0.5f, 0.25f, 2.0f, -2.0f, 1e10f});
  const Bound nearest = absolute(0.5 + scale * kRounding);
  add_by_component(
      cases, Types<Codes>(), Types<Float<L>>(), {name, split_in_glsl<L>(Codes::base == Base::integer ? "i" : "u", "$(a)"), {range}},
      [](auto& r, const auto& v) { split_codes<L>(r, F()(v)); },
      // The result is compared as a number, so the code is not rounded here.
      [](double x) { return std::min(std::max(x, static_cast<double>(low)), 1.0) * scale; }, {nearest, nearest});
}

template <int L, class F>
void add_unpack(Cases& cases, const char* name, bool has_sign, double scale, F f) {
  add_case(cases, Types<Float<L>>(), Types<Uint<1>>(), {name, "r = $(a);"}, f, [=](const Operands& x) {
    std::vector<Expected> results;
    for (int k = 0; k < L; ++k) {
      constexpr int bits = 32 / L;
      const auto code = static_cast<int64_t>(x[0][0]) >> (bits * k) & ((int64_t{1} << bits) - 1);
      const int64_t number = has_sign && code >> (bits - 1) != 0 ? code - (int64_t{1} << bits) : code;
      const double value = std::max(static_cast<double>(number) / scale, -1.0);
      results.push_back({value, rounded()(value, {}), 2.5 * ulp_of(value)});  // a quotient
    }
    return results;
  });
}

/// The number of the half with these bits.
double number_of_half(uint32_t bits) {
  const int exponent = static_cast<int>(bits >> 10 & 31);
  const double mantissa = static_cast<double>(bits & 1023), sign = (bits & 0x8000) != 0 ? -1.0 : 1.0;
  if (exponent == 31) return mantissa == 0.0 ? sign * std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  return sign * (exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024.0 + mantissa, exponent - 25));
}

double ulp_of_half(double value, const std::vector<double>&) {
  return std::ldexp(1.0, std::max(value == 0.0 ? -14 : std::ilogb(value), -14) - 10);
}
double half_ulp_of_half(double value, const std::vector<double>& x) { return 0.5 * ulp_of_half(value, x); }

void add_halves(Cases& cases) {
  // The result of the packing is decoded by unpackHalf2x16, which has a case of its own. GLSL does not say how halves are rounded.
  add_by_component(
      cases, Types<Float<2>>(), Types<Float<2>>(),
      {"packHalf2x16",
       "r = unpackHalf2x16(packHalf2x16(a));",
       {magnitudes(-20, 15, {0.0f, 1.0f, -2.0f, 65504.0f, -65504.0f, 0x1p-14f, 0x1p-24f, 1.00048828f, 0.333333f})}},
      [](const auto& v) { return unpackHalf2x16(packHalf2x16(v)); }, [](double x) { return x; }, {half_ulp_of_half, ulp_of_half});
  add_case(
      cases, Types<Float<2>>(), Types<Uint<1>>(), {"unpackHalf2x16", "r = unpackHalf2x16(a);", {packed_halves()}},
      [](const auto& u) { return unpackHalf2x16(u); },
      [](const Operands& x) {
        const auto word = static_cast<uint32_t>(x[0][0]);
        std::vector<Expected> results;
        for (const uint32_t bits : {word & 0xffff, word >> 16}) {
          const double value = number_of_half(bits);
          const bool subnormal = (bits & 0x7c00) == 0;  // may be replaced by 0
          results.push_back({value, 0.0, limit_for_glsl(subnormal ? 0x1p-14 : 0.0, value)});
        }
        return results;
      });
}

void add_packing(Cases& cases) {
  add_pack<2, Uint<2>, 0, 65535>(cases, "packUnorm2x16", [](const auto& v) { return packUnorm2x16(v); });
  add_pack<2, Int<2>, -1, 32767>(cases, "packSnorm2x16", [](const auto& v) { return packSnorm2x16(v); });
  add_pack<4, Uint<4>, 0, 255>(cases, "packUnorm4x8", [](const auto& v) { return packUnorm4x8(v); });
  add_pack<4, Int<4>, -1, 127>(cases, "packSnorm4x8", [](const auto& v) { return packSnorm4x8(v); });
  add_unpack<2>(cases, "unpackUnorm2x16", false, 65535.0, [](const auto& u) { return unpackUnorm2x16(u); });
  add_unpack<2>(cases, "unpackSnorm2x16", true, 32767.0, [](const auto& u) { return unpackSnorm2x16(u); });
  add_unpack<4>(cases, "unpackUnorm4x8", false, 255.0, [](const auto& u) { return unpackUnorm4x8(u); });
  add_unpack<4>(cases, "unpackSnorm4x8", true, 127.0, [](const auto& u) { return unpackSnorm4x8(u); });
  add_halves(cases);
}

// ---- integers ------------------------------------------------------------------------------------------------------

uint64_t bits_from(uint64_t value, int64_t offset, int64_t count) { return value >> offset & ((uint64_t{1} << count) - 1); }

/// T is Int<L> or Uint<L>.
template <int L, class T>
void add_bits(Cases& cases) {
  const auto in_word = where([](const std::vector<double>& x) { return x[x.size() - 2] + x[x.size() - 1] <= 32.0; });
  const Domain places = integers_between(0, 32);
  add_by_component(
      cases, Types<T>(), Types<T, Int<1>, Int<1>>(),
      {"bitfieldExtract", "r = bitfieldExtract(a, b, c);", {integers(), places, places}, in_word},
      [](const auto& value, const auto& offset, const auto& bits) { return bitfieldExtract(value, offset, bits); },
      [](auto value, int64_t offset, int64_t bits) {
        const uint64_t field = bits_from(static_cast<uint32_t>(value), offset, bits);
        const bool negative = T::base == Base::integer && bits > 0 && field >> (bits - 1) != 0;
        return negative ? field - (uint64_t{1} << bits) : field;
      });
  add_by_component(
      cases, Types<T>(), Types<T, T, Int<1>, Int<1>>(),
      {"bitfieldInsert", "r = bitfieldInsert(a, b, c, d);", {integers(), integers(), places, places}, in_word},
      [](const auto& base, const auto& insert, const auto& offset, const auto& bits) { return bitfieldInsert(base, insert, offset, bits); },
      [](auto base, auto insert, int64_t offset, int64_t bits) {
        const uint64_t mask = ((uint64_t{1} << bits) - 1) << offset;
        return (static_cast<uint32_t>(base) & ~mask) | (uint64_t{static_cast<uint32_t>(insert)} << offset & mask);
      });
  add_by_component(
      cases, Types<T>(), Types<T>(), {"bitfieldReverse", "r = bitfieldReverse(a);"}, [](const auto& x) { return bitfieldReverse(x); },
      [](auto x) {
        uint32_t reversed = 0;
        for (int n = 0; n < 32; ++n) reversed |= (static_cast<uint32_t>(x) >> n & 1) << (31 - n);
        return reversed;
      });
  add_by_component(
      cases, Types<Int<L>>(), Types<T>(), {"bitCount", "r = bitCount(a);"}, [](const auto& x) { return bitCount(x); },
      [](auto x) { return std::popcount(static_cast<uint32_t>(x)); });
  add_by_component(
      cases, Types<Int<L>>(), Types<T>(), {"findLSB", "r = findLSB(a);"}, [](const auto& x) { return findLSB(x); },
      [](auto x) { return x == 0 ? -1 : std::countr_zero(static_cast<uint32_t>(x)); });
  add_by_component(
      cases, Types<Int<L>>(), Types<T>(), {"findMSB", "r = findMSB(a);"}, [](const auto& x) { return findMSB(x); },
      [](auto x) {
        const auto word = static_cast<uint32_t>(x);
        return 31 - std::countl_zero(T::base == Base::integer && (word >> 31) != 0 ? ~word : word);
      });
}

template <int L>
void add_extended(Cases& cases) {
  using I = Int<L>;
  using U = Uint<L>;
  add_by_component(
      cases, Types<U, U>(), Types<U, U>(), {"uaddCarry", "r = uaddCarry(a, b, s);"},
      [](auto& r, auto& carry, const auto& x, const auto& y) { r = uaddCarry(x, y, carry); },
      [](uint64_t x, uint64_t y) { return std::make_tuple(x + y, (x + y) >> 32); });
  add_by_component(
      cases, Types<U, U>(), Types<U, U>(), {"usubBorrow", "r = usubBorrow(a, b, s);"},
      [](auto& r, auto& borrow, const auto& x, const auto& y) { r = usubBorrow(x, y, borrow); },
      [](uint64_t x, uint64_t y) { return std::make_tuple(x - y, x < y ? 1 : 0); });
  add_by_component(
      cases, Types<U, U>(), Types<U, U>(), {"umulExtended", "umulExtended(a, b, r, s);"},
      [](auto& msb, auto& lsb, const auto& x, const auto& y) { umulExtended(x, y, msb, lsb); },
      [](uint64_t x, uint64_t y) { return std::make_tuple(x * y >> 32, x * y); });
  add_by_component(
      cases, Types<I, I>(), Types<I, I>(), {"imulExtended", "imulExtended(a, b, r, s);"},
      [](auto& msb, auto& lsb, const auto& x, const auto& y) { imulExtended(x, y, msb, lsb); },
      [](int64_t x, int64_t y) { return std::make_tuple(x * y >> 32, x * y); });
}

}  // namespace

Cases integer_cases() {
  Cases cases;
  add_packing(cases);
  for_lengths([&]<int L>() {
    add_bits<L, Int<L>>(cases);
    add_bits<L, Uint<L>>(cases);
    add_extended<L>(cases);
  });
  return cases;
}

}  // namespace halfspace::conformance::builtins
