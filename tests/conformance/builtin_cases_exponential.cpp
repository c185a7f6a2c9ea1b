// SPDX-License-Identifier: Apache-2.0
//
// The angle, trigonometry and exponential functions (GLSL 4.60, sections 8.1 and 8.2). GLSL gives no precision for trigonometric functions;
// Mesa is compared within that of Vulkan (1.3, "Precision of GLSL.std.450 Instructions").
#include <numbers>

#include "conformance/builtin_calls.h"
#include "support/constants.h"

namespace halfspace::conformance::builtins {

namespace {

/// Vulkan's error of sin and cos, from −π to π.
constexpr double kSineError = 0x1p-11;
/// Vulkan's error of atan and atan2.
constexpr double kArcUlps = 4096.0;

double exponential_error(double x, double value) { return (3.0 + 2.0 * std::fabs(x)) * ulp_of(value); }
double logarithm_error(double x, double value) { return x >= 0.5 && x <= 2.0 ? 0x1p-21 : 3.0 * ulp_of(value); }

double sine_error(double, const std::vector<double>& x) { return std::fabs(x[0]) <= kPi ? kSineError : kUnbounded; }
double tangent_error(double value, const std::vector<double>& x) {
  const double cosine = std::fabs(std::cos(x[0])) - kSineError;  // at least
  if (std::fabs(x[0]) > kPi || cosine <= kSineError) return kUnbounded;
  return kSineError * (1.0 + std::fabs(value)) / cosine + 2.5 * ulp_of(value);
}
/// Vulkan derives asin and acos from the arc tangent of a quotient whose root cancels near ±1. Mesa's polynomial has an absolute error of
/// up to 1.9e-4 instead.
double arc_error(double value, const std::vector<double>& x) {
  const double cosine = std::max(std::sqrt(1.0 - x[0] * x[0]), 0x1p-12);
  return std::max(kArcUlps * ulp_of(value), 0x1p-12) + 2.0 * kRounding / cosine;
}

// The hyperbolic functions by their definitions with exp and log, within the errors of these and 2.5 ulp for each quotient.
double hyperbolic_error(double value, const std::vector<double>& x) {
  return exponential_error(x[0], std::cosh(x[0])) + 2.5 * ulp_of(value);
}
double hyperbolic_tangent_error(double value, const std::vector<double>& x) {
  return 2.0 * exponential_error(x[0], 1.0) + 2.5 * ulp_of(value);
}
double inverse_hyperbolic_sine_error(double value, const std::vector<double>&) { return 0x1p-20 + 3.0 * ulp_of(value); }
double inverse_hyperbolic_cosine_error(double value, const std::vector<double>& x) {
  const double root = std::max(std::sqrt(x[0] * x[0] - 1.0), 0x1p-12);
  return 0x1p-20 + 3.0 * ulp_of(value) + 2.0 * kRounding * x[0] / root;
}

double power_error(double value, const std::vector<double>& x) {
  if (x[0] == 0.0) return 0.0;
  const double logarithm = std::log2(x[0]), exponent = x[1] * logarithm;
  const double error = std::fabs(x[1]) * logarithm_error(x[0], logarithm) + ulp_of(exponent);
  return value * std::expm1(std::numbers::ln2 * error) + exponential_error(exponent, value);
}

/// A function of one argument, for scalars and vectors.
template <class F, class Reference>
void add_unary(Cases& cases, const char* name, const Domain& domain, F f, Reference reference, const Bounds& bounds) {
  for_lengths([&]<int L>() {
    add_by_component(cases, Types<Float<L>>(), Types<Float<L>>(), {name, "r = $(a);", {domain}}, f, reference, bounds);
  });
}

void add_trigonometric(Cases& cases) {
  const Domain angles =
      between(-2 * kPi, 2 * kPi, {0.0f, 1e4f, -1e4f, 100.0f, 3.14159265f, 1.57079633f, -1.57079633f, 0x1p-20f, 1e-30f, 0.78539816f});
  const Domain degrees_of_all_sizes = magnitudes(-10, 20, {0.0f, 90.0f, -180.0f, 360.0f, 1e30f});
  const Domain unit = between(-1, 1, {0.0f, 1.0f, -1.0f, 0.5f, -0.5f, 0x1p-20f, 0.99999994f});
  add_unary(
      cases, "radians", degrees_of_all_sizes, [](const auto& x) { return radians(x); }, [](double x) { return x * kPi / 180.0; },
      {ulps(0.63), ulps(2.0)});
  add_unary(
      cases, "degrees", degrees_of_all_sizes, [](const auto& x) { return degrees(x); }, [](double x) { return x * 180.0 / kPi; },
      {ulps(0.7), ulps(2.0)});
  add_unary(
      cases, "sin", angles, [](const auto& x) { return sin(x); }, [](double x) { return std::sin(x); }, {ulps(1.54), sine_error});
  add_unary(
      cases, "cos", angles, [](const auto& x) { return cos(x); }, [](double x) { return std::cos(x); }, {ulps(1.54), sine_error});
  add_unary(
      cases, "tan", angles, [](const auto& x) { return tan(x); }, [](double x) { return std::tan(x); }, {ulps(3.33), tangent_error});
  add_unary(
      cases, "asin", unit, [](const auto& x) { return asin(x); }, [](double x) { return std::asin(x); }, {ulps(2.37), arc_error});
  add_unary(
      cases, "acos", unit, [](const auto& x) { return acos(x); }, [](double x) { return std::acos(x); }, {ulps(1.13), arc_error});
  add_unary(
      cases, "atan", magnitudes(-20, 20, {0.0f, 1.0f, -1.0f, 1e30f}), [](const auto& x) { return atan(x); },
      [](double x) { return std::atan(x); }, {ulps(1.4), ulps(kArcUlps)});
  for_lengths([&]<int L>() {
    const Domain coordinates = magnitudes(-8, 8, {0.0f, 1.0f, -1.0f, 3.0f, -1e10f});
    add_by_component(
        cases, Types<Float<L>>(), Types<Float<L>, Float<L>>(),
        {"atan2", "r = atan(a, b);", {coordinates, coordinates}, where([](const std::vector<double>& x) {
           return x[0] != 0.0 || x[1] != 0.0;
         })},
        [](const auto& y, const auto& x) { return atan(y, x); }, [](double y, double x) { return std::atan2(y, x); },
        {ulps(1.5), ulps(kArcUlps)});
  });
}

void add_hyperbolic(Cases& cases) {
  const Domain middle = between(-10, 10, {0.0f, 1.0f, -1.0f, 80.0f, -80.0f, 0x1p-20f});
  add_unary(
      cases, "sinh", middle, [](const auto& x) { return sinh(x); }, [](double x) { return std::sinh(x); }, {ulps(1.62), hyperbolic_error});
  add_unary(
      cases, "cosh", middle, [](const auto& x) { return cosh(x); }, [](double x) { return std::cosh(x); }, {ulps(1.46), hyperbolic_error});
  add_unary(
      cases, "tanh", middle, [](const auto& x) { return tanh(x); }, [](double x) { return std::tanh(x); },
      {ulps(1.34), hyperbolic_tangent_error});
  add_unary(
      cases, "asinh", magnitudes(-20, 20, {0.0f, 1.0f, -1.0f}), [](const auto& x) { return asinh(x); },
      [](double x) { return std::asinh(x); }, {ulps(2.07), inverse_hyperbolic_sine_error});
  add_unary(
      cases, "acosh", between(1, 20, {1.0f, 1.0000001f, 2.0f, 1e10f}), [](const auto& x) { return acosh(x); },
      [](double x) { return std::acosh(x); }, {ulps(2.89), inverse_hyperbolic_cosine_error});
  add_unary(
      cases, "atanh", between(-1, 1, {0.0f, 0.5f, -0.5f, 0x1p-20f, 0.99999994f}), [](const auto& x) { return atanh(x); },
      [](double x) { return std::atanh(x); }, {ulps(2.52), inverse_hyperbolic_sine_error});
}

void add_powers(Cases& cases) {
  const Domain above_zero = positive(-126, 127, {1.0f, 2.0f, 0.5f, 0.99999994f, 1.0000001f, 10.0f, 0x1p-126f, 0x1p-149f, 3e38f});
  for_lengths([&]<int L>() {
    const auto defined = where([](const std::vector<double>& x) { return x[0] > 0.0 || x[1] > 0.0; });
    add_by_component(
        cases, Types<Float<L>>(), Types<Float<L>, Float<L>>(),
        {"pow",
         "r = pow(a, b);",
         {positive(-10, 10, {0.0f, 1.0f, 2.0f, 0.5f}), between(-10, 10, {0.0f, 1.0f, 0.5f, -2.0f, 20.0f})},
         defined},
        [](const auto& x, const auto& y) { return pow(x, y); }, [](double x, double y) { return std::pow(x, y); },
        {ulps(1.2), power_error});
  });
  const auto exponential = [](double value, const std::vector<double>& x) { return exponential_error(x[0], value); };
  const auto logarithm = [](double value, const std::vector<double>& x) { return logarithm_error(x[0], value); };
  add_unary(
      cases, "exp", between(-80, 80, {0.0f, 1.0f, -1.0f, 100.0f, -100.0f, 0x1p-20f}), [](const auto& x) { return exp(x); },
      [](double x) { return std::exp(x); }, {ulps(1.02), exponential});
  add_unary(
      cases, "exp2", between(-120, 120, {0.0f, 1.0f, -1.0f, 127.0f, 128.0f, -126.0f, -140.0f, 0.5f}), [](const auto& x) { return exp2(x); },
      [](double x) { return std::exp2(x); }, {ulps(0.96), exponential});
  add_unary(
      cases, "log", above_zero, [](const auto& x) { return log(x); }, [](double x) { return std::log(x); }, {ulps(0.9), logarithm});
  add_unary(
      cases, "log2", above_zero, [](const auto& x) { return log2(x); }, [](double x) { return std::log2(x); }, {ulps(1.04), logarithm});
  const Domain from_zero = positive(-126, 127, {0.0f, 1.0f, 2.0f, 0.5f, 0.99999994f, 1.0000001f, 0x1p-126f, 0x1p-149f, 3e38f});
  // GLSL derives sqrt from 1/inversesqrt: 2 and 2.5 ulp, of which the first may be doubled by a change of the exponent.
  add_unary(
      cases, "sqrt", from_zero, [](const auto& x) { return sqrt(x); }, [](double x) { return std::sqrt(x); }, {rounded(), ulps(6.5)});
  add_unary(
      cases, "inversesqrt", above_zero, [](const auto& x) { return inversesqrt(x); }, [](double x) { return 1.0 / std::sqrt(x); },
      {ulps(1.5), ulps(2.0)});
}

}  // namespace

Cases exponential_cases() {
  Cases cases;
  add_trigonometric(cases);
  add_hyperbolic(cases);
  add_powers(cases);
  return cases;
}

}  // namespace halfspace::conformance::builtins
