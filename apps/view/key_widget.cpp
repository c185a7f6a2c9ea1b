// SPDX-License-Identifier: Apache-2.0
//
// The widgets for the types of keys.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "view/scene_panel.h"

namespace halfspace {

namespace {

using Changed = std::optional<std::string>;

std::string text_of(const glm::dvec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); }

// Returns the change of a number for one pixel of mouse movement.
float drag_speed(double value) { return static_cast<float>(std::max(std::fabs(value), 0.1) * 0.005); }

bool drag_numbers(const Key& key, double* values, int count) {
  const double largest = *std::max_element(values, values + count, [](double a, double b) { return std::fabs(a) < std::fabs(b); });
  return ImGui::DragScalarN(key.name, ImGuiDataType_Double, values, count, drag_speed(largest), &key.limits.low, &key.limits.high, "%.5g",
                            ImGuiSliderFlags_AlwaysClamp);
}

Changed draw_boolean(const Key& key, bool value) {
  return ImGui::Checkbox(key.name, &value) ? Changed(value ? "true" : "false") : std::nullopt;
}

Changed draw_integer(const Key& key, int value) {
  const int low = static_cast<int>(key.limits.low), high = static_cast<int>(key.limits.high);
  const bool changed = ImGui::DragInt(key.name, &value, std::max(1.0f, drag_speed(value)), low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
  return changed ? Changed(std::to_string(value)) : std::nullopt;
}

Changed draw_number(const Key& key, double value) { return drag_numbers(key, &value, 1) ? Changed(number_text(value)) : std::nullopt; }

Changed draw_vector(const Key& key, glm::dvec3 value) { return drag_numbers(key, &value.x, 3) ? Changed(text_of(value)) : std::nullopt; }

// Linear values, which can exceed 1.
Changed draw_color(const Key& key, const glm::dvec3& value) {
  glm::vec3 color(value);
  const bool changed = ImGui::ColorEdit3(key.name, &color.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
  return changed ? Changed(text_of(glm::max(glm::dvec3(color), key.limits.low))) : std::nullopt;
}

Changed draw_choice(const Key& key, uint8_t value) {
  Changed chosen;
  if (!ImGui::BeginCombo(key.name, std::string(key.choices[value]).c_str())) return chosen;
  for (std::size_t i = 0; i < key.choices.size(); ++i) {
    if (ImGui::Selectable(std::string(key.choices[i]).c_str(), i == value)) chosen = std::string(key.choices[i]);
  }
  ImGui::EndCombo();
  return chosen;
}

// A text field whose value is set when the user presses enter.
Changed draw_text(const Key& key, std::string text) {
  return ImGui::InputText(key.name, &text, ImGuiInputTextFlags_EnterReturnsTrue) ? Changed(text) : std::nullopt;
}

}  // namespace

Changed draw_key(const Field& field) {
  const Key& key = *field.key;
  switch (key.type) {
    case KeyType::boolean: return draw_boolean(key, *static_cast<const bool*>(field.value));
    case KeyType::integer: return draw_integer(key, *static_cast<const int*>(field.value));
    case KeyType::number: return draw_number(key, *static_cast<const double*>(field.value));
    case KeyType::vector: return draw_vector(key, *static_cast<const glm::dvec3*>(field.value));
    case KeyType::color: return draw_color(key, static_cast<const Color*>(field.value)->linear);
    case KeyType::choice: return draw_choice(key, *static_cast<const uint8_t*>(field.value));
    case KeyType::text: return draw_text(key, *static_cast<const std::string*>(field.value));
    case KeyType::file: return draw_text(key, static_cast<const FilePath*>(field.value)->path.string());
    case KeyType::map:
    case KeyType::numbers:
    case KeyType::keyframes: break;
  }
  return draw_text(key, value_text(field));
}

}  // namespace halfspace
