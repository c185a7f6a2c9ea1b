// SPDX-License-Identifier: Apache-2.0
//
// Tests a shader outside namespace halfspace without a using-directive: argument-dependent lookup finds the vector functions, and float and
// lanes return the same bits.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "halfspace/core/lane_pairs.h"
#include "halfspace/shading/shader_traits.h"

namespace visitor {

struct Glossy {
  glm::mat4 clip_from_object{1.0f};
  glm::mat3 world_from_object{1.0f};
  glm::vec3 light_ws{0.48f, 0.6f, 0.64f}, color{0.9f, 0.5f, 0.1f};

  template <class R>
  struct Attributes {
    halfspace::vec3<R> position, normal;
  };
  template <class R>
  struct Varyings {
    halfspace::vec3<R> normal_ws, to_eye_ws;
  };

  template <class R>
  halfspace::vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.normal_ws = normalize(world_from_object * in.normal);
    out.to_eye_ws = -(world_from_object * in.position);
    return clip_from_object * halfspace::vec4<R>(in.position, R(1));
  }

  template <class R>
  halfspace::Fragment<R> fragment(const Varyings<R>& in, const halfspace::Pixel<R>&) const {
    const halfspace::vec3<R> n = normalize(in.normal_ws), v = in.to_eye_ws / length(in.to_eye_ws);
    const halfspace::vec3<R> along = cross(n, light_ws), mirrored = reflect(-light_ws, n);
    const R gloss = dot(mirrored, v);
    const halfspace::vec3<R> lit = color * dot(n, light_ws) + along * length(along);
    return {halfspace::vec4<R>(mix(lit, glm::vec3(1.0f), gloss), gloss)};
  }
};
static_assert(halfspace::Shader<Glossy>);

template <class R>
std::array<R, 8> shade(const Glossy& shader, const std::array<R, 6>& attributes) {
  const auto& a = attributes;
  Glossy::Varyings<R> out;
  const halfspace::vec4<R> position = shader.vertex<R>({{a[0], a[1], a[2]}, {a[3], a[4], a[5]}}, out);
  const halfspace::vec4<R> color = shader.fragment<R>(out, halfspace::Pixel<R>{}).color;
  return {position.x, position.y, position.z, position.w, color.x, color.y, color.z, color.w};
}

template <class R>
void check_lanes() {
  constexpr int width = halfspace::kWidthOf<R>;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(-2.0f, 2.0f);
  Glossy shader;
  for (int k = 0; k < 4; ++k) shader.clip_from_object[k] = {number(random), number(random), number(random), number(random)};
  shader.world_from_object = glm::mat3(shader.clip_from_object);
  for (int round = 0; round < 200; ++round) {
    std::array<std::array<float, 6>, width> scalar;
    std::array<R, 6> attributes;
    for (std::size_t i = 0; i < width; ++i) {
      for (std::size_t k = 0; k < 6; ++k) set_lane(attributes[k], static_cast<int>(i), scalar[i][k] = number(random));
    }
    const std::array<R, 8> result = shade(shader, attributes);
    for (std::size_t i = 0; i < width; ++i) {
      const std::array<float, 8> expected = shade(shader, scalar[i]);
      for (std::size_t k = 0; k < 8; ++k) ASSERT_EQ(lane(result[k], static_cast<int>(i)), expected[k]) << "component " << k;
    }
  }
}

TEST(OwnNamespace, FloatAndLanesReturnTheSameBits) {
  check_lanes<halfspace::RealN<4>>();
  check_lanes<halfspace::RealN<8>>();
  check_lanes<halfspace::RealN<16>>();
  check_lanes<halfspace::FragmentReal>();
}

}  // namespace visitor
