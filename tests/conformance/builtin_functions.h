// SPDX-License-Identifier: Apache-2.0
//
// Calls of the functions and operators of the shading language as plain data: the types, the arguments, the call in C++ and in GLSL, and
// the results in double precision with the errors that are allowed. Halfspace and Mesa (tests/mesa) answer the same cases.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace halfspace::conformance::builtins {

/// float, int, uint and bool of GLSL.
enum class Base : uint8_t { real, integer, natural, boolean };

/// A scalar has one row, a vector one column.
struct Type {
  Base base;
  int columns, rows;
};
inline int words_of(const Type& t) { return t.columns * t.rows; }
std::string glsl_name(const Type& t);

/// The arguments or the results of a call, one after the other, with a word per component. true is 1.
constexpr int kMaxWords = 33;
using Words = std::array<uint32_t, kMaxWords>;

/// The values that the components of an argument take: the special ones in half of the calls, and random ones.
struct Domain {
  uint32_t (*any)(std::mt19937& random, double low, double high) = nullptr;
  double low = 0.0, high = 0.0;
  const std::vector<uint32_t>* special = nullptr;  ///< exists until the end of the program
  bool unit = false;                               ///< vectors are divided by their length
};

/// The components of the arguments of a call, as numbers.
using Operands = std::vector<std::vector<double>>;

/// A component of a result.
struct Expected {
  double value = 0.0;
  double allowed = 0.0;          ///< largest error of Halfspace
  double allowed_by_glsl = 0.0;  ///< largest error of other implementations; infinite where GLSL has no bound
};

struct Case {
  std::string name;
  std::vector<Type> parameters, results;
  std::string glsl;  ///< statements that assign to r and s, from the arguments a, b, c and d
  std::vector<Domain> domains;
  std::function<bool(const Operands&)> defined;                ///< whether GLSL defines the result
  void (*call)(const Words* calls, Words* answers) = nullptr;  ///< for one call per lane
  std::function<std::vector<Expected>(const Operands&)> reference;
};
using Cases = std::vector<Case>;

/// The arguments of all calls of a case, which are the same in every run.
std::vector<Words> calls_of(const Case& c);
Operands operands_of(const Case& c, const Words& call);
/// The components of the results, as numbers.
std::vector<double> numbers_of(const std::vector<Type>& types, const Words& words);
std::vector<Words> answers_of_lanes(const Case& c, const std::vector<Words>& calls);

/// Compares the functions of Halfspace with the reference. Returns the difference; empty if there is none.
std::string check(const Case& c);
/// Whether a result may stand for the expected one. A number that is too large for a float is an infinity.
bool is_within(double seen, const Expected& expected, double allowed);
std::string text_of(const Operands& operands);

// The cases by sections of GLSL 4.60.
Cases exponential_cases();      ///< 8.1 and 8.2
Cases common_cases();           ///< 8.3
Cases geometric_cases();        ///< 8.5 and 8.6
Cases integer_cases();          ///< 8.4 and 8.8
Cases relational_cases();       ///< 8.7
Cases operator_cases();         ///< 5.4 and 5.9
Cases matrix_operator_cases();  ///< 5.10
Cases swizzle_cases();          ///< 5.5
Cases all_cases();

}  // namespace halfspace::conformance::builtins
