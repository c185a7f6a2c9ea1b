// SPDX-License-Identifier: Apache-2.0
//
// The relational functions (GLSL 4.60, section 8.7), operators (section 5.9), conversions and swizzles (sections 5.4 and 5.5).
#include "conformance/builtin_calls.h"

namespace halfspace::conformance::builtins {

namespace {

// ---- relational functions ------------------------------------------------------------------------------------------

template <class T>
void add_comparisons(Cases& cases) {
  using B = Bool<T::rows>;
  // Values that are often equal.
  const Domain few =
      T::base == Base::real ? between(-2, 2, {0.0f, -0.0f, 1.0f, -1.0f, 1e30f, std::numeric_limits<float>::infinity()}) : integers();
  const auto add = [&](const char* name, auto f, auto reference) {
    add_by_component(cases, Types<B>(), Types<T, T>(), {name, "r = $(a, b);", {few, few}}, f, reference);
  };
  add(
      "lessThan", [](const auto& a, const auto& b) { return lessThan(a, b); }, [](auto a, auto b) { return a < b; });
  add(
      "lessThanEqual", [](const auto& a, const auto& b) { return lessThanEqual(a, b); }, [](auto a, auto b) { return a <= b; });
  add(
      "greaterThan", [](const auto& a, const auto& b) { return greaterThan(a, b); }, [](auto a, auto b) { return a > b; });
  add(
      "greaterThanEqual", [](const auto& a, const auto& b) { return greaterThanEqual(a, b); }, [](auto a, auto b) { return a >= b; });
  add(
      "equal", [](const auto& a, const auto& b) { return equal(a, b); }, [](auto a, auto b) { return a == b; });
  add(
      "notEqual", [](const auto& a, const auto& b) { return notEqual(a, b); }, [](auto a, auto b) { return a != b; });
}

template <int L>
void add_functions_of_booleans(Cases& cases) {
  using B = Bool<L>;
  add_by_component(
      cases, Types<B>(), Types<B, B>(), {"equal", "r = equal(a, b);"}, [](const auto& a, const auto& b) { return equal(a, b); },
      [](bool a, bool b) { return a == b; });
  add_by_component(
      cases, Types<B>(), Types<B, B>(), {"notEqual", "r = notEqual(a, b);"}, [](const auto& a, const auto& b) { return notEqual(a, b); },
      [](bool a, bool b) { return a != b; });
  add_by_component(
      cases, Types<B>(), Types<B>(), {"not", "r = not(a);"}, [](const auto& a) { return not(a); }, [](bool a) { return !a; });
  const auto count_of = [](const Operands& x) {
    double count = 0.0;
    for (const double b : x[0]) count += b;
    return count;
  };
  add_case(
      cases, Types<Bool<1>>(), Types<B>(), {"any", "r = any(a);"}, [](const auto& a) { return any(a); },
      [=](const Operands& x) -> std::vector<Expected> { return {{count_of(x) > 0.0 ? 1.0 : 0.0}}; });
  add_case(
      cases, Types<Bool<1>>(), Types<B>(), {"all", "r = all(a);"}, [](const auto& a) { return all(a); },
      [=](const Operands& x) -> std::vector<Expected> { return {{count_of(x) == L ? 1.0 : 0.0}}; });
}

// ---- operators -----------------------------------------------------------------------------------------------------

/// r = a op b, where A and B may be vectors and scalars, and R is the type of the result. Integer and boolean results are exact.
template <class R, class A, class B, class F, class Reference>
void add_operator(Cases& cases, const char* name, const char* glsl, const Description& limits, F f, Reference reference,
                  const Bounds& bounds = {}) {
  add_by_component(cases, Types<R>(), Types<A, B>(), {name, glsl, limits.domains, limits.defined}, f, reference, bounds);
}

double quotient_error(double value, const std::vector<double>& x) {
  return std::fabs(x[1]) >= 0x1p-126 && std::fabs(x[1]) <= 0x1p126 ? 2.5 * ulp_of(value) : kUnbounded;
}

/// The operators of floats. A or B may be a scalar.
template <class R, class A, class B>
void add_arithmetic(Cases& cases) {
  const Domain wide = magnitudes(-30, 30, {0.0f, 1.0f, -1.0f, 1e30f, -3e38f, 0x1p-120f, 16777217.0f});
  const Description any{"", "", {wide, wide}};
  const Description divisible{"", "", {wide, wide}, where([](const std::vector<double>& x) { return x[1] != 0.0; })};
  const Bounds correct{rounded(), rounded()};
  add_operator<R, A, B>(
      cases, "add", "r = a + b;", any, [](const auto& a, const auto& b) { return a + b; }, [](double a, double b) { return a + b; },
      correct);
  add_operator<R, A, B>(
      cases, "subtract", "r = a - b;", any, [](const auto& a, const auto& b) { return a - b; }, [](double a, double b) { return a - b; },
      correct);
  add_operator<R, A, B>(
      cases, "multiply", "r = a * b;", any, [](const auto& a, const auto& b) { return a * b; }, [](double a, double b) { return a * b; },
      correct);
  add_operator<R, A, B>(
      cases, "divide", "r = a / b;", divisible, [](const auto& a, const auto& b) { return a / b; },
      [](double a, double b) { return a / b; }, {rounded(), quotient_error});
}

/// The operators of integers.
template <class R, class A, class B>
void add_integer_arithmetic(Cases& cases) {
  const auto add = [&](const char* name, const char* glsl, const Description& limits, auto f, auto reference) {
    add_operator<R, A, B>(cases, name, glsl, limits, f, reference);
  };
  add(
      "add", "r = a + b;", {}, [](const auto& a, const auto& b) { return a + b; }, [](auto a, auto b) { return a + b; });
  add(
      "subtract", "r = a - b;", {}, [](const auto& a, const auto& b) { return a - b; }, [](auto a, auto b) { return a - b; });
  add(
      "multiply", "r = a * b;", {}, [](const auto& a, const auto& b) { return a * b; }, [](auto a, auto b) { return a * b; });
  // Quotients by 0 and the quotient that overflows are undefined, and so are remainders of negative numbers.
  const auto divisible = where([](const std::vector<double>& x) { return x[1] != 0.0 && (x[0] != -0x1p31 || x[1] != -1.0); });
  const auto not_negative = where([](const std::vector<double>& x) { return x[0] >= 0.0 && x[1] > 0.0; });
  add(
      "divide", "r = a / b;", {"", "", {}, divisible}, [](const auto& a, const auto& b) { return a / b; },
      [](auto a, auto b) { return a / b; });
  add(
      "modulo", "r = a % b;", {"", "", {}, not_negative}, [](const auto& a, const auto& b) { return a % b; },
      [](auto a, auto b) { return a % b; });
  add(
      "and", "r = a & b;", {}, [](const auto& a, const auto& b) { return a & b; }, [](auto a, auto b) { return a & b; });
  add(
      "or", "r = a | b;", {}, [](const auto& a, const auto& b) { return a | b; }, [](auto a, auto b) { return a | b; });
  add(
      "xor", "r = a ^ b;", {}, [](const auto& a, const auto& b) { return a ^ b; }, [](auto a, auto b) { return a ^ b; });
}

/// A shift, whose count may have another sign than the shifted number, or be a scalar.
template <class A, class B>
void add_shifts(Cases& cases) {
  const Description counted{"", "", {integers(), integers_between(0, 31)}};
  add_operator<A, A, B>(
      cases, "shift_left", "r = a << b;", counted, [](const auto& a, const auto& b) { return a << b; },
      [](auto a, auto b) { return a << b; });
  add_operator<A, A, B>(
      cases, "shift_right", "r = a >> b;", counted, [](const auto& a, const auto& b) { return a >> b; },
      [](auto a, auto b) { return a >> b; });
}

template <class T>
void add_unary(Cases& cases) {
  add_by_component(
      cases, Types<T>(), Types<T>(), {"negate", "r = -a;"}, [](const auto& a) { return -a; }, [](auto a) { return -a; });
  if constexpr (T::base != Base::real) {
    add_by_component(
        cases, Types<T>(), Types<T>(), {"complement", "r = ~a;"}, [](const auto& a) { return ~a; }, [](auto a) { return ~a; });
  }
}

/// Assignments with an operator: r = a; r op= b.
template <class T>
void add_assignments(Cases& cases) {
  const auto add = [&](const char* name, const char* glsl, auto f, auto reference, const Bounds& bounds) {
    const auto defined = where([](const std::vector<double>& x) { return x[1] != 0.0 && (x[0] != -0x1p31 || x[1] != -1.0); });
    const Domain domain = T::base == Base::real ? moderate() : integers();
    add_by_component(cases, Types<T>(), Types<T, T>(), {name, glsl, {domain, domain}, defined}, f, reference, bounds);
  };
  const bool real = T::base == Base::real;
  const Bounds correct = real ? Bounds{rounded(), rounded()} : Bounds(), quotient = real ? Bounds{rounded(), ulps(2.5)} : Bounds();
  add(
      "assign_sum", "r = a; r += b;", [](auto& r, const auto& a, const auto& b) { r = a, r += b; }, [](auto a, auto b) { return a + b; },
      correct);
  add(
      "assign_difference", "r = a; r -= b;", [](auto& r, const auto& a, const auto& b) { r = a, r -= b; },
      [](auto a, auto b) { return a - b; }, correct);
  add(
      "assign_product", "r = a; r *= b;", [](auto& r, const auto& a, const auto& b) { r = a, r *= b; },
      [](auto a, auto b) { return a * b; }, correct);
  add(
      "assign_quotient", "r = a; r /= b;", [](auto& r, const auto& a, const auto& b) { r = a, r /= b; },
      [](auto a, auto b) { return a / b; }, quotient);
}

template <class T>
void add_scalar_comparisons(Cases& cases) {
  using B = Bool<1>;
  const auto add = [&](const char* name, const char* glsl, auto f) { add_operator<B, T, T>(cases, name, glsl, {}, f, f); };
  add("less", "r = a < b;", [](const auto& a, const auto& b) { return a < b; });
  add("less_or_equal", "r = a <= b;", [](const auto& a, const auto& b) { return a <= b; });
  add("greater", "r = a > b;", [](const auto& a, const auto& b) { return a > b; });
  add("greater_or_equal", "r = a >= b;", [](const auto& a, const auto& b) { return a >= b; });
}

/// Component k of the variable t.
template <class T>
std::string component_in_glsl(int k) {
  if (T::columns > 1) return "t[" + std::to_string(k / T::rows) + "][" + std::to_string(k % T::rows) + "]";
  return T::rows > 1 ? "t[" + std::to_string(k) + "]" : "t";
}

/// Compares a with copies of itself, in which b is put in the place of one component after the other. Bit k of the result says whether copy
/// k is equal.
template <class T, class F>
void add_equality(Cases& cases, const char* name, const std::string& symbol, bool if_equal, F) {
  constexpr int count = T::columns * T::rows;
  std::string glsl = "r = 0u; " + glsl_name(T::type) + " t;";
  for (int k = 0; k < count; ++k)
    glsl += " t = a; " + component_in_glsl<T>(k) + " = b; if (a " + symbol + " t) r |= " + std::to_string(1u << k) + "u;";
  const Domain two = T::base == Base::real ? real_zero_or_one() : booleans();
  add_case(
      cases, Types<Uint<1>>(), Types<T, Typed<T::base, 1, 1>>(), {name, glsl, {two, two}},
      [](auto& r, const auto& a, const auto& b) {
        r = UintOf<Lanes>(0u);
        for (int k = 0; k < count; ++k) {
          typename T::Value t = a;
          component_of<T>(t, k) = b;
          r = r | select(F()(a, t), UintOf<Lanes>(1u << k), UintOf<Lanes>(0u));
        }
      },
      [=](const Operands& x) -> std::vector<Expected> {
        double bits = 0.0;
        for (std::size_t k = 0; k < x[0].size(); ++k) bits += (x[0][k] == x[1][0]) == if_equal ? std::exp2(k) : 0.0;
        return {{bits}};
      });
}
template <class T>
void add_equality(Cases& cases) {
  add_equality<T>(cases, "is_equal", "==", true, [](const auto& a, const auto& b) { return a == b; });
  add_equality<T>(cases, "differs", "!=", false, [](const auto& a, const auto& b) { return a != b; });
}

void add_logic(Cases& cases) {
  using B = Bool<1>;
  add_operator<B, B, B>(
      cases, "logical_and", "r = a && b;", {}, [](const auto& a, const auto& b) { return a && b; }, [](bool a, bool b) { return a && b; });
  add_operator<B, B, B>(
      cases, "logical_or", "r = a || b;", {}, [](const auto& a, const auto& b) { return a || b; }, [](bool a, bool b) { return a || b; });
  add_operator<B, B, B>(
      cases, "logical_xor", "r = a ^^ b;", {}, [](const auto& a, const auto& b) { return a ^ b; }, [](bool a, bool b) { return a != b; });
  add_by_component(
      cases, Types<B>(), Types<B>(), {"logical_not", "r = !a;"}, [](const auto& a) { return !a; }, [](bool a) { return !a; });
}

/// b ? x : y.
template <class T>
void add_selection(Cases& cases) {
  add_by_component(
      cases, Types<T>(), Types<Bool<1>, T, T>(), {"select", "r = a ? b : c;"},
      [](const auto& m, const auto& a, const auto& b) { return select(m, a, b); }, [](bool m, auto a, auto b) { return m ? a : b; });
}

// ---- conversions ---------------------------------------------------------------------------------------------------

template <int L>
void add_conversions(Cases& cases) {
  const auto glsl = [](const Type& t) { return "r = " + glsl_name(t) + "(a);"; };
  const auto unchanged = [](auto x) { return x; };
  const auto truncated = [](double x) { return static_cast<int64_t>(x); };
  const Bounds nearest{rounded(), rounded()};
  const Domain signed_range = magnitudes(-4, 30, {0.0f, 0.99999994f, -1.5f, 2147483520.0f, -2147483648.0f});
  const Domain unsigned_range = positive(-4, 31, {0.0f, 0.99999994f, 1.5f, 4294967040.0f, 2147483648.0f});
  add_by_component(
      cases, Types<Int<L>>(), Types<Float<L>>(), {"to_int", glsl(Int<L>::type), {signed_range}},
      []<class X>(const X& x) {
        if constexpr (L == 1) {
          return truncate_to_int(x);
        } else {
          return typename Int<L>::Value(x);
        }
      },
      truncated);
  add_by_component(
      cases, Types<Uint<L>>(), Types<Float<L>>(), {"to_uint", glsl(Uint<L>::type), {unsigned_range}},
      []<class X>(const X& x) {
        if constexpr (L == 1) {
          return truncate_to_uint(x);
        } else {
          return typename Uint<L>::Value(x);
        }
      },
      truncated);
  add_by_component(
      cases, Types<Float<L>>(), Types<Int<L>>(), {"to_float", glsl(Float<L>::type)}, [](const auto& i) { return to_real<Lanes>(i); },
      [](int64_t i) { return static_cast<double>(i); }, nearest);
  add_by_component(
      cases, Types<Float<L>>(), Types<Uint<L>>(), {"to_float", glsl(Float<L>::type)}, [](const auto& i) { return to_real<Lanes>(i); },
      [](uint64_t i) { return static_cast<double>(i); }, nearest);
  add_by_component(
      cases, Types<Uint<L>>(), Types<Int<L>>(), {"to_uint", glsl(Uint<L>::type)}, [](const auto& i) { return typename Uint<L>::Value(i); },
      unchanged);
  add_by_component(
      cases, Types<Int<L>>(), Types<Uint<L>>(), {"to_int", glsl(Int<L>::type)}, [](const auto& i) { return typename Int<L>::Value(i); },
      unchanged);
}

// ---- swizzles ------------------------------------------------------------------------------------------------------

/// The numbers of the components that a swizzle names.
std::vector<std::size_t> indices_of(const std::string& names) {
  std::vector<std::size_t> indices;
  for (const char letter : names) {
    for (const char* set : {"xyzw", "rgba", "stpq"}) {
      const std::size_t found = std::string(set).find(letter);
      if (found != std::string::npos) indices.push_back(found);
    }
  }
  return indices;
}

template <detail::ComponentNames names>
std::string text_of_names() {
  return std::string(names.letters, static_cast<std::size_t>(names.size()));
}

/// r = a.names.
template <detail::ComponentNames names, class V>
void add_read(Cases& cases) {
  const std::string text = text_of_names<names>();
  const std::vector<std::size_t> indices = indices_of(text);
  add_case(
      cases, Types<Typed<V::base, 1, names.size()>>(), Types<V>(), {"swizzle_" + text, "r = a." + text + ";"},
      [](const auto& v) { return swizzle<names>(v); },
      [=](const Operands& x) {
        std::vector<Expected> results;
        for (const std::size_t i : indices) results.push_back({x[0][i]});
        return results;
      });
}
/// r = a; r.names = b.
template <detail::ComponentNames names, class V>
void add_write(Cases& cases) {
  const std::string text = text_of_names<names>();
  const std::vector<std::size_t> indices = indices_of(text);
  add_case(
      cases, Types<V>(), Types<V, Typed<V::base, 1, names.size()>>(), {"assign_" + text, "r = a; r." + text + " = b;"},
      [](auto& r, const auto& a, const auto& b) {
        r = a;
        swizzle_ref<names>(r) = b;
      },
      [=](const Operands& x) {
        std::vector<Expected> results;
        for (const double a : x[0]) results.push_back({a});
        for (std::size_t k = 0; k < indices.size(); ++k) results[indices[k]].value = x[1][k];
        return results;
      });
}
/// r = a; r.names *= b.
template <detail::ComponentNames names, int L>
void add_scaled_write(Cases& cases) {
  const std::string text = text_of_names<names>();
  const std::vector<std::size_t> indices = indices_of(text);
  add_case(
      cases, Types<Float<L>>(), Types<Float<L>, Float<1>>(), {"scale_" + text, "r = a; r." + text + " *= b;", {moderate(), moderate()}},
      [](auto& r, const auto& a, const auto& b) {
        r = a;
        swizzle_ref<names>(r) *= b;
      },
      [=](const Operands& x) {
        std::vector<Expected> results;
        for (const double a : x[0]) results.push_back({a});
        for (const std::size_t i : indices) {
          const double value = x[0][i] * x[1][0], error = rounded()(value, {});
          results[i] = {value, error, error};
        }
        return results;
      });
}

template <Base base>
void add_swizzles(Cases& cases) {
  using V2 = Typed<base, 1, 2>;
  using V3 = Typed<base, 1, 3>;
  using V4 = Typed<base, 1, 4>;
  add_read<"x", V2>(cases), add_read<"g", V2>(cases), add_read<"yx", V2>(cases), add_read<"ss", V2>(cases);
  add_read<"yxy", V2>(cases), add_read<"ggrr", V2>(cases);
  add_read<"z", V3>(cases), add_read<"zx", V3>(cases), add_read<"bgr", V3>(cases), add_read<"tpt", V3>(cases);
  add_read<"xyz", V3>(cases), add_read<"zzyx", V3>(cases);
  add_read<"a", V4>(cases), add_read<"wz", V4>(cases), add_read<"qpt", V4>(cases), add_read<"xyz", V4>(cases);
  add_read<"abgr", V4>(cases), add_read<"wxyz", V4>(cases), add_read<"yyyy", V4>(cases), add_read<"rgba", V4>(cases);
  add_write<"y", V2>(cases), add_write<"yx", V2>(cases), add_write<"b", V3>(cases), add_write<"zx", V3>(cases);
  add_write<"pts", V3>(cases), add_write<"w", V4>(cases), add_write<"yw", V4>(cases), add_write<"agb", V4>(cases);
  add_write<"wzyx", V4>(cases);
}

}  // namespace

Cases relational_cases() {
  Cases cases;
  for_vectors([&]<int L>() {
    add_comparisons<Float<L>>(cases);
    add_comparisons<Int<L>>(cases);
    add_comparisons<Uint<L>>(cases);
    add_functions_of_booleans<L>(cases);
  });
  return cases;
}

Cases operator_cases() {
  Cases cases;
  for_lengths([&]<int L>() {
    const auto add_for_pairs = [&]<class F, class I, class U, class F2, class I2, class U2>(Types<F, I, U>, Types<F2, I2, U2>) {
      add_arithmetic<Float<L>, F, F2>(cases);
      add_integer_arithmetic<Int<L>, I, I2>(cases);
      add_integer_arithmetic<Uint<L>, U, U2>(cases);
    };
    const Types<Float<L>, Int<L>, Uint<L>> vectors;
    const Types<Float<1>, Int<1>, Uint<1>> scalars;
    add_for_pairs(vectors, vectors);
    if constexpr (L > 1) {
      add_for_pairs(vectors, scalars);
      add_for_pairs(scalars, vectors);
      add_shifts<Int<L>, Int<1>>(cases);
      add_shifts<Uint<L>, Uint<1>>(cases);
    }
    add_shifts<Int<L>, Int<L>>(cases);
    add_shifts<Uint<L>, Uint<L>>(cases);
    add_shifts<Int<L>, Uint<L>>(cases);
    add_shifts<Uint<L>, Int<L>>(cases);
    add_unary<Float<L>>(cases);
    add_unary<Int<L>>(cases);
    add_unary<Uint<L>>(cases);
    add_assignments<Float<L>>(cases);
    add_assignments<Int<L>>(cases);
    add_assignments<Uint<L>>(cases);
    add_equality<Float<L>>(cases);
    add_equality<Int<L>>(cases);
    add_equality<Uint<L>>(cases);
    if constexpr (L > 1) add_equality<Bool<L>>(cases);
    add_selection<Float<L>>(cases);
    add_selection<Int<L>>(cases);
    add_selection<Uint<L>>(cases);
    add_conversions<L>(cases);
  });
  for_matrices([&]<int C, int L>() { add_equality<Matrix<C, L>>(cases); });
  add_scalar_comparisons<Float<1>>(cases);
  add_scalar_comparisons<Int<1>>(cases);
  add_scalar_comparisons<Uint<1>>(cases);
  add_logic(cases);
  return cases;
}

Cases swizzle_cases() {
  Cases cases;
  add_swizzles<Base::real>(cases);
  add_swizzles<Base::integer>(cases);
  add_swizzles<Base::natural>(cases);
  add_swizzles<Base::boolean>(cases);
  add_scaled_write<"yx", 2>(cases);
  add_scaled_write<"zx", 3>(cases);
  add_scaled_write<"agb", 4>(cases);
  return cases;
}

}  // namespace halfspace::conformance::builtins
