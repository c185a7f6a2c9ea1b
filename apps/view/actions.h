// SPDX-License-Identifier: Apache-2.0
//
// The keys of halfspace-view and their actions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace halfspace {

enum class Action : uint8_t {
  forward,
  left,
  backward,
  right,
  up,
  down,
  turn_left,
  turn_right,
  pitch_up,
  pitch_down,
  reset_camera,
  shade_none,
  shade_flat,
  shade_gouraud,
  shade_phong,
  cycle_normals,
  toggle_textures,
  toggle_shadows,
  toggle_visibility,
  pause,
  darker,
  brighter,
  next_overlay,
  pick,
  save,
  toggle_help,
  toggle_panels,
  toggle_statistics
};
inline constexpr std::size_t kActions = 28;

/// Returns true if the action moves the camera as long as its key is held.
constexpr bool is_movement(Action a) { return a <= Action::pitch_down; }

struct KeyBinding {
  std::string_view key;  ///< SDL's name for the key, in lower case
  Action action;
  std::string_view help;
};

/// Returns all keys, in the order of the help text.
std::span<const KeyBinding> key_bindings();

/// Returns the action of a key, or nullopt if it has none. `key` is SDL's name for the key, in upper or lower case.
std::optional<Action> action_of(std::string_view key);

}  // namespace halfspace
