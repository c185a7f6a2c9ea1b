// SPDX-License-Identifier: Apache-2.0
#include "view/actions.h"

#include <algorithm>
#include <array>

namespace halfspace {

namespace {

constexpr std::array kBindings{
    KeyBinding{"w", Action::forward, "move forward"},
    KeyBinding{"s", Action::backward, "move backward"},
    KeyBinding{"a", Action::left, "move left"},
    KeyBinding{"d", Action::right, "move right"},
    KeyBinding{"r", Action::up, "move up"},
    KeyBinding{"f", Action::down, "move down"},
    KeyBinding{"q", Action::turn_left, "turn left"},
    KeyBinding{"e", Action::turn_right, "turn right"},
    KeyBinding{"z", Action::pitch_up, "look up"},
    KeyBinding{"c", Action::pitch_down, "look down"},
    KeyBinding{"x", Action::reset_camera, "reset the camera; press again: next camera"},
    KeyBinding{"0", Action::shade_none, "no lighting"},
    KeyBinding{"1", Action::shade_flat, "flat shading"},
    KeyBinding{"2", Action::shade_gouraud, "Gouraud shading"},
    KeyBinding{"3", Action::shade_phong, "Phong shading"},
    KeyBinding{"n", Action::cycle_normals, "switch relief: none, normal map, bump map"},
    KeyBinding{"t", Action::toggle_textures, "textures on or off"},
    KeyBinding{"y", Action::toggle_shadows, "shadows on or off"},
    KeyBinding{"v", Action::toggle_visibility, "hide or show all objects, or the object whose history is open (p)"},
    KeyBinding{"space", Action::pause, "pause or resume the animation"},
    KeyBinding{"[", Action::darker, "decrease the exposure by 1/4 stop"},
    KeyBinding{"]", Action::brighter, "increase the exposure by 1/4 stop"},
    KeyBinding{"o", Action::next_overlay, "next overlay; with shift: previous overlay"},
    KeyBinding{"p", Action::pick, "history of the pixel under the mouse; press again: close"},
    KeyBinding{"f12", Action::save, "save the picture and the scene"},
    KeyBinding{"tab", Action::toggle_panels, "panel with all scene keys"},
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
