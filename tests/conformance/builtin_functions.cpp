// SPDX-License-Identifier: Apache-2.0
#include "conformance/builtin_functions.h"

#include <bit>
#include <cmath>
#include <deque>
#include <sstream>
#include <stdexcept>

#include "conformance/builtin_calls.h"
#include "support/constants.h"

namespace halfspace::conformance::builtins {

std::string glsl_name(const Type& t) {
  constexpr std::array<const char*, 4> scalars{"float", "int", "uint", "bool"}, prefixes{"", "i", "u", "b"};
  const auto base = static_cast<std::size_t>(t.base);
  if (t.columns > 1) return "mat" + std::to_string(t.columns) + (t.columns == t.rows ? "" : "x" + std::to_string(t.rows));
  return t.rows == 1 ? scalars[base] : std::string(prefixes[base]) + "vec" + std::to_string(t.rows);
}

// ---- domains -------------------------------------------------------------------------------------------------------

namespace {

/// Domains are made once per case, and refer to lists that are kept.
const std::vector<uint32_t>* kept(std::vector<uint32_t> words) {
  static std::deque<std::vector<uint32_t>> lists;
  return &lists.emplace_back(std::move(words));
}
const std::vector<uint32_t>* kept(std::initializer_list<float> numbers) {
  std::vector<uint32_t> words;
  for (const float x : numbers) words.push_back(word_of(x));
  return kept(std::move(words));
}
Domain with_more(Domain d, std::initializer_list<float> numbers) {
  std::vector<uint32_t> words = *d.special;
  for (const float x : numbers) words.push_back(word_of(x));
  d.special = kept(std::move(words));
  return d;
}

double fraction_of(std::mt19937& random) { return static_cast<double>(static_cast<uint32_t>(random())) * 0x1p-32; }
uint32_t any_between(std::mt19937& random, double low, double high) {
  return word_of(static_cast<float>(low + (high - low) * fraction_of(random)));
}
uint32_t any_positive(std::mt19937& random, double low, double high) {
  return word_of(static_cast<float>(std::exp2(low + (high - low) * fraction_of(random))));
}
uint32_t any_magnitude(std::mt19937& random, double low, double high) {
  const uint32_t size = any_positive(random, low, high);
  return random() % 2 == 0 ? size : size | 0x80000000u;
}
uint32_t any_integer(std::mt19937& random, double, double) {
  const auto word = static_cast<uint32_t>(random());
  return static_cast<uint32_t>(static_cast<int32_t>(word) >> (random() % 32));
}
uint32_t any_integer_between(std::mt19937& random, double low, double high) {
  return static_cast<uint32_t>(low) + static_cast<uint32_t>(random()) % static_cast<uint32_t>(high - low + 1.0);
}
uint32_t any_real_bit(std::mt19937& random, double, double) { return random() % 2 == 0 ? 0 : word_of(1.0f); }

}  // namespace

Domain between(double low, double high, std::initializer_list<float> special) { return {any_between, low, high, kept(special)}; }
Domain magnitudes(int low, int high, std::initializer_list<float> special) {
  return {any_magnitude, static_cast<double>(low), static_cast<double>(high), kept(special)};
}
Domain positive(int low, int high, std::initializer_list<float> special) {
  return {any_positive, static_cast<double>(low), static_cast<double>(high), kept(special)};
}
Domain numbers() {
  static const Domain domain =
      magnitudes(-20, 26, {0.0f,        -0.0f,      0.5f,       -0.5f,        1.0f,  -1.0f,  1.5f,      -1.5f,     2.5f,       -2.5f,
                           0.49999997f, 8388607.5f, 8388609.0f, -16777216.0f, 1e30f, -3e38f, 0x1p-126f, 0x1p-149f, -0x1p-130f, 255.0f});
  return domain;
}
Domain numbers_and_infinities() {
  static const Domain domain = with_more(numbers(), {kInf, -kInf});
  return domain;
}
Domain numbers_infinities_and_nan() {
  static const Domain domain = with_more(numbers_and_infinities(), {kNaN});
  return domain;
}
Domain moderate() {
  static const Domain domain = magnitudes(-4, 4, {1.0f, -1.0f, 0.5f, 3.0f, -2.0f, 0.25f, -0.75f});
  return domain;
}
Domain unit_vectors() {
  Domain d = magnitudes(-2, 0);
  d.unit = true;
  return d;
}
Domain integers() {
  static const Domain domain{
      any_integer, 0.0, 0.0,
      kept(std::vector<uint32_t>{0, 1, ~0u, 2, 7, 0xfffffff9, 31, 32, 100, 65535, 65536, 0x7fffffff, 0x80000000, 0xaaaaaaaa, 0xfffffffe})};
  return domain;
}
Domain integers_between(int low, int high) {
  return {any_integer_between, static_cast<double>(low), static_cast<double>(high),
          kept(std::vector<uint32_t>{static_cast<uint32_t>(low), static_cast<uint32_t>(high)})};
}
Domain packed_halves() {
  return {any_integer, 0.0, 0.0, kept(std::vector<uint32_t>{0, 0x3c00bc00, 0x00010400, 0x7c00fc00, 0x83ff7bff, 0x7e01ff00})};
}
Domain booleans() { return integers_between(0, 1); }
Domain real_zero_or_one() { return {any_real_bit, 0.0, 0.0, kept(std::vector<uint32_t>())}; }
Domain words_of_floats() { return magnitudes(-126, 127, {0.0f, 1.0f, -2.0f, 0x1p-126f}); }

// ---- cases ---------------------------------------------------------------------------------------------------------

double limit_for_glsl(double allowed, double value) {
  if (!std::isfinite(value) || std::fabs(value) >= kOverflow) return kUnbounded;
  return std::fabs(value) < 0x1p-125 ? allowed + 0x1p-126 : allowed;
}

namespace {

std::size_t longest(const Operands& operands) {
  std::size_t count = 0;
  for (const std::vector<double>& operand : operands) count = std::max(count, operand.size());
  return count;
}
/// Component i of all operands. A scalar stands for all components.
std::vector<double> components_of(const Operands& operands, std::size_t i) {
  std::vector<double> x;
  for (const std::vector<double>& operand : operands) x.push_back(operand.size() == 1 ? operand[0] : operand[i]);
  return x;
}

std::vector<Expected> expected_by_component(std::span<const Type> types, const Operands& operands, ComponentFunction reference,
                                            const Bounds& bounds) {
  std::vector<Expected> results;
  for (std::size_t result = 0; result < types.size(); ++result) {
    for (int i = 0; i < words_of(types[result]); ++i) {
      const std::vector<double> x = components_of(operands, static_cast<std::size_t>(i));
      std::array<double, 2> values{};
      reference(x.data(), values.data());
      const double value = values[result], allowed = bounds.glsl(value, x);
      results.push_back({value, bounds.ours(value, x), types[result].base == Base::real ? limit_for_glsl(allowed, value) : allowed});
    }
  }
  return results;
}

/// The name of the function followed by the types of its parameters.
std::string name_of(std::string_view function, const std::vector<Type>& parameters) {
  std::string name = std::string(function) + "_" + glsl_name(parameters[0]);
  bool same = true;
  for (const Type& t : parameters) same &= glsl_name(t) == glsl_name(parameters[0]);
  for (std::size_t p = 1; p < parameters.size() && !same; ++p) name += "_" + glsl_name(parameters[p]);
  return name;
}
std::string glsl_of(const Description& d) {
  std::string glsl(d.glsl);
  if (const std::size_t place = glsl.find('$'); place != std::string::npos) glsl.replace(place, 1, d.name);
  return glsl;
}

Domain all_values(const Type& t) {
  switch (t.base) {
    case Base::real: return t.columns > 1 ? moderate() : numbers();
    case Base::boolean: return booleans();
    default: return integers();
  }
}

}  // namespace

bool Condition::operator()(const Operands& operands) const {
  if (of_all != nullptr) return of_all(operands);
  for (std::size_t i = 0; of_component != nullptr && i < longest(operands); ++i) {
    if (!of_component(components_of(operands, i))) return false;
  }
  return true;
}

void add(Cases& cases, const Signature& signature, const Description& d, LaneFunction call,
         std::function<std::vector<Expected>(const Operands&)> reference) {
  std::vector<Type> results(signature.results.begin(), signature.results.end());
  std::vector<Type> parameters(signature.parameters.begin(), signature.parameters.end());
  std::vector<Domain> domains;
  for (std::size_t p = 0; p < parameters.size(); ++p)
    domains.push_back(d.domains[0].any == nullptr ? all_values(parameters[p]) : d.domains[p]);
  std::string name = name_of(d.name, parameters);
  cases.push_back(
      {std::move(name), std::move(parameters), std::move(results), glsl_of(d), std::move(domains), d.defined, call, std::move(reference)});
}
void add(Cases& cases, const Signature& signature, const Description& d, LaneFunction call, ComponentFunction reference,
         const Bounds& bounds) {
  add(cases, signature, d, call, [results = signature.results, reference, bounds](const Operands& operands) {
    return expected_by_component(results, operands, reference, bounds);
  });
}

// ---- calls ---------------------------------------------------------------------------------------------------------

namespace {

double number_of(Base base, uint32_t word) {
  switch (base) {
    case Base::real: return static_cast<double>(std::bit_cast<float>(word));
    case Base::integer: return static_cast<double>(static_cast<int32_t>(word));
    default: return static_cast<double>(word);
  }
}

void divide_by_length(uint32_t* words, int count) {
  double squares = 0.0;
  for (int k = 0; k < count; ++k) squares += std::pow(number_of(Base::real, words[k]), 2);
  for (int k = 0; k < count; ++k)
    words[k] = std::bit_cast<uint32_t>(static_cast<float>(number_of(Base::real, words[k]) / std::sqrt(squares)));
}

// Special values take turns, in another order for each parameter.
Words arguments_of(const Case& c, int call, bool special, std::mt19937& random) {
  Words words{};
  std::size_t first = 0;
  for (std::size_t p = 0; p < c.parameters.size(); ++p) {
    const Domain& domain = c.domains[p];
    const auto count = static_cast<std::size_t>(words_of(c.parameters[p]));
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t turn = static_cast<std::size_t>(call / 2) * (2 * p + 1) + k;
      words[first + k] = special && !domain.special->empty() ? (*domain.special)[turn % domain.special->size()]
                                                             : domain.any(random, domain.low, domain.high);
    }
    if (domain.unit) divide_by_length(&words[first], static_cast<int>(count));
    first += count;
  }
  return words;
}

}  // namespace

std::vector<Words> calls_of(const Case& c) {
  constexpr int kAttempts = 100000;
  std::mt19937 random(1);
  std::vector<Words> calls;
  for (int call = 0; call < kCalls; ++call) {
    int attempt = 0;
    Words words = arguments_of(c, call, call % 2 == 0, random);
    while (!c.defined(operands_of(c, words))) {
      if (++attempt == kAttempts) throw std::runtime_error(c.name + ": no arguments with a result");
      words = arguments_of(c, call, false, random);
    }
    calls.push_back(words);
  }
  return calls;
}

std::vector<double> numbers_of(const std::vector<Type>& types, const Words& words) {
  std::vector<double> numbers;
  for (const Type& t : types) {
    for (int k = 0; k < words_of(t); ++k) numbers.push_back(number_of(t.base, words[numbers.size()]));
  }
  return numbers;
}

Operands operands_of(const Case& c, const Words& call) {
  const std::vector<double> numbers = numbers_of(c.parameters, call);
  Operands operands;
  auto next = numbers.begin();
  for (const Type& t : c.parameters) {
    operands.emplace_back(next, next + words_of(t));
    next += words_of(t);
  }
  return operands;
}

std::vector<Words> answers_of_lanes(const Case& c, const std::vector<Words>& calls) {
  std::vector<Words> answers(calls.size());
  for (std::size_t first = 0; first < calls.size(); first += kWidthOf<Lanes>) c.call(&calls[first], &answers[first]);
  return answers;
}

bool is_within(double seen, const Expected& expected, double allowed) {
  if (std::isnan(expected.value)) return std::isnan(seen);
  if (std::fabs(expected.value) >= kOverflow) return std::isinf(seen) && (seen > 0) == (expected.value > 0);
  return std::fabs(seen - expected.value) <= allowed;
}

std::string text_of(const Operands& operands) {
  std::ostringstream text;
  text.precision(9);
  for (std::size_t p = 0; p < operands.size(); ++p) {
    text << (p == 0 ? "" : ", ");
    for (std::size_t k = 0; k < operands[p].size(); ++k) text << (k == 0 ? "" : " ") << operands[p][k];
  }
  return text.str();
}

std::string check(const Case& c) {
  const std::vector<Words> calls = calls_of(c), answers = answers_of_lanes(c, calls);
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const Operands operands = operands_of(c, calls[i]);
    const std::vector<Expected> expected = c.reference(operands);
    const std::vector<double> seen = numbers_of(c.results, answers[i]);
    if (seen.size() != expected.size()) throw std::runtime_error(c.name + ": the reference has another number of components");
    for (std::size_t k = 0; k < seen.size(); ++k) {
      if (is_within(seen[k], expected[k], expected[k].allowed)) continue;
      std::ostringstream wrong;
      wrong.precision(9);
      wrong << "component " << k << " is " << seen[k] << ", expected " << expected[k].value << " within " << expected[k].allowed
            << "; arguments " << text_of(operands);
      return wrong.str();
    }
  }
  return "";
}

Cases all_cases() {
  Cases all;
  for (Cases (*const group)() : {exponential_cases, common_cases, geometric_cases, integer_cases, relational_cases, operator_cases,
                                 matrix_operator_cases, swizzle_cases}) {
    Cases cases = group();
    all.insert(all.end(), std::make_move_iterator(cases.begin()), std::make_move_iterator(cases.end()));
  }
  return all;
}

}  // namespace halfspace::conformance::builtins
