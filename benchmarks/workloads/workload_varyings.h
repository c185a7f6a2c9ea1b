// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tuple>

#include "halfspace/shading/contract.h"

namespace halfspace {

/// Interpolates N float varyings, and draws 1/2 plus their mean as gray. The varyings are N/4 vectors; vector i is (x, y, z, x) of the
/// position, divided by i + 1. N must be a multiple of 4 and at most 32.
template <int N>
struct VaryingsShader {
  glm::mat4 clip_from_world;

  template <class R>
  struct Attributes {
    vec3<R> position_ws;
  };
  template <class R>
  struct Varyings {
    [[no_unique_address]] MemberIf<(N > 0), vec4<R>, 0> v0;
    [[no_unique_address]] MemberIf<(N > 4), vec4<R>, 1> v1;
    [[no_unique_address]] MemberIf<(N > 8), vec4<R>, 2> v2;
    [[no_unique_address]] MemberIf<(N > 12), vec4<R>, 3> v3;
    [[no_unique_address]] MemberIf<(N > 16), vec4<R>, 4> v4;
    [[no_unique_address]] MemberIf<(N > 20), vec4<R>, 5> v5;
    [[no_unique_address]] MemberIf<(N > 24), vec4<R>, 6> v6;
    [[no_unique_address]] MemberIf<(N > 28), vec4<R>, 7> v7;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    float divisor = 0.0f;
    std::apply([&](auto&... v) { (put(in.position_ws, divisor += 1.0f, v), ...); }, tie_fields(out));
    return clip_from_world * vec4<R>(in.position_ws, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    R sum(0.0f);
    std::apply([&](const auto&... v) { (add(v, sum), ...); }, tie_fields(in));
    return {vec4<R>(vec3<R>(R(0.5f) + sum * R(1.0f / (N > 0 ? N : 1))), R(1))};
  }

 private:
  template <class R>
  HS_INLINE static void put(const vec3<R>& p, float divisor, vec4<R>& to) {
    to = vec4<R>(p, p.x) * R(1.0f / divisor);
  }
  template <class R, int tag>
  HS_INLINE static void put(const vec3<R>&, float, Absent<tag>&) {}
  template <class R>
  HS_INLINE static void add(const vec4<R>& v, R& sum) {
    sum += (v.x + v.y) + (v.z + v.w);
  }
  template <class R, int tag>
  HS_INLINE static void add(const Absent<tag>&, R&) {}
};

}  // namespace halfspace
