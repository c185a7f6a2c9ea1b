// SPDX-License-Identifier: Apache-2.0
//
// Makes cases of built-in functions: from a call in C++ and in GLSL, a reference in double precision, bounds of errors and domains.
#pragma once

#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "conformance/builtin_functions.h"
#include "halfspace/core/glsl.h"

namespace halfspace::conformance::builtins {

/// Eight lanes in every build. Those of other widths and scalars give the same bits (tests/core).
using Lanes = RealN<8>;
/// Number of calls per case.
inline constexpr int kCalls = 64;
static_assert(kCalls % kWidthOf<Lanes> == 0);

// ---- types ---------------------------------------------------------------------------------------------------------

template <Base base>
struct ComponentT : std::type_identity<Lanes> {};
template <>
struct ComponentT<Base::integer> : std::type_identity<IntOf<Lanes>> {};
template <>
struct ComponentT<Base::natural> : std::type_identity<UintOf<Lanes>> {};
template <>
struct ComponentT<Base::boolean> : std::type_identity<MaskOf<Lanes>> {};

/// A type of GLSL and the type of C++ that stands for it.
template <Base b, int C, int L>
struct Typed {
  static constexpr Base base = b;
  static constexpr int columns = C, rows = L;
  static constexpr Type type{b, C, L};
  using Component = typename ComponentT<b>::type;
  using Value = detail::VectorOf<L == 1 ? 0 : L, Component>;
};
template <int C, int L>
requires(C > 1) struct Typed<Base::real, C, L> {
  static constexpr Base base = Base::real;
  static constexpr int columns = C, rows = L;
  static constexpr Type type{Base::real, C, L};
  using Component = Lanes;
  using Value = MatN<C, L, Lanes>;
};
template <int L>
using Float = Typed<Base::real, 1, L>;
template <int L>
using Int = Typed<Base::integer, 1, L>;
template <int L>
using Uint = Typed<Base::natural, 1, L>;
template <int L>
using Bool = Typed<Base::boolean, 1, L>;
template <int C, int L>
using Matrix = Typed<Base::real, C, L>;

template <class... T>
struct Types {};

// ---- calls on lanes ------------------------------------------------------------------------------------------------

template <class T>
auto& component_of(typename T::Value& v, int k) {
  if constexpr (T::columns > 1) {
    return v[k / T::rows][k % T::rows];
  } else if constexpr (T::rows > 1) {
    return v[k];
  } else {
    return v;
  }
}

/// Reads an argument of all lanes, which begins at `word` and ends at the new `word`.
template <class T>
typename T::Value load(const Words* calls, std::size_t& word) {
  typename T::Value v{};
  for (int k = 0; k < T::columns * T::rows; ++k, ++word) {
    IntOf<Lanes> bits(0);
    for (int i = 0; i < kWidthOf<Lanes>; ++i) set_lane(bits, i, static_cast<int32_t>(calls[i][word]));
    if constexpr (T::base == Base::real) component_of<T>(v, k) = as_real(bits);
    if constexpr (T::base == Base::integer) component_of<T>(v, k) = bits;
    if constexpr (T::base == Base::natural) component_of<T>(v, k) = UintOf<Lanes>(bits);
    if constexpr (T::base == Base::boolean) component_of<T>(v, k) = bits != IntOf<Lanes>(0);
  }
  return v;
}
template <class T>
void store(typename T::Value& v, Words* answers, std::size_t& word) {
  for (int k = 0; k < T::columns * T::rows; ++k, ++word) {
    IntOf<Lanes> bits(0);
    if constexpr (T::base == Base::real) bits = as_int(component_of<T>(v, k));
    if constexpr (T::base == Base::integer) bits = component_of<T>(v, k);
    if constexpr (T::base == Base::natural) bits = IntOf<Lanes>(component_of<T>(v, k));
    if constexpr (T::base == Base::boolean) bits = select(component_of<T>(v, k), IntOf<Lanes>(1), IntOf<Lanes>(0));
    for (int i = 0; i < kWidthOf<Lanes>; ++i) answers[i][word] = static_cast<uint32_t>(lane(bits, i));
  }
}

template <class Out, class In, class F>
struct Call;
/// Calls F with references to the results and with the arguments, or only with the arguments if it returns the only result.
template <class... Out, class... In, class F>
struct Call<Types<Out...>, Types<In...>, F> {
  static void run(const Words* calls, Words* answers) {
    std::tuple<typename Out::Value...> out{};
    std::size_t word = 0;
    const std::tuple<typename In::Value...> in{load<In>(calls, word)...};
    std::apply(
        [&](auto&... o) {
          std::apply(
              [&](const auto&... a) {
                if constexpr (std::is_invocable_v<F, decltype(o)..., decltype(a)...>) {
                  F()(o..., a...);
                } else {
                  ((o = F()(a...)), ...);
                }
              },
              in);
          std::size_t result = 0;
          (store<Out>(o, answers, result), ...);
        },
        out);
  }
};

// ---- bounds of errors ----------------------------------------------------------------------------------------------

/// Numbers from here on are rounded to an infinity.
inline constexpr double kOverflow = 0x1.ffffffp127;
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();
/// The rounding of a float, relative to its value.
inline constexpr double kRounding = 0x1p-24;

/// Distance between neighboring floats at x.
inline double ulp_of(double x) {
  if (x == 0.0 || !std::isfinite(x)) return 0x1p-149;
  return std::ldexp(1.0, std::max(std::ilogb(x), -126) - 23);
}

/// The largest error of a component: a sum of three terms. The last one depends on the value and on the components of which it is computed.
struct Bound {
  using Function = double (*)(double value, const std::vector<double>& x);
  double ulps = 0.0, absolute = 0.0;
  Function function = nullptr;

  Bound() = default;
  Bound(double count, double error) : ulps(count), absolute(error) {}
  template <std::convertible_to<Function> F>
  Bound(F f) : function(f) {}

  double operator()(double value, const std::vector<double>& x) const {
    return ulps * ulp_of(value) + absolute + (function == nullptr ? 0.0 : function(value, x));
  }
};
inline Bound exact() { return {}; }
inline Bound ulps(double count) { return {count, 0.0}; }
inline Bound absolute(double error) { return {0.0, error}; }
/// Correctly rounded. The reference has been rounded as well, to 53 bits.
inline Bound rounded() { return ulps(0.5 + 0x1p-20); }

/// The error of Halfspace (docs/reference/shading_language.md) and that of GLSL 4.60, section 4.7.1.
struct Bounds {
  Bound ours{}, glsl{};
};
/// The limit for other implementations of a number: they may have no infinities and NaN, and may replace subnormal numbers by 0.
double limit_for_glsl(double allowed, double value);

// ---- domains -------------------------------------------------------------------------------------------------------

inline uint32_t word_of(float x) { return std::bit_cast<uint32_t>(x); }
/// Numbers from low to high.
Domain between(double low, double high, std::initializer_list<float> special = {});
/// Numbers of all magnitudes from 2^low to 2^high, and their negatives.
Domain magnitudes(int low, int high, std::initializer_list<float> special = {});
Domain positive(int low, int high, std::initializer_list<float> special = {});
/// Finite numbers of all kinds.
Domain numbers();
Domain numbers_and_infinities();
Domain numbers_infinities_and_nan();
/// Numbers from 2^-4 to 2^4, whose squares and products are far from overflow and underflow.
Domain moderate();
Domain unit_vectors();
/// Integers with any number of bits.
Domain integers();
Domain integers_between(int low, int high);
/// Words with two halves.
Domain packed_halves();
Domain booleans();
/// The numbers 0 and 1.
Domain real_zero_or_one();
/// Words of finite, normal floats, for integers that are turned into floats.
Domain words_of_floats();

// ---- cases ---------------------------------------------------------------------------------------------------------

/// The number in double precision, or the integer with 64 bits.
template <class T>
auto exact_operand(double x) {
  if constexpr (T::base == Base::real) return x;
  if constexpr (T::base == Base::integer) return static_cast<int64_t>(x);
  if constexpr (T::base == Base::natural) return static_cast<uint64_t>(x);
  if constexpr (T::base == Base::boolean) return x != 0.0;
}
/// A result as a number. Of integers, the low 32 bits count.
template <class T, class V>
double exact_result(V v) {
  if constexpr (std::is_floating_point_v<V> || T::base == Base::real) {
    return static_cast<double>(v);
  } else if constexpr (T::base == Base::integer) {
    return static_cast<double>(static_cast<int32_t>(static_cast<uint32_t>(v)));
  } else if constexpr (T::base == Base::natural) {
    return static_cast<double>(static_cast<uint32_t>(v));
  } else {
    return v ? 1.0 : 0.0;
  }
}

template <class Out, class In, class Reference>
struct Evaluation;
/// Evaluates a component in double precision. Reference returns the result or a tuple of results.
template <class... Out, class... In, class Reference>
struct Evaluation<Types<Out...>, Types<In...>, Reference> {
  static void run(const double* x, double* values) {
    const auto results = [x]<std::size_t... P>(std::index_sequence<P...>) {
      if constexpr (sizeof...(Out) == 1) {
        return std::make_tuple(Reference()(exact_operand<In>(x[P])...));
      } else {
        return Reference()(exact_operand<In>(x[P])...);
      }
    }
    (std::index_sequence_for<In...>());
    std::apply([&](const auto&... v) { ((*values++ = exact_result<Out>(v)), ...); }, results);
  }
};

/// What GLSL demands of the arguments: of all of them, or of the components with the same number.
struct Condition {
  bool (*of_all)(const Operands& operands) = nullptr;
  bool (*of_component)(const std::vector<double>& x) = nullptr;

  bool operator()(const Operands& operands) const;
};
inline Condition where(bool (*condition)(const std::vector<double>& x)) { return {nullptr, condition}; }

/// What is the same for all lengths of vectors.
struct Description {
  std::string_view name, glsl;      ///< In the GLSL, $ stands for the name.
  std::array<Domain, 4> domains{};  ///< if the first one is missing, all values of the types
  Condition defined{};
};

/// The types of a case.
struct Signature {
  std::span<const Type> results, parameters;
};
template <class... T>
inline constexpr std::array<Type, sizeof...(T)> kTypes{T::type...};
template <class... Out, class... In>
Signature signature_of(Types<Out...>, Types<In...>) {
  static_assert(((In::columns * In::rows) + ...) <= kMaxWords && ((Out::columns * Out::rows) + ...) <= kMaxWords);
  return {kTypes<Out...>, kTypes<In...>};
}

using LaneFunction = void (*)(const Words* calls, Words* answers);
using ComponentFunction = void (*)(const double* x, double* values);
void add(Cases& cases, const Signature& signature, const Description& d, LaneFunction call,
         std::function<std::vector<Expected>(const Operands&)> reference);
void add(Cases& cases, const Signature& signature, const Description& d, LaneFunction call, ComponentFunction reference,
         const Bounds& bounds);

/// F and Reference are classes without members, such as lambdas without captures.
template <class Out, class In, class F>
void add_case(Cases& cases, Out out, In in, const Description& d, F, std::function<std::vector<Expected>(const Operands&)> reference) {
  static_assert(std::is_empty_v<F>);
  add(cases, signature_of(out, in), d, Call<Out, In, F>::run, std::move(reference));
}
template <class Out, class In, class F, class Reference>
void add_by_component(Cases& cases, Out out, In in, const Description& d, F, Reference, const Bounds& bounds = {}) {
  static_assert(std::is_empty_v<F> && std::is_empty_v<Reference>);
  add(cases, signature_of(out, in), d, Call<Out, In, F>::run, Evaluation<Out, In, Reference>::run, bounds);
}

/// Calls f with the lengths of vectors, where 1 is a scalar.
template <class F>
void for_vectors(F f) {
  f.template operator()<2>();
  f.template operator()<3>();
  f.template operator()<4>();
}
template <class F>
void for_lengths(F f) {
  f.template operator()<1>();
  for_vectors(f);
}
/// Calls f with all numbers of columns and rows of matrices.
template <class F>
void for_matrices(F f) {
  const auto with_columns = [&]<int C>() { for_vectors([&]<int L>() { f.template operator()<C, L>(); }); };
  for_vectors(with_columns);
}

}  // namespace halfspace::conformance::builtins
