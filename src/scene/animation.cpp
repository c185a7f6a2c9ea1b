// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/animation.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "halfspace/core/check.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/scene/object_keys.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace::HS_LANES {

namespace {

bool is_vector(const Key& key) { return key.type == KeyType::vector || key.type == KeyType::color; }

SinCosDouble phase_at(const AnimationDescription& a, double seconds) {
  const double turns = seconds / a.period + a.phase;
  return sincos_turns(turns - std::floor(turns));
}

Numbers wave_at(const AnimationDescription& a, const Limits& limits, double seconds) {
  const double cosine = phase_at(a, seconds).cos;
  Numbers value = a.mean;
  for (std::size_t k = 0; k < value.size(); ++k) value[k] = std::clamp(value[k] + a.swing[k] * cosine, limits.low, limits.high);
  return value;
}

Numbers orbit_at(const AnimationDescription& a, double seconds) {
  const auto [sine, cosine] = phase_at(a, seconds);
  const glm::dvec3 p = a.center + a.a * cosine + a.b * sine;
  return {p.x, p.y, p.z};
}

Numbers keyframes_at(const AnimationDescription& a, double seconds) {
  const double first = a.keys.front().first, last = a.keys.back().first;
  if (a.loop && last > first && seconds > last) {
    const double turns = (seconds - first) / (last - first);
    seconds = first + (turns - std::floor(turns)) * (last - first);
  }
  if (seconds <= first) return a.keys.front().second;
  if (seconds >= last) return a.keys.back().second;
  std::size_t i = 1;
  while (a.keys[i].first <= seconds) ++i;
  const auto& [t0, v0] = a.keys[i - 1];
  const auto& [t1, v1] = a.keys[i];
  double x = (seconds - t0) / (t1 - t0);
  if (a.easing == Easing::smooth) x = x * x * (3.0 - 2.0 * x);
  if (a.easing == Easing::step) x = 0.0;
  Numbers value(v0.size());
  for (std::size_t k = 0; k < value.size(); ++k) value[k] = v0[k] + x * (v1[k] - v0[k]);
  return value;
}

Numbers rate_at(const AnimationDescription& a, const Json& start, double seconds) {
  Numbers value = start.is_array() ? start.get<Numbers>() : Numbers{start.get<double>()};
  for (std::size_t k = 0; k < value.size(); ++k) value[k] += a.rate[k] * seconds;
  return value;
}

}  // namespace

void check_animation(SceneDescription& scene, const AnimationDescription& a, const std::string& path, const std::string& source) {
  if (a.target.empty()) throw InputError(source + ": " + path + ".target: missing; expected the path to a number or vector");
  const FoundKey found = find_key(scene, a.target, source + ": " + path + ".target");
  const Key& key = *found.field.key;
  for (const char* fixed : {"animations", "animation", "time"}) {
    if (found.words[0] != fixed) continue;
    throw InputError(source + ": " + path + ".target: " + a.target +
                     " cannot be animated; expected a key of an object, a material, a light, a camera or the background");
  }
  if (key.type != KeyType::number && !is_vector(key)) {
    throw InputError(source + ": " + path + ".target: " + a.target +
                     " is neither a number nor a vector; expected the path to a number or vector");
  }
  if (found.words[0] == "objects") {
    const std::string problem = lack_of_effect(*find_named(scene.objects, found.words[1]), found.words[2]);
    if (!problem.empty()) throw InputError(source + ": " + path + ".target: " + a.target + " " + problem);
  }
  const std::size_t size = is_vector(key) ? 3 : 1;
  const auto check_size = [&](const char* name, std::size_t got) {
    if (got != size) {
      throw InputError(source + ": " + path + "." + name + ": expected " + (size == 3 ? "[x, y, z]" : "one number") + ", as the value of " +
                       a.target + " requires");
    }
  };
  if (a.type == AnimationType::rate) check_size("rate", a.rate.size());
  if (a.type == AnimationType::wave) {
    check_size("mean", a.mean.size());
    check_size("swing", a.swing.size());
  }
  if (a.type == AnimationType::orbit && size != 3) {
    throw InputError(source + ": " + path + ".target: " + a.target +
                     " is a number, but an orbit animates a vector; expected the path to a vector");
  }
  if (a.type == AnimationType::keyframes && a.keys.empty())
    throw InputError(source + ": " + path + ".keys: empty; expected rows [seconds, value]");
  if (a.type == AnimationType::keyframes) check_size("keys", a.keys.front().second.size());
}

void animate(SceneDescription& scene, const AnimationDescription& a, const std::string& path, const std::string& source, double seconds) {
  const Field field = find_key(scene, a.target, source + ": " + path + ".target").field;
  Numbers value;
  switch (a.type) {
    case AnimationType::rate: value = rate_at(a, value_of(field), seconds); break;
    case AnimationType::wave: value = wave_at(a, field.key->limits, seconds); break;
    case AnimationType::orbit: value = orbit_at(a, seconds); break;
    case AnimationType::keyframes: value = keyframes_at(a, seconds); break;
  }
  read_value(field, value.size() == 1 ? Json(value[0]) : Json(value), a.target, {source + ": " + path, {}, {}});
}

}  // namespace halfspace::HS_LANES
