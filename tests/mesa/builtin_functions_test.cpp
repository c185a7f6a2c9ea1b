// SPDX-License-Identifier: Apache-2.0
//
// Functions and operators by Mesa: the cases of tests/conformance/builtin_functions.h, in GLSL with the same arguments. A compute shader
// answers all calls of a case.
//
// HALFSPACE_MESA_PIXELS=1 prints the answers that differ.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include <epoxy/gl.h>

#include "conformance/builtin_functions.h"
#include "mesa/mesa_context.h"
#include "mesa/mesa_draw.h"
#include "support/long_tests.h"

namespace halfspace::test {
namespace builtin_functions {
namespace {

namespace builtins = conformance::builtins;
using builtins::Base;
using builtins::Case;
using builtins::Cases;
using builtins::Expected;
using builtins::Operands;
using builtins::Type;
using builtins::Words;

// ---- GLSL ----------------------------------------------------------------------------------------------------------

std::string component_in_glsl(const std::string& name, const Type& t, int k) {
  if (t.columns > 1) return name + "[" + std::to_string(k / t.rows) + "][" + std::to_string(k % t.rows) + "]";
  return t.rows > 1 ? name + "[" + std::to_string(k) + "]" : name;
}

/// Reads the arguments a, b, c and d, calls the function, and writes the results r and s.
std::string source_of(const Case& c) {
  constexpr std::array<const char*, 4> from_word{"uintBitsToFloat(", "int(", "uint(", "bool("};
  constexpr std::array<const char*, 4> to_word{"floatBitsToUint(", "uint(", "uint(", "uint("};
  std::string read, write;
  int word = 0;
  for (std::size_t p = 0; p < c.parameters.size(); ++p) {
    const Type& t = c.parameters[p];
    read += builtins::glsl_name(t) + " " + "abcd"[p] + " = " + builtins::glsl_name(t) + "(";
    for (int k = 0; k < builtins::words_of(t); ++k, ++word)
      read +=
          (k == 0 ? "" : ", ") + std::string(from_word[static_cast<std::size_t>(t.base)]) + "calls[base + " + std::to_string(word) + "])";
    read += ");\n";
  }
  word = 0;
  for (std::size_t p = 0; p < c.results.size(); ++p) {
    const Type& t = c.results[p];
    const std::string name(1, "rs"[p]);
    read += builtins::glsl_name(t) + " " + name + ";\n";
    for (int k = 0; k < builtins::words_of(t); ++k, ++word)
      write += "answers[base + " + std::to_string(word) + "] = " + to_word[static_cast<std::size_t>(t.base)] +
               component_in_glsl(name, t, k) + ");\n";
  }
  return "#version 450 core\nlayout(local_size_x = 64) in;\n"
         "layout(std430, binding = 0) readonly buffer Calls { uint calls[]; };\n"
         "layout(std430, binding = 1) writeonly buffer Answers { uint answers[]; };\n"
         "void main() {\nint base = " +
         std::to_string(builtins::kMaxWords) + " * int(gl_GlobalInvocationID.x);\n" + read + c.glsl + "\n" + write + "}\n";
}

// ---- calls ---------------------------------------------------------------------------------------------------------

class Caller {
 public:
  Caller() {
    glCreateBuffers(2, buffers_.data());
    for (GLuint i = 0; i < 2; ++i) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers_[i]);
  }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;
  ~Caller() { glDeleteBuffers(2, buffers_.data()); }

  std::vector<Words> answers(const Case& c, const std::vector<Words>& calls) {
    const auto bytes = static_cast<GLsizeiptr>(calls.size() * sizeof(Words));
    std::vector<Words> answers(calls.size());
    glNamedBufferData(buffers_[0], bytes, calls.data(), GL_STATIC_DRAW);
    glNamedBufferData(buffers_[1], bytes, answers.data(), GL_STATIC_READ);
    const std::string source = source_of(c);
    const char* const text = source.c_str();
    const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (!good) {
      std::array<char, 2000> log{};
      glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
      throw std::runtime_error(c.name + ": " + log.data() + source);
    }
    glUseProgram(program);
    glDispatchCompute(static_cast<GLuint>(calls.size()) / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffers_[1], 0, bytes, answers.data());
    glUseProgram(0);
    glDeleteProgram(program);
    expect_no_error();
    return answers;
  }

 private:
  std::array<GLuint, 2> buffers_{};
};

// ---- comparison ----------------------------------------------------------------------------------------------------

/// GLSL lets implementations replace subnormal arguments by 0.
bool has_subnormal(const Case& c, const Operands& operands) {
  for (std::size_t p = 0; p < operands.size(); ++p) {
    if (c.parameters[p].base != Base::real) continue;
    for (const double x : operands[p]) {
      if (x != 0.0 && std::fabs(x) < 0x1p-126) return true;
    }
  }
  return false;
}

struct Agreement {
  int cases = 0, compared = 0, differing = 0;
};

void compare_with_mesa(const Case& c, Caller& caller, Agreement& sum) {
  const std::vector<Words> calls = builtins::calls_of(c), ours = builtins::answers_of_lanes(c, calls), mesa = caller.answers(c, calls);
  int differing = 0, compared = 0;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const Operands operands = builtins::operands_of(c, calls[i]);
    if (has_subnormal(c, operands)) continue;
    const std::vector<Expected> expected = c.reference(operands);
    const std::vector<double> our_numbers = builtins::numbers_of(c.results, ours[i]), numbers = builtins::numbers_of(c.results, mesa[i]);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (std::isinf(expected[k].allowed_by_glsl)) continue;
      ++compared;
      if (std::fabs(numbers[k] - our_numbers[k]) <= expected[k].allowed + expected[k].allowed_by_glsl) continue;
      ++differing;
      if (std::getenv("HALFSPACE_MESA_PIXELS") != nullptr)
        std::printf("    %s(%s), component %zu: Halfspace %.9g, Mesa %.9g, reference %.9g, allowed %.3g\n", c.name.c_str(),
                    builtins::text_of(operands).c_str(), k, our_numbers[k], numbers[k], expected[k].value, expected[k].allowed_by_glsl);
    }
  }
  EXPECT_GT(compared, 0) << c.name;
  EXPECT_EQ(differing, 0) << c.name << ": of " << compared << " components";
  ++sum.cases;
  sum.compared += compared;
  sum.differing += differing;
}

struct Group {
  const char* name;
  Cases (*cases)();
};
constexpr Group kGroups[] = {{"Exponential", builtins::exponential_cases},  {"Common", builtins::common_cases},
                             {"Geometric", builtins::geometric_cases},      {"Integer", builtins::integer_cases},
                             {"Relational", builtins::relational_cases},    {"Operators", builtins::operator_cases},
                             {"Matrices", builtins::matrix_operator_cases}, {"Swizzles", builtins::swizzle_cases}};

void PrintTo(const Group& g, std::ostream* os) { *os << g.name; }

class MesaBuiltinFunctions : public MesaTest, public testing::WithParamInterface<Group> {};

TEST_P(MesaBuiltinFunctions, Agree) {
  Agreement sum;
  {
    Caller caller;
    const Cases cases = GetParam().cases();
    const std::size_t step = runs_long_tests() ? 1 : 7;  // compiling the shaders takes most of the time
    for (std::size_t i = 0; i < cases.size(); i += step) compare_with_mesa(cases[i], caller, sum);
  }
  EXPECT_GT(sum.cases, 0);
  std::printf("%d cases, %d components, %d differ\n", sum.cases, sum.compared, sum.differing);
}

INSTANTIATE_TEST_SUITE_P(Groups, MesaBuiltinFunctions, testing::ValuesIn(kGroups),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace builtin_functions
}  // namespace halfspace::test
