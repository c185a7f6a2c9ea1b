// SPDX-License-Identifier: Apache-2.0
#include "view/interface.h"

#include <fmt/format.h>
#include <imgui.h>
#if __has_include(<imgui_impl_sdl2.h>)
#include <imgui_impl_sdl2.h>
#else
#include <imgui_impl_sdl.h>
#endif

#include <algorithm>
#include <utility>

#include "view/interface_font.h"

namespace halfspace {

namespace {

constexpr double kTextHeight = 14.0;  // pixels at scale 1

constexpr ImGuiWindowFlags kLabelFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize |
                                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

// Begins a text window. x and y: position of the window in the display, from 0 to 1; the window is moved up by `above` pixels. The caller
// must call ImGui::End().
void begin_label(const char* name, float x, float y, float above = 0.0f) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({x * display.x, y * display.y - above}, ImGuiCond_Always, {x, y});
  ImGui::SetNextWindowBgAlpha(0.75f);
  ImGui::Begin(name, nullptr, kLabelFlags);
}

void draw_label(const char* name, float x, float y, const std::string& text) {
  begin_label(name, x, y);
  ImGui::PushTextWrapPos(ImGui::GetIO().DisplaySize.x * 0.9f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

// Returns the height of the part of the display that the message can cover.
float message_height(float scale) { return 40.0f * scale; }

bool is_in_lower_half(const PickedPixel& picked) { return static_cast<float>(picked.pixel.y) > 0.5f * ImGui::GetIO().DisplaySize.y; }

// Shows the history of a pixel in a window that scrolls if it is long: above the pixel if the pixel is in the lower half of the display,
// and otherwise below the pixel and above the message, so that the window does not cover the pixel.
void draw_picked(const PickedPixel& picked, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ImVec2 at(static_cast<float>(picked.pixel.x) + 0.5f, static_cast<float>(picked.pixel.y) + 0.5f);
  const float message = message_height(scale), marker = 10.0f * scale;
  const float free = is_in_lower_half(picked) ? at.y - marker : display.y - message - at.y - marker;
  const float y = is_in_lower_half(picked) ? 0.0f : 1.0f;
  if (!picked.history.empty()) {
    ImGui::SetNextWindowPos({0.0f, y * (display.y - message)}, ImGuiCond_Always, {0.0f, y});
    ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {display.x, std::max(1.0f, std::min(free, 0.6f * display.y))});
    ImGui::SetNextWindowBgAlpha(0.85f);
    ImGui::Begin("Pixel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_HorizontalScrollbar);
    if (picked.is_outdated) ImGui::TextUnformatted("history of an earlier frame; press space to pause the animation");
    ImGui::TextUnformatted(picked.history.c_str());
    ImGui::End();
  }
  for (const auto& [color, width] : {std::pair(IM_COL32(0, 0, 0, 255), 3.0f), std::pair(IM_COL32(255, 255, 255, 255), 1.0f)})
    ImGui::GetBackgroundDrawList()->AddCircle(at, 6.0f * scale, color, 24, width * scale);
}

// Shows a line of text in the middle of the display. Drawn without a window, because ImGui shows new windows only in their second frame.
void draw_note(const std::string& text, float scale) {
  const ImVec2 display = ImGui::GetIO().DisplaySize, size = ImGui::CalcTextSize(text.c_str());
  const float margin = 8.0f * scale, x = 0.5f * (display.x - size.x), y = 0.5f * (display.y - size.y);
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRectFilled({x - margin, y - margin}, {x + size.x + margin, y + size.y + margin}, IM_COL32(20, 20, 20, 230));
  list.AddText({x, y}, IM_COL32_WHITE, text.c_str());
}

}  // namespace

Interface::Context::Context(double scale) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // do not store the positions of windows in a file
  add_interface_font(*io.Fonts, interface_font(), kTextHeight * scale);
  ImGui::StyleColorsDark();
  ImGui::GetStyle().ScaleAllSizes(static_cast<float>(scale));
  ImGui::GetStyle().AntiAliasedLinesUseTex = false;
}

Interface::Context::~Context() { ImGui::DestroyContext(); }

Interface::Interface(SDL_Window* window, double scale) : context_(scale), scale_(scale), pass_(*ImGui::GetIO().Fonts) {
  ImGui_ImplSDL2_InitForVulkan(window);  // only input is used, so any backend works; this one needs no other arguments
}

Interface::~Interface() { ImGui_ImplSDL2_Shutdown(); }

void Interface::handle(const SDL_Event& event) { ImGui_ImplSDL2_ProcessEvent(&event); }
bool Interface::takes_keyboard() const { return ImGui::GetIO().WantTextInput; }
bool Interface::takes_mouse() const { return ImGui::GetIO().WantCaptureMouse; }

void Interface::toggle(Action action) {
  if (action == Action::toggle_help) shows_help_ = !shows_help_;
  if (action == Action::toggle_panels) shows_panels_ = !shows_panels_;
  if (action == Action::toggle_statistics) shows_statistics_ = !shows_statistics_;
}

void Interface::draw_statistics(const Viewer& viewer, const Contents& c) const {
  const FrameTimes& t = c.frames.times();
  const PassStatistics& s = c.frames.statistics();
  const bool history_on_top = c.picked && is_in_lower_half(*c.picked);
  begin_label("Statistics", 0.0f, history_on_top ? 1.0f : 0.0f, history_on_top ? message_height(static_cast<float>(scale_)) : 0.0f);
  ImGui::TextUnformatted(frame_rate_text(c.times, t.total()).c_str());
  ImGui::TextUnformatted(fmt::format("{:6.1f} ms maps and shadows\n{:6.1f} ms drawing\n{:6.1f} ms overlay\n{:6.1f} ms interface\n"
                                     "{:6.1f} ms copy to the window",
                                     t.prepare_ms, t.draw_ms, t.overlay_ms, c.times.interface, c.times.present)
                             .c_str());
  ImGui::TextUnformatted(fmt::format("{} triangles in all passes, with shadow maps\n{} of them after culling\n"
                                     "{} vertices shaded\n{} samples passed\n{} fragments shaded",
                                     s.primitives_in, s.triangles_binned, s.vertices_shaded, s.samples_passed, s.fragments_shaded)
                             .c_str());
  ImGui::TextUnformatted(fmt::format("time {:.2f} s{}", viewer.animation_seconds(), viewer.is_paused() ? ", paused" : "").c_str());
  ImGui::End();
}

void Interface::draw_help() const {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const KeyBinding& b : key_bindings()) lines.emplace_back(b.key, b.help);
  lines.insert(lines.end(),
               {{"drag", "left button: orbit; other buttons: pan"}, {"wheel", "zoom"}, {"drop", "open a model or scene file"}});
  const float fitting = ImGui::GetIO().DisplaySize.y / ImGui::GetTextLineHeightWithSpacing() - 1.0f;
  const std::size_t rows = std::clamp(static_cast<std::size_t>(std::max(fitting, 1.0f)), std::size_t{8}, lines.size());
  begin_label("Keys", 0.5f, 0.5f);
  for (std::size_t first = 0; first < lines.size(); first += rows) {
    if (first > 0) ImGui::SameLine();
    ImGui::BeginGroup();
    for (std::size_t i = first; i < std::min(first + rows, lines.size()); ++i)
      ImGui::TextUnformatted(fmt::format("{:<7}{}", lines[i].first, lines[i].second).c_str());
    ImGui::EndGroup();
  }
  ImGui::End();
}

bool Interface::draw(Viewer& viewer, const Contents& c, Image<glm::u8vec4>& frame, const Workers& workers) {
  ImGui_ImplSDL2_NewFrame();
  ImGui::NewFrame();
  if (shows_panels_) panel_.draw(viewer, scale_);
  if (shows_statistics_) draw_statistics(viewer, c);
  if (c.picked) draw_picked(*c.picked, static_cast<float>(scale_));
  std::string text;
  const std::string lines[] = {c.frames.reduction_text(), c.frames.overlay_text(), c.show_message ? viewer.message() : ""};
  for (const std::string& line : lines) {
    if (!line.empty()) text += (text.empty() ? "" : "\n") + line;
  }
  const float free = shows_panels_ ? 1.0f - ScenePanel::width(scale_) / ImGui::GetIO().DisplaySize.x : 1.0f;  // fraction left of the panel
  if (!text.empty()) draw_label("Message", 0.5f * free, 1.0f, text);
  if (shows_help_) draw_help();
  if (!c.busy.empty()) draw_note(c.busy, static_cast<float>(scale_));
  ImGui::Render();
  const ImDrawData& data = *ImGui::GetDrawData();
  if (data.TotalVtxCount == 0) return false;
  pass_.draw(data, frame, workers);
  return true;
}

}  // namespace halfspace
