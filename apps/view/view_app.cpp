// SPDX-License-Identifier: Apache-2.0
#include "view/view_app.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "halfspace/core/check.h"
#include "halfspace/image/image_io.h"
#include "view/save_view.h"

namespace halfspace {

namespace {

constexpr double kTimedStep = 1.0 / 30.0;  // seconds between frames of a timed run

double milliseconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double, std::milli>(d).count(); }

RunTimes mean_of(RunTimes sum, double total_ms) {
  const double n = std::max(sum.frames, 1);
  return {sum.frames, total_ms / n, sum.prepare / n, sum.draw / n, sum.interface / n, sum.present / n};
}

}  // namespace

RunTimes run_without_window(Viewer& viewer, const ViewOptions& options) {
  const Workers workers(options.threads);
  FrameMaker maker(workers, {});
  maker.open(viewer.opened());
  Image<glm::u8vec4> frame(options.width, options.height);
  maker.render(viewer.description(), {}, Overlay::none, frame);  // creates the maps
  RunTimes sum;
  const auto start = std::chrono::steady_clock::now();
  for (; sum.frames < options.frames.value_or(0); ++sum.frames) {
    viewer.advance(kTimedStep);
    maker.render(viewer.description(), {}, Overlay::none, frame);
    sum.prepare += maker.times().prepare_ms;
    sum.draw += maker.times().draw_ms;
  }
  return mean_of(sum, milliseconds(std::chrono::steady_clock::now() - start));
}

ViewApp::ViewApp(Viewer viewer, ViewOptions options)
    : options_(std::move(options)),
      workers_(options_.threads),
      viewer_(std::move(viewer)),
      frames_(workers_, [this](const std::string& warning) { viewer_.set_message(warning); }),
      window_("halfspace-view: " + options_.name, options_.width, options_.height),
      interface_(window_.handle(), options_.ui_scale),
      script_(options_.events.empty() ? EventScript() : EventScript(options_.events)),
      message_time_(Clock::now()),
      frame_time_(Clock::now()) {
  frames_.open(viewer_.opened());
  viewer_.set_message("press h for the list of keys");
}

void ViewApp::open_dropped(const std::string& file) {
  show_busy("opening " + std::filesystem::path(file).filename().string());
  try {
    ModelView view;
    view.aspect = static_cast<double>(window_.size().x) / window_.size().y;
    Viewer opened(open_scene_or_model(file, view), 0.0);
    opened.description();
    viewer_ = std::move(opened);
    options_.name = std::filesystem::path(file).stem().string();
    window_.set_title("halfspace-view: " + options_.name);
    frames_.open(viewer_.opened());
    shown_.reset();
    picked_.reset();
    viewer_.set_message("opened " + file);
  } catch (const InputError& e) {
    viewer_.set_message(e.what());
  }
}

void ViewApp::pick() {
  if (picked_) {
    picked_.reset();
    viewer_.clear_picked_object();
    return;
  }
  picked_.emplace();
  shown_.reset();
  picked_->pixel = input_.mouse();
}

void ViewApp::save() {
  show_busy("saving the picture");
  try {
    const ViewFiles files =
        save_view(viewer_.scene(), viewer_.seconds(), options_.name, window_.size().x, window_.size().y, options_.threads, ".");
    viewer_.set_message(fmt::format("saved {} and {}", files.picture.filename().string(), files.scene.filename().string()));
  } catch (const std::runtime_error& e) {
    viewer_.set_message(e.what());
  }
}

void ViewApp::handle_action(Action action) {
  if (action == Action::pick) return pick();
  if (action == Action::save) return save();
  interface_.toggle(action);
}

void ViewApp::handle_events() {
  const InputHandlers handlers{.on_action = [this](Action a) { handle_action(a); },
                               .on_drop = [this](const std::string& file) { open_dropped(file); },
                               .on_close = [this] { closed_ = true; }};
  SDL_Event event;
  while (SDL_PollEvent(&event) != 0) {
    interface_.handle(event);
    input_.handle(event, viewer_, interface_.takes_keyboard(), interface_.takes_mouse(), handlers);
  }
}

// Advances the animation by the time since the last frame. Returns this time in seconds.
double ViewApp::advance() {
  constexpr double kLongest = 0.25;
  const Clock::time_point now = Clock::now();
  times_.frame = milliseconds(now - std::exchange(frame_time_, now));
  const double step = is_timed() ? kTimedStep : std::min(times_.frame * 1e-3, kLongest);
  viewer_.advance(step);
  return step;
}

// Traces the picked pixel; while the camera moves or an animation runs, not in every frame.
void ViewApp::update_history(bool moving) {
  if (!picked_) return;
  if (moving && !picked_->history.empty()) {
    picked_->is_outdated = true;
    return;
  }
  show_busy("computing the history of the pixel");
  const glm::ivec2 last(scene_frame_.width() - 1, scene_frame_.height() - 1);
  picked_ = frames_.pick(glm::clamp(picked_->pixel, glm::ivec2(0), last), options_.name);
  viewer_.set_picked_object(picked_->object);
}

void ViewApp::render_scene(const FrameQuality& quality, bool moving) {
  try {
    frames_.render(viewer_.description(), quality, viewer_.overlay(), scene_frame_);
    update_history(moving);
  } catch (const InputError& e) {
    viewer_.set_message(e.what());
  }
}

// Renders the scene if its picture has changed. Returns false if it has not.
bool ViewApp::update_scene_frame(const glm::ivec2& size) {
  const bool moving = input_.is_moving() || viewer_.is_running();
  const FrameQuality quality = is_timed() ? FrameQuality{} : FrameQuality{coarse_.divisor(moving), moving};
  const bool is_stale = picked_ && picked_->is_outdated && !moving;
  const Shown next{viewer_.revision(), viewer_.animation_seconds(), viewer_.overlay(), size, quality};
  if (shown_ == next && !is_timed() && !is_stale) return false;
  if (scene_frame_.width() != size.x || scene_frame_.height() != size.y) scene_frame_ = Image<glm::u8vec4>(size.x, size.y);
  render_scene(quality, moving);
  // The time of the other overlays does not depend on the resolution of the picture.
  const double overlay_ms = viewer_.overlay() == Overlay::shadow_error ? frames_.times().overlay_ms : 0.0;
  coarse_.add_frame(quality.divisor, frames_.times().prepare_ms + frames_.times().draw_ms + overlay_ms);
  shown_ = next;
  return true;
}

void ViewApp::show_frame() {
  const bool rendered = update_scene_frame(window_.size());
  times_.idle = !rendered && !input_.is_moving();
  if (viewer_.message() != last_message_) {
    last_message_ = viewer_.message();
    message_time_ = Clock::now();
  }
  const WindowTimes before = times_;
  present("");
  if (!rendered) times_ = before;  // the statistics describe the last frame of the scene
  if (!options_.record.empty()) write_png(options_.record / fmt::format("frame_{:04}.png", frame_number_), frame_);
}

// Draws the user interface over the last frame of the scene and shows it.
void ViewApp::present(const std::string& busy) {
  constexpr auto kMessageTime = std::chrono::seconds(4);
  const Clock::time_point start = Clock::now();
  frame_ = scene_frame_;
  const bool show_message = Clock::now() - message_time_ < kMessageTime;
  interface_.draw(viewer_, {frames_, times_, picked_, show_message, busy}, frame_, workers_);
  const Clock::time_point drawn = Clock::now();
  window_.present(frame_);
  times_.interface = milliseconds(drawn - start);
  times_.present = milliseconds(Clock::now() - drawn);
}

// Shows what the program is about to do, because it cannot react to input until that is done.
void ViewApp::show_busy(const std::string& text) {
  const glm::ivec2 size = window_.size();
  if (scene_frame_.width() != size.x || scene_frame_.height() != size.y) {
    scene_frame_ = Image<glm::u8vec4>(size.x, size.y);
    std::fill_n(scene_frame_.data(), scene_frame_.texels().size(), glm::u8vec4(0, 0, 0, 255));
  }
  present(text);
  if (!options_.record.empty()) write_png(options_.record / fmt::format("busy_{:04}.png", frame_number_), frame_);
}

// Limits the frame rate. Waits for events while nothing changes.
void ViewApp::wait_for_change() {
  constexpr double kShortestFrameMs = 1000.0 / 60.0, kIdleMs = 200.0;
  const bool busy = input_.is_moving() || viewer_.is_running() || (shown_ && shown_->quality != FrameQuality{});
  const double rest = (busy ? kShortestFrameMs : kIdleMs) - milliseconds(Clock::now() - frame_time_);
  if (rest >= 1.0) SDL_WaitEventTimeout(nullptr, static_cast<int>(rest));
}

void ViewApp::add_times(RunTimes& sum) const {
  ++sum.frames;
  sum.prepare += frames_.times().prepare_ms;
  sum.draw += frames_.times().draw_ms;
  sum.interface += times_.interface;
  sum.present += times_.present;
}

RunTimes ViewApp::run() {
  show_busy("preparing the maps and meshes of " + options_.name);
  show_frame();
  RunTimes sum;
  const Clock::time_point start = frame_time_ = Clock::now();
  while (!closed_ && (!is_timed() || frame_number_ < *options_.frames)) {
    script_.push(frame_number_, window_.handle());
    handle_events();
    const double step = advance();
    input_.apply(viewer_, step, window_.size().y);
    show_frame();
    add_times(sum);
    ++frame_number_;
    if (!is_timed()) wait_for_change();
  }
  return mean_of(sum, milliseconds(Clock::now() - start));
}

}  // namespace halfspace
