// SPDX-License-Identifier: Apache-2.0
#include "view/input.h"

#include <algorithm>
#include <cmath>

namespace halfspace {

namespace {

// Returns true for actions that the window handles instead of Viewer::press.
bool is_window_action(Action a) { return a >= Action::pick; }

}  // namespace

void Input::press(const SDL_KeyboardEvent& key, Viewer& viewer, const InputHandlers& handlers) {
  constexpr int kOtherModifiers = KMOD_CTRL | KMOD_ALT | KMOD_GUI;
  if (key.repeat != 0 || (key.keysym.mod & kOtherModifiers) != 0) return;
  const std::optional<Action> action = action_of(SDL_GetKeyName(key.keysym.sym));
  if (!action) return;
  if (is_movement(*action)) {
    held_.insert(*action);
    pressed_.insert(*action);
  } else if (is_window_action(*action)) {
    handlers.on_action(*action);
  } else {
    viewer.press(*action, (key.keysym.mod & KMOD_SHIFT) != 0);
  }
}

void Input::handle_mouse(const SDL_Event& event, bool taken) {
  if (event.type == SDL_MOUSEMOTION) {
    mouse_ = {event.motion.x, event.motion.y};
    const glm::ivec2 moved(event.motion.xrel, event.motion.yrel);
    if (drag_ == Drag::orbit) orbited_ += moved;
    if (drag_ == Drag::pan) panned_ += moved;
  } else if (event.type == SDL_MOUSEBUTTONUP) {
    drag_ = Drag::none;
  } else if (event.type == SDL_MOUSEBUTTONDOWN && !taken) {
    drag_ = event.button.button == SDL_BUTTON_LEFT ? Drag::orbit : Drag::pan;
  } else if (event.type == SDL_MOUSEWHEEL && !taken) {
    wheel_ += event.wheel.preciseY;
  }
}

void Input::handle(const SDL_Event& event, Viewer& viewer, bool keyboard_taken, bool mouse_taken, const InputHandlers& handlers) {
  switch (event.type) {
    case SDL_QUIT: return handlers.on_close();
    case SDL_DROPFILE:
      handlers.on_drop(event.drop.file);
      SDL_free(event.drop.file);
      return;
    case SDL_KEYDOWN:
      if (!keyboard_taken) press(event.key, viewer, handlers);
      return;
    case SDL_KEYUP:
      if (const std::optional<Action> action = action_of(SDL_GetKeyName(event.key.keysym.sym))) held_.erase(*action);
      return;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) held_.clear();
      return;
    default: return handle_mouse(event, mouse_taken);
  }
}

void Input::apply(Viewer& viewer, double seconds, int window_height) {
  constexpr double kFirstStep = 1.0 / 30.0;  // seconds; even the shortest press moves the camera
  constexpr double kDegreesPerHeight = 180.0, kZoomPerNotch = 1.15;
  constexpr int kFramesAfterWheel = 8;
  for (const Action a : pressed_) viewer.move(a, kFirstStep);
  for (const Action a : held_) {
    if (!pressed_.contains(a)) viewer.move(a, seconds);
  }
  pressed_.clear();
  const glm::dvec2 orbit = glm::dvec2(orbited_) / static_cast<double>(window_height);
  const glm::dvec2 pan = glm::dvec2(panned_) / static_cast<double>(window_height);
  if (orbited_ != glm::ivec2(0)) viewer.orbit(-orbit.x * kDegreesPerHeight, orbit.y * kDegreesPerHeight);
  if (panned_ != glm::ivec2(0)) viewer.pan(pan.x, pan.y);
  orbited_ = panned_ = {};
  wheel_frames_ = wheel_ != 0.0 ? kFramesAfterWheel : std::max(wheel_frames_ - 1, 0);
  if (wheel_ != 0.0) viewer.zoom(std::pow(kZoomPerNotch, wheel_));
  wheel_ = 0.0;
}

}  // namespace halfspace
