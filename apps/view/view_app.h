// SPDX-License-Identifier: Apache-2.0
//
// The frame loop of the program, with and without a window.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "view/event_script.h"
#include "view/frame_maker.h"
#include "view/input.h"
#include "view/interface.h"
#include "view/viewer.h"
#include "view/window.h"

namespace halfspace {

struct ViewOptions {
  std::string name;  ///< name of the scene, for the title and for saved files
  int width = 1280, height = 720;
  int threads = 1;
  double ui_scale = 1.0;
  std::optional<int> frames;             ///< number of frames of a timed run, in full quality at intervals of 1/30 s
  std::filesystem::path events, record;  ///< file of events and folder for frames; empty if not used
};

/// Times of a run of frames, in milliseconds per frame.
struct RunTimes {
  int frames = 0;
  double frame = 0.0, prepare = 0.0, draw = 0.0, interface = 0.0, present = 0.0;
};

/// Renders `frames` frames without a window.
RunTimes run_without_window(Viewer& viewer, const ViewOptions& options);

/// Shows the scene in a window until it is closed. Throws InputError if there is no display.
class ViewApp {
 public:
  ViewApp(Viewer viewer, ViewOptions options);

  RunTimes run();

 private:
  using Clock = std::chrono::steady_clock;

  void open_dropped(const std::string& file);
  void handle_action(Action action);
  void handle_events();
  void show_frame();
  void show_busy(const std::string& text);
  void present(const std::string& busy);
  bool update_scene_frame(const glm::ivec2& size);
  void render_scene(const FrameQuality& quality, bool moving);
  void update_history(bool moving);
  void add_times(RunTimes& sum) const;
  void pick();
  void save();
  double advance();
  void wait_for_change();
  bool is_timed() const { return options_.frames.has_value(); }

  ViewOptions options_;
  Workers workers_;
  Viewer viewer_;
  FrameMaker frames_;
  Window window_;
  Interface interface_;
  EventScript script_;
  Input input_;
  CoarseControl coarse_;

  /// The state that determines the picture of the scene.
  struct Shown {
    int revision;
    double seconds;
    Overlay overlay;
    glm::ivec2 size;
    FrameQuality quality;
    friend bool operator==(const Shown&, const Shown&) = default;
  };
  std::optional<Shown> shown_;  // state of scene_frame_; nullopt: the next frame must be rendered
  Image<glm::u8vec4> scene_frame_, frame_;
  std::optional<PickedPixel> picked_;
  WindowTimes times_;
  std::string last_message_;
  Clock::time_point message_time_, frame_time_;
  int frame_number_ = 0;
  bool closed_ = false;
};

}  // namespace halfspace
