// SPDX-License-Identifier: Apache-2.0
//
// The common functions (GLSL 4.60, section 8.3).
#include "conformance/builtin_calls.h"

namespace halfspace::conformance::builtins {

namespace {

template <class Base, class F, class Reference>
void add_function(Cases& cases, const char* name, const Domain& domain, F f, Reference reference, const Bounds& bounds = {}) {
  add_by_component(cases, Types<Base>(), Types<Base>(), {name, "r = $(a);", {domain}}, f, reference, bounds);
}

/// Halves may be rounded to either side (section 8.3, round).
double round_error(double, const std::vector<double>& x) { return std::fabs(x[0] - std::trunc(x[0])) == 0.5 ? 1.0 : 0.0; }

double mod_of(double x, double y) {
  const double rest = std::fmod(x, y);
  return rest != 0.0 && (rest < 0.0) != (y < 0.0) ? rest + y : rest;
}
/// By its definition x − y·floor(x/y), where a quotient within 2.5 ulp of an integer may be rounded to its other side.
double mod_error(double value, const std::vector<double>& x) {
  const double quotient = x[0] / x[1], roundings = ulp_of(x[0]) + ulp_of(value);
  return std::fabs(quotient - std::round(quotient)) <= 2.5 * ulp_of(quotient) ? std::fabs(x[1]) + roundings : roundings;
}

double mix_error(double, const std::vector<double>& x) {
  return 3.0 * kRounding * (std::fabs(x[0] * (1.0 - x[2])) + std::fabs(x[1] * x[2]));
}
/// An implementation may compute x + (y − x)·a as well, whose terms are larger.
double other_mix_error(double, const std::vector<double>& x) {
  return 4.0 * kRounding * (std::fabs(x[0]) + (std::fabs(x[0]) + std::fabs(x[1])) * std::fabs(x[2]));
}
/// Three roundings for t with a weight of at most 2, and four for the polynomial. A quotient of other implementations has 2.5 ulp.
double smoothstep_error(double value, const std::vector<double>&) { return 10.0 * kRounding * value; }
double other_smoothstep_error(double value, const std::vector<double>&) { return 20.0 * kRounding * value; }

template <int L>
void add_roundings(Cases& cases) {
  using T = Float<L>;
  const Domain all = numbers_and_infinities();
  add_function<T>(
      cases, "abs", all, [](const auto& x) { return abs(x); }, [](double x) { return std::fabs(x); });
  add_function<T>(
      cases, "sign", all, [](const auto& x) { return sign(x); }, [](double x) { return (x > 0.0) - (x < 0.0); });
  add_function<T>(
      cases, "floor", all, [](const auto& x) { return floor(x); }, [](double x) { return std::floor(x); });
  add_function<T>(
      cases, "trunc", all, [](const auto& x) { return trunc(x); }, [](double x) { return std::trunc(x); });
  add_function<T>(
      cases, "round", all, [](const auto& x) { return round(x); }, [](double x) { return std::round(x); }, {exact(), round_error});
  add_function<T>(
      cases, "roundEven", all, [](const auto& x) { return roundEven(x); }, [](double x) { return std::nearbyint(x); });
  add_function<T>(
      cases, "ceil", all, [](const auto& x) { return ceil(x); }, [](double x) { return std::ceil(x); });
  add_function<T>(
      cases, "fract", numbers(), [](const auto& x) { return fract(x); }, [](double x) { return x - std::floor(x); },
      {rounded(), ulps(1.0)});
  add_by_component(
      cases, Types<T, T>(), Types<T>(), {"modf", "r = modf(a, s);", {numbers()}}, [](auto& r, auto& i, const auto& x) { r = modf(x, i); },
      [](double x) { return std::make_tuple(x - std::trunc(x), std::trunc(x)); });
  add_by_component(
      cases, Types<Bool<L>>(), Types<T>(), {"isnan", "r = isnan(a);", {numbers_infinities_and_nan()}},
      [](const auto& x) { return isnan(x); }, [](double x) { return std::isnan(x); });
  add_by_component(
      cases, Types<Bool<L>>(), Types<T>(), {"isinf", "r = isinf(a);", {all}}, [](const auto& x) { return isinf(x); },
      [](double x) { return std::isinf(x); });
}

/// Functions that accept vectors of L components, and in place of some vectors also numbers: S is Float<L> or Float<1>.
template <int L, class S>
void add_with_limits(Cases& cases) {
  using T = Float<L>;
  const Domain all = numbers_and_infinities();
  add_by_component(
      cases, Types<T>(), Types<T, S>(), {"min", "r = min(a, b);", {all, all}}, [](const auto& x, const auto& y) { return min(x, y); },
      [](double x, double y) { return std::min(x, y); });
  add_by_component(
      cases, Types<T>(), Types<T, S>(), {"max", "r = max(a, b);", {all, all}}, [](const auto& x, const auto& y) { return max(x, y); },
      [](double x, double y) { return std::max(x, y); });
  add_by_component(
      cases, Types<T>(), Types<T, S, S>(),
      {"clamp", "r = clamp(a, b, c);", {all, all, all}, where([](const std::vector<double>& x) { return x[1] <= x[2]; })},
      [](const auto& x, const auto& low, const auto& high) { return clamp(x, low, high); },
      [](double x, double low, double high) { return std::min(std::max(x, low), high); });
  add_by_component(
      cases, Types<T>(), Types<S, T>(), {"step", "r = step(a, b);", {all, all}},
      [](const auto& edge, const auto& x) { return step(edge, x); }, [](double edge, double x) { return x < edge ? 0.0 : 1.0; });
  const Domain lengths = magnitudes(-8, 8, {1.0f, -1.0f, 3.0f, 0.75f, -360.0f});
  add_by_component(
      cases, Types<T>(), Types<T, S>(), {"mod", "r = mod(a, b);", {magnitudes(-8, 8, {0.0f, 6.0f, -6.0f, 720.0f}), lengths}},
      [](const auto& x, const auto& y) { return mod(x, y); }, [](double x, double y) { return mod_of(x, y); }, {rounded(), mod_error});
  add_by_component(
      cases, Types<T>(), Types<T, T, S>(),
      {"mix", "r = mix(a, b, c);", {moderate(), moderate(), between(-0.5, 1.5, {0.0f, 1.0f, 0.5f, 0.25f})}},
      [](const auto& x, const auto& y, const auto& a) { return mix(x, y, a); },
      [](double x, double y, double a) { return x * (1.0 - a) + y * a; }, {mix_error, other_mix_error});
  add_by_component(
      cases, Types<T>(), Types<S, S, T>(),
      {"smoothstep",
       "r = smoothstep(a, b, c);",
       {between(-4, 4, {0.0f, -1.0f}), between(-4, 4, {1.0f, 2.0f}), between(-4, 4, {0.5f, 0.0f, 1.0f})},
       where([](const std::vector<double>& x) { return x[0] < x[1]; })},
      [](const auto& low, const auto& high, const auto& x) { return smoothstep(low, high, x); },
      [](double low, double high, double x) {
        const double t = std::min(std::max((x - low) / (high - low), 0.0), 1.0);
        return t * t * (3.0 - 2.0 * t);
      },
      {smoothstep_error, other_smoothstep_error});
}

template <int L>
void add_selections(Cases& cases) {
  const auto select_one = [](const auto& x, const auto& y, const auto& a) { return mix(x, y, a); };
  const auto select_exactly = [](auto x, auto y, bool a) { return a ? y : x; };
  const auto add = [&]<class T>(std::type_identity<T>) {
    add_by_component(cases, Types<T>(), Types<T, T, Bool<L>>(), {"mix", "r = mix(a, b, c);"}, select_one, select_exactly);
  };
  add(std::type_identity<Float<L>>());
  add(std::type_identity<Int<L>>());
  add(std::type_identity<Uint<L>>());
}

template <int L>
void add_representations(Cases& cases) {
  const auto to_bits = [](double x) { return word_of(static_cast<float>(x)); };
  const auto from_bits = [](auto i) { return static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(i))); };
  add_by_component(
      cases, Types<Int<L>>(), Types<Float<L>>(), {"floatBitsToInt", "r = floatBitsToInt(a);", {numbers_and_infinities()}},
      [](const auto& x) { return floatBitsToInt(x); }, to_bits);
  add_by_component(
      cases, Types<Uint<L>>(), Types<Float<L>>(), {"floatBitsToUint", "r = floatBitsToUint(a);", {numbers_and_infinities()}},
      [](const auto& x) { return floatBitsToUint(x); }, to_bits);
  add_by_component(
      cases, Types<Float<L>>(), Types<Int<L>>(), {"intBitsToFloat", "r = intBitsToFloat(a);", {words_of_floats()}},
      [](const auto& x) { return intBitsToFloat(x); }, from_bits);
  add_by_component(
      cases, Types<Float<L>>(), Types<Uint<L>>(), {"uintBitsToFloat", "r = uintBitsToFloat(a);", {words_of_floats()}},
      [](const auto& x) { return uintBitsToFloat(x); }, from_bits);
}

/// Section 4.7.1: fma() may also round the product.
double fma_error(double value, const std::vector<double>& x) { return 0.5 * ulp_of(x[0] * x[1]) + (0.5 + 0x1p-20) * ulp_of(value); }

template <int L>
void add_exponents(Cases& cases) {
  add_by_component(
      cases, Types<Float<L>>(), Types<Float<L>, Float<L>, Float<L>>(), {"fma", "r = fma(a, b, c);", {moderate(), moderate(), moderate()}},
      [](const auto& x, const auto& y, const auto& z) { return fma(x, y, z); }, [](double x, double y, double z) { return x * y + z; },
      {rounded(), fma_error});
  add_by_component(
      cases, Types<Float<L>, Int<L>>(), Types<Float<L>>(), {"frexp", "r = frexp(a, s);", {numbers()}},
      [](auto& r, auto& exponent, const auto& x) { r = frexp(x, exponent); },
      [](double x) {
        int exponent = 0;
        const double significand = std::frexp(x, &exponent);
        return std::make_tuple(significand, exponent);
      });
  add_by_component(
      cases, Types<Float<L>>(), Types<Float<L>, Int<L>>(),
      {"ldexp", "r = ldexp(a, b);", {numbers(), integers_between(-60, 60)}, where([](const std::vector<double>& x) {
         return std::fabs(std::ldexp(x[0], static_cast<int>(x[1]))) < kOverflow;
       })},
      [](const auto& x, const auto& exponent) { return ldexp(x, exponent); },
      [](double x, int64_t exponent) { return std::ldexp(x, static_cast<int>(exponent)); }, {rounded(), rounded()});
}

template <int L, class T>
void add_limits_of_integers(Cases& cases) {
  using S = Typed<T::base, 1, 1>;
  const auto add = [&]<class U>(std::type_identity<U>) {
    add_by_component(
        cases, Types<T>(), Types<T, U>(), {"min", "r = min(a, b);"}, [](const auto& x, const auto& y) { return min(x, y); },
        [](auto x, auto y) { return std::min(x, y); });
    add_by_component(
        cases, Types<T>(), Types<T, U>(), {"max", "r = max(a, b);"}, [](const auto& x, const auto& y) { return max(x, y); },
        [](auto x, auto y) { return std::max(x, y); });
    add_by_component(
        cases, Types<T>(), Types<T, U, U>(),
        {"clamp", "r = clamp(a, b, c);", {}, where([](const std::vector<double>& x) { return x[1] <= x[2]; })},
        [](const auto& x, const auto& low, const auto& high) { return clamp(x, low, high); },
        [](auto x, auto low, auto high) { return std::min(std::max(x, low), high); });
  };
  add(std::type_identity<T>());
  if constexpr (L > 1) add(std::type_identity<S>());
}

template <int L>
void add_functions_of_integers(Cases& cases) {
  const auto has_absolute_value = where([](const std::vector<double>& x) { return x[0] > -0x1p31; });
  add_by_component(
      cases, Types<Int<L>>(), Types<Int<L>>(), {"abs", "r = abs(a);", {}, has_absolute_value}, [](const auto& x) { return abs(x); },
      [](int64_t x) { return x < 0 ? -x : x; });
  add_by_component(
      cases, Types<Int<L>>(), Types<Int<L>>(), {"sign", "r = sign(a);"}, [](const auto& x) { return sign(x); },
      [](int64_t x) { return (x > 0) - (x < 0); });
  add_limits_of_integers<L, Int<L>>(cases);
  add_limits_of_integers<L, Uint<L>>(cases);
}

}  // namespace

Cases common_cases() {
  Cases cases;
  for_lengths([&]<int L>() {
    add_roundings<L>(cases);
    add_with_limits<L, Float<L>>(cases);
    if constexpr (L > 1) add_with_limits<L, Float<1>>(cases);
    add_selections<L>(cases);
    add_representations<L>(cases);
    add_exponents<L>(cases);
    add_functions_of_integers<L>(cases);
  });
  return cases;
}

}  // namespace halfspace::conformance::builtins
