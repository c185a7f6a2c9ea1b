// SPDX-License-Identifier: Apache-2.0
#include "view/event_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "halfspace/core/check.h"

namespace halfspace {

namespace {

constexpr std::array<const char*, 10> kEvents{"key", "down", "up", "text", "mouse", "button", "wheel", "size", "drop", "close"};

void push_key(uint32_t type, std::string name, SDL_Window* window) {
  SDL_Event event{};
  event.type = type;
  event.key.windowID = SDL_GetWindowID(window);
  event.key.state = type == SDL_KEYDOWN ? SDL_PRESSED : SDL_RELEASED;
  if (name.starts_with("shift+")) {
    event.key.keysym.mod = KMOD_LSHIFT;
    name.erase(0, 6);
  }
  event.key.keysym.sym = SDL_GetKeyFromName(name.c_str());
  event.key.keysym.scancode = SDL_GetScancodeFromKey(event.key.keysym.sym);
  SDL_PushEvent(&event);
}

void push_text(const std::string& text, SDL_Window* window) {
  for (std::size_t i = 0; i < text.size(); i += SDL_TEXTINPUTEVENT_TEXT_SIZE - 1) {
    SDL_Event event{};
    event.type = SDL_TEXTINPUT;
    event.text.windowID = SDL_GetWindowID(window);
    text.copy(event.text.text, SDL_TEXTINPUTEVENT_TEXT_SIZE - 1, i);
    SDL_PushEvent(&event);
  }
}

void push_drop(const std::string& file) {
  SDL_Event event{};
  event.type = SDL_DROPFILE;
  event.drop.file = SDL_strdup(file.c_str());
  SDL_PushEvent(&event);
}

}  // namespace

EventScript::EventScript(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string() + ": cannot read; expected a file with events");
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    std::istringstream words(text);
    Line line{};
    if (!(words >> line.frame >> line.event) || std::ranges::find(kEvents, line.event) == kEvents.end())
      throw InputError(
          fmt::format("{}:{}: '{}' is not an event; expected FRAME EVENT ARGUMENTS, for example 3 key n", file.string(), number, text));
    std::getline(words >> std::ws, line.arguments);
    lines_.push_back(std::move(line));
  }
  std::ranges::stable_sort(lines_, {}, &Line::frame);
}

// Moves the real mouse, whose position widgets ask for. SDL pushes the event.
void EventScript::move_mouse(int x, int y, SDL_Window* window) {
  mouse_x_ = x;
  mouse_y_ = y;
  SDL_WarpMouseInWindow(window, x, y);
}

void EventScript::push_line(const Line& line, SDL_Window* window) {
  std::istringstream words(line.arguments);
  int a = 0, b = 0;
  std::string word;
  if (line.event == "key" || line.event == "down") push_key(SDL_KEYDOWN, line.arguments, window);
  if (line.event == "key" || line.event == "up") push_key(SDL_KEYUP, line.arguments, window);
  if (line.event == "text") push_text(line.arguments, window);
  if (line.event == "drop") push_drop(line.arguments);
  if (line.event == "mouse" && words >> a >> b) move_mouse(a, b, window);
  if (line.event == "size" && words >> a >> b) SDL_SetWindowSize(window, a, b);
  SDL_Event event{};
  if (line.event == "button" && words >> a >> word) {
    event.type = word == "down" ? SDL_MOUSEBUTTONDOWN : SDL_MOUSEBUTTONUP;
    event.button.windowID = SDL_GetWindowID(window);
    event.button.button = static_cast<uint8_t>(a);
    event.button.x = mouse_x_;
    event.button.y = mouse_y_;
  } else if (line.event == "wheel" && words >> a) {
    event.type = SDL_MOUSEWHEEL;
    event.wheel.windowID = SDL_GetWindowID(window);
    event.wheel.y = a;
    event.wheel.preciseY = static_cast<float>(a);
  } else if (line.event == "close") {
    event.type = SDL_QUIT;
  }
  if (event.type != 0) SDL_PushEvent(&event);
}

void EventScript::push(int frame, SDL_Window* window) {
  for (; next_ < lines_.size() && lines_[next_].frame <= frame; ++next_) push_line(lines_[next_], window);
}

}  // namespace halfspace
