// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/pose/animation.h"

#include <algorithm>
#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/model/pose/node_transform.h"

namespace halfspace::HS_LANES {

namespace {

// The angle between two quaternions is at most 90°. After this many halvings, the remaining angle α is at most 2.4e-5, and linear
// interpolation deviates from the arc by less than 0.02·α³ = 3e-16.
constexpr int kHalvings = 16;

glm::dquat weighted(const glm::dquat& a, double wa, const glm::dquat& b, double wb) {
  return {a.w * wa + b.w * wb, a.x * wa + b.x * wb, a.y * wa + b.y * wb, a.z * wa + b.z * wb};
}

glm::dquat quaternion_of(const std::vector<double>& v) { return unit_rotation({v[3], v[0], v[1], v[2]}); }

/// Accesses the values of a channel as vectors. For cubic keys, parts 0, 1 and 2 are the in-tangent, the value and the out-tangent.
struct Keys {
  const AnimationChannel& channel;

  std::vector<double> vector(std::size_t key, std::size_t part = 1) const {
    const auto width = static_cast<std::size_t>(channel.width);
    const std::size_t begin = (channel.interpolation == KeyInterpolation::cubic ? key * 3 + part : key) * width;
    return {channel.values.begin() + static_cast<std::ptrdiff_t>(begin),
            channel.values.begin() + static_cast<std::ptrdiff_t>(begin + width)};
  }
};

std::vector<double> linear(const AnimationChannel& channel, const Keys& keys, std::size_t key, double t) {
  std::vector<double> a = keys.vector(key);
  const std::vector<double> b = keys.vector(key + 1);
  if (channel.property == AnimatedProperty::rotation) {
    const glm::dquat q = shortest_rotation(quaternion_of(a), quaternion_of(b), t);
    return {q.x, q.y, q.z, q.w};
  }
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] * (1.0 - t) + b[i] * t;
  return a;
}

// A cubic Hermite spline.
std::vector<double> cubic(const Keys& keys, std::size_t key, double t, double seconds) {
  const std::vector<double> v0 = keys.vector(key), out0 = keys.vector(key, 2), in1 = keys.vector(key + 1, 0), v1 = keys.vector(key + 1);
  const double t2 = t * t, t3 = t2 * t;
  std::vector<double> value(v0.size());
  for (std::size_t i = 0; i < value.size(); ++i) {
    value[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * v0[i] + seconds * (t3 - 2.0 * t2 + t) * out0[i] + (3.0 * t2 - 2.0 * t3) * v1[i] +
               seconds * (t3 - t2) * in1[i];
  }
  return value;
}

}  // namespace

glm::dquat shortest_rotation(const glm::dquat& a, const glm::dquat& b, double t) {
  glm::dquat low = a, high = glm::dot(a, b) < 0.0 ? -b : b;
  for (int i = 0; i < kHalvings; ++i) {
    const glm::dquat middle = unit_rotation(weighted(low, 0.5, high, 0.5));
    t *= 2.0;
    if (t < 1.0) {
      high = middle;
    } else {
      low = middle;
      t -= 1.0;
    }
  }
  return unit_rotation(weighted(low, 1.0 - t, high, t));
}

std::vector<double> value_at(const AnimationChannel& channel, double time) {
  HS_CHECK(!channel.times.empty(), "animation: a channel has no keyframes; expected at least one");
  const Keys keys = {channel};
  const auto after = std::ranges::upper_bound(channel.times, time, {}, [](float x) { return static_cast<double>(x); });
  const auto key = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - channel.times.begin() - 1, 0));
  std::vector<double> value;
  if (after == channel.times.begin() || after == channel.times.end() || channel.interpolation == KeyInterpolation::step) {
    value = keys.vector(key);
  } else {
    const auto begin = static_cast<double>(channel.times[key]), end = static_cast<double>(channel.times[key + 1]);
    const double t = (time - begin) / (end - begin);
    value = channel.interpolation == KeyInterpolation::cubic ? cubic(keys, key, t, end - begin) : linear(channel, keys, key, t);
  }
  if (channel.property == AnimatedProperty::rotation) {
    const glm::dquat q = quaternion_of(value);
    value = {q.x, q.y, q.z, q.w};
  }
  return value;
}

void apply_animation(const ModelAnimation& animation, double time, std::span<ModelNode> nodes) {
  for (const AnimationChannel& channel : animation.channels) {
    const std::vector<double> v = value_at(channel, time);
    ModelNode& node = nodes[static_cast<std::size_t>(channel.node)];
    switch (channel.property) {
      case AnimatedProperty::translation: node.transform.translation = {v[0], v[1], v[2]}; break;
      case AnimatedProperty::rotation: node.transform.rotation = {v[3], v[0], v[1], v[2]}; break;
      case AnimatedProperty::scale: node.transform.scale = {v[0], v[1], v[2]}; break;
      case AnimatedProperty::weights:
        node.morph_weights.resize(v.size());
        std::ranges::transform(v, node.morph_weights.begin(), [](double x) { return static_cast<float>(x); });
        break;
      case AnimatedProperty::visibility: node.visible = v[0] != 0.0; break;
    }
  }
}

}  // namespace halfspace::HS_LANES
