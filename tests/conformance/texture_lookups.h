// SPDX-License-Identifier: Apache-2.0
//
// Lookups in textures of every kind and format as plain data: the texture, the function, its state, and the points at which it is called.
// TextureView, a reference in double precision and Mesa (tests/mesa) answer the same cases.
#pragma once

#include <string>
#include <vector>

#include "halfspace/shading/texture/texture_memory.h"

namespace halfspace::conformance::lookups {

/// The functions of TextureView. size returns width, height and depth of a level.
enum class Function : uint8_t {
  sample,
  sample_level,
  sample_projected,
  sample_compare,
  sample_compare_level,
  gather,
  gather_compare,
  sample_integers,
  fetch,
  fetch_integers,
  query_lod,
  size
};

struct LookupCase {
  std::string name;
  TextureKind kind = TextureKind::two_d;
  TexelFormat format = TexelFormat::rgba32f;
  TextureSize size{};
  int levels = 1;
  Function function = Function::sample_level;
  Sampler sampler{};
  LookupOptions options{};
  int component = 0;  ///< of a gather
  std::array<Swizzle, 4> swizzle{Swizzle::red, Swizzle::green, Swizzle::blue, Swizzle::alpha};
  int base_level = 0, max_level = 1000;  ///< limited to the levels of the texture
  const char* not_by_mesa = nullptr;     ///< reason why Mesa's answer is not comparable
};
using LookupCases = std::vector<LookupCase>;

/// The arguments of one call. Components that a function does not use have no effect.
struct Point {
  glm::vec3 p{0.0f};  ///< coordinates or a direction, multiplied by the divisor if the function projects
  float layer = 0.0f;
  glm::vec3 dx{0.0f}, dy{0.0f};
  float lod = 0.0f;
  float reference = 0.0f;
  float divisor = 1.0f, divisor_dx = 0.0f, divisor_dy = 0.0f;
  glm::ivec3 texel{0};
  int level = 0;
};

/// Number of levels that the case reads.
int used_levels(const LookupCase& c);
/// Fills all levels with random texels: any codes of normalized, integer and depth formats, and floats of magnitudes 1/4 to 4.
void fill_with_noise(TextureMemory& memory);
/// Returns random points for a case. Their texels and levels do not depend on rounding: coordinates are at least 2^-13 texels from the
/// edges and centers of texels, and levels of detail that are derived at least 1/16 from a multiple of 1/2, where a filter selects another
/// level.
std::vector<Point> points_of(const LookupCase& c, TextureMemory& memory);

/// The color or the depth of a texel in double precision, from its bytes (OpenGL 4.6, sections 2.3.4 and 2.3.5), and its stencil.
glm::dvec4 decoded(TexelFormat format, const std::byte* texel);
double stencil_of(TexelFormat format, const std::byte* texel);

/// The answer of a call, and the range of the texels that contribute to each of its components.
struct Answer {
  glm::dvec4 value{0.0}, low{0.0}, high{0.0};
};
/// Answers in double precision, from the bytes of the texels (OpenGL 4.6, sections 2.3, 8.13 to 8.19 and 8.23).
std::vector<Answer> answers_in_double(const LookupCase& c, TextureMemory& memory, const std::vector<Point>& points);
/// Answers of TextureView. Integers are exact.
std::vector<glm::dvec4> answers_of_view(const LookupCase& c, const TextureMemory& memory, const std::vector<Point>& points);

/// Compares TextureView with the reference. Returns the difference; empty if there is none.
std::string check(const LookupCase& c);

// The groups.
LookupCases format_cases();
LookupCases kind_cases();
LookupCases wrap_cases();
LookupCases shadow_cases();
LookupCases gather_cases();
LookupCases function_cases();
LookupCases swizzle_cases();
LookupCases level_cases();
LookupCases multisample_cases();
/// A case of a random kind, format, size, function, sampler, swizzle and range of levels. It is the same on every machine.
LookupCase random_case(unsigned seed);

}  // namespace halfspace::conformance::lookups
