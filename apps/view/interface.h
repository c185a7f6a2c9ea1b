// SPDX-License-Identifier: Apache-2.0
//
// The user interface that is drawn over a frame: panels, statistics, the list of keys, the picked pixel and messages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "view/frame_maker.h"
#include "view/imgui_pass.h"
#include "view/scene_panel.h"
#include "view/viewer.h"
#include "view/window_times.h"

struct SDL_Window;
union SDL_Event;
struct ImGuiContext;

namespace halfspace {

class Interface {
 public:
  /// scale: scale of text and panels. 1 means that text is 14 pixels high.
  Interface(SDL_Window* window, double scale);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Passes an event to the widgets.
  void handle(const SDL_Event& event);
  bool takes_keyboard() const;  ///< returns true if a text field has the focus
  bool takes_mouse() const;     ///< returns true if the mouse is over a panel

  /// Shows or hides help, panels or statistics.
  void toggle(Action action);

  /// What the window shows in addition to the panels.
  struct Contents {
    const FrameMaker& frames;
    const WindowTimes& times;
    const std::optional<PickedPixel>& picked;  ///< the picked pixel, if any
    bool show_message;
    std::string busy{};  ///< what the program is about to do, if that can take long
  };

  /// Draws the user interface over the frame, which must have the size of the window. Returns false if there was nothing to draw.
  bool draw(Viewer& viewer, const Contents& contents, Image<glm::u8vec4>& frame, const Workers& workers);

 private:
  void draw_statistics(const Viewer& viewer, const Contents& contents) const;
  void draw_help() const;

  struct Context {
    explicit Context(double scale);
    ~Context();
  };

  Context context_;
  double scale_;
  ImGuiPass pass_;
  ScenePanel panel_;
  bool shows_help_ = false, shows_panels_ = false, shows_statistics_ = false;
};

}  // namespace halfspace
