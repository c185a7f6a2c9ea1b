// SPDX-License-Identifier: Apache-2.0
#include "view/scene_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace halfspace {

void ScenePanel::read_scene(const Viewer& viewer) {
  if (revision_ == viewer.revision()) return;
  revision_ = viewer.revision();
  scene_ = viewer.scene().description();
  sections_ = sections_of(scene_);
}

float ScenePanel::width(double ui_scale) { return std::min(static_cast<float>(380.0 * ui_scale), 0.5f * ImGui::GetIO().DisplaySize.x); }

void ScenePanel::draw(Viewer& viewer, double ui_scale) {
  read_scene(viewer);
  const auto scale = static_cast<float>(ui_scale);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x - width(ui_scale), 0}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({width(ui_scale), display.y}, ImGuiCond_Always);
  std::vector<std::string> settings;
  ImGui::Begin("Scene", nullptr, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse);
  ImGui::PushItemWidth(-std::min(130.0f * scale, 0.4f * width(ui_scale)));  // the rest is for names
  for (const NamedSection& section : sections_) {
    const std::string title = section.path.empty() ? "scene" : section.path;
    if (!ImGui::CollapsingHeader(title.c_str(), section.path.empty() ? ImGuiTreeNodeFlags_DefaultOpen : 0)) continue;
    ImGui::PushID(title.c_str());
    for (const Field& field : fields_of(section.section)) {
      const std::optional<std::string> text = draw_key(field);
      if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) ImGui::SetTooltip("%s", field.key->help);
      if (text) settings.push_back((section.path.empty() ? "" : section.path + ".") + field.key->name + "=" + *text);
    }
    ImGui::PopID();
  }
  ImGui::PopItemWidth();
  ImGui::End();
  if (!settings.empty()) viewer.set(settings);
}

}  // namespace halfspace
