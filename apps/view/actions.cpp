// SPDX-License-Identifier: Apache-2.0
#include "view/actions.h"

#include <algorithm>
#include <array>

namespace halfspace {

namespace {

constexpr std::array kBindings{
    KeyBinding{"w", Action::forward, "move forward"},
    KeyBinding{"s", Action::backward, "move backward"},
    KeyBinding{"a", Action::left, "move to the left"},
    KeyBinding{"d", Action::right, "move to the right"},
    KeyBinding{"r", Action::up, "move up"},
    KeyBinding{"f", Action::down, "move down"},
    KeyBinding{"q", Action::turn_left, "turn to the left"},
    KeyBinding{"e", Action::turn_right, "turn to the right"},
    KeyBinding{"z", Action::pitch_up, "look up"},
    KeyBinding{"c", Action::pitch_down, "look down"},
    KeyBinding{"x", Action::reset_camera, "reset the camera; again: next camera"},
    KeyBinding{"0", Action::shade_none, "no lighting"},
    KeyBinding{"1", Action::shade_flat, "flat shading"},
    KeyBinding{"2", Action::shade_gouraud, "Gouraud shading"},
    KeyBinding{"3", Action::shade_phong, "Phong shading"},
    KeyBinding{"n", Action::cycle_normals, "relief: none, normal map, bump map"},
    KeyBinding{"t", Action::toggle_textures, "textures on and off"},
    KeyBinding{"y", Action::toggle_shadows, "shadows on and off"},
    KeyBinding{"v", Action::toggle_visibility, "hide and show objects (the picked one)"},
    KeyBinding{"space", Action::pause, "pause time"},
    KeyBinding{"[", Action::darker, "exposure down a quarter stop"},
    KeyBinding{"]", Action::brighter, "exposure up a quarter stop"},
    KeyBinding{"o", Action::next_overlay, "next overlay; with shift: previous"},
    KeyBinding{"p", Action::pick, "pick the pixel under the mouse; again: close"},
    KeyBinding{"f12", Action::save, "save picture and scene file"},
    KeyBinding{"tab", Action::toggle_panels, "panels with all keys of the scene"},
    KeyBinding{"i", Action::toggle_statistics, "times and statistics"},
    KeyBinding{"h", Action::toggle_help, "this list of keys"},
};
static_assert(kBindings.size() == kActions);

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::span<const KeyBinding> key_bindings() { return kBindings; }

std::optional<Action> action_of(std::string_view key) {
  const auto same = [](char a, char b) { return lower(a) == b; };
  for (const KeyBinding& b : kBindings) {
    if (std::ranges::equal(key, b.key, same)) return b.action;
  }
  return std::nullopt;
}

}  // namespace halfspace
