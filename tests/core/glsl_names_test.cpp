// SPDX-License-Identifier: Apache-2.0
//
// Compares the table of functions in docs/reference/shading_language.md with the headers, and calls functions as a shader outside of the
// namespace does.
#include <math.h>    // NOLINT: declares the functions in the global namespace, also for float
#include <stdlib.h>  // NOLINT: the same for abs

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "core/glsl_lanes.h"

namespace using_directives {

using namespace std;
using namespace halfspace;

template <class R>
vec3<R> call_glsl(vec3<R> v, R x) {
  vec3<R> i;
  IntOf<R> e;
  const R scalars = trunc(x) + round(x) + ceil(x) + fract(x) + mod(x, R(2)) + mix(x, x, x) + step(x, x) + smoothstep(x, x + R(1), x) +
                    tan(x) + sinh(x) + cosh(x) + tanh(x) + asinh(x) + acosh(x + R(1)) + atanh(x) + distance(x, x) + ldexp(x, 2) +
                    frexp(x, e) + radians(x) + atan(x, x) + select(isnan(x) || isinf(x), R(1), R(0)) + inversesqrt(x) + sign(x) + length(x);
  return min(v, v) + max(v, v) + clamp(v, v, v) + min(v, x) + abs(v) + sin(v) + pow(v, v) + fma(v, v, v) + modf(v, i) + round(v) +
         vec3<R>(scalars) + vec3<R>(distance(v, v)) + mix(v, v, equal(v, v)) + inverse(mat3<R>(x)) * v + swizzle<"zyx">(v);
}

}  // namespace using_directives

namespace without_directives {

template <class R>
R call_glsl(const halfspace::vec3<R>& v, const halfspace::mat3<R>& m) {  // no using: all arguments are vectors and matrices
  const auto w = mod(abs(v), 1.5f) + fract(v) + smoothstep(0.0f, 1.0f, v) + clamp(v, 0.0f, 1.0f) + swizzle<"zzx">(v) + transpose(m) * v;
  return dot(w, mix(v, w, lessThan(v, w)));
}

}  // namespace without_directives

namespace halfspace {
namespace {

std::string text_of_file(const std::string& name) {
  std::ifstream in(name);
  EXPECT_TRUE(in) << name;
  return (std::stringstream() << in.rdbuf()).str();
}

TEST(GlslNames, TheReferenceListsFunctionsOfTheHeaders) {
  std::string headers;
  for (const char* name : {"lanes", "vec", "lane_math", "lane_hyperbolic", "glsl_common", "glsl_geometric", "glsl_integer", "glsl_matrix",
                           "glsl_packing", "glsl_relational", "glsl_trigonometric"}) {
    headers += text_of_file("src/core/" + std::string(name) + ".h");
  }
  const std::string page = text_of_file("docs/reference/shading_language.md");
  const std::string table = page.substr(page.find("## Functions"), page.find("## Absent") - page.find("## Functions"));
  const std::regex row("\n\\| `(\\w+)` \\| 8");
  int rows = 0;
  for (std::sregex_iterator it(table.begin(), table.end(), row), end; it != end; ++it, ++rows) {
    const std::string name = (*it)[1];
    const bool declared = name == "not" || std::regex_search(headers, std::regex("HS_INLINE [^;{}()=]*\\b" + name + "\\("));
    EXPECT_TRUE(declared) << name;
  }
  EXPECT_EQ(rows, 88);  // the table was found
}

TEST(GlslNames, CallsWithoutNamespaceAreNotAmbiguous) {
  // libm may round elementary functions differently: at most a few ulp of sums below 100.
  const auto of_float = using_directives::call_glsl(vec3<float>(0.25f, 0.5f, 0.75f), 0.5f);
  const auto of_lanes = using_directives::call_glsl(vec3<Real>(Real(0.25f), Real(0.5f), Real(0.75f)), Real(0.5f));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(of_float[i], lane(of_lanes[i], 0), 1e-4f);
  EXPECT_EQ(without_directives::call_glsl(vec3<float>(0.25f, 0.5f, 0.75f), mat3<float>(2.0f)),
            lane(without_directives::call_glsl(vec3<Real>(Real(0.25f), Real(0.5f), Real(0.75f)), mat3<Real>(Real(2.0f))), 0));
}

}  // namespace
}  // namespace halfspace
