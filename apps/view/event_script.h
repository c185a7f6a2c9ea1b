// SPDX-License-Identifier: Apache-2.0
//
// Scripts of input events, for tests and recordings.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <SDL.h>

namespace halfspace {

/// A script has lines of the form FRAME EVENT ARGUMENTS, sorted by frame:
///   3 key n            press and release a key, given by SDL's name; the prefix "shift+" holds shift
///   3 down w           press a key
///   9 up w             release a key
///   3 text abc         type text into the widget that has the focus
///   3 mouse 40 50      move the mouse to a pixel; widgets ignore this event, because they query the position of the real mouse
///   3 button 1 down    press or release (up) a mouse button: 1 left, 2 middle, 3 right
///   3 wheel -1         scroll the mouse wheel
///   3 size 640 360     resize the window
///   3 drop FILE        drop a file
///   3 close            close the window
class EventScript {
 public:
  EventScript() = default;
  /// Throws InputError.
  explicit EventScript(const std::filesystem::path& file);

  /// Pushes the events of a frame. Must be called with increasing frame numbers.
  void push(int frame, SDL_Window* window);

 private:
  struct Line {
    int frame;
    std::string event, arguments;
  };

  std::vector<Line> lines_;
  std::size_t next_ = 0;
  int mouse_x_ = 0, mouse_y_ = 0;

  void push_line(const Line& line, SDL_Window* window);
  void push_mouse(int x, int y, SDL_Window* window);
};

}  // namespace halfspace
