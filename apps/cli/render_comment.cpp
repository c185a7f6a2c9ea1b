// SPDX-License-Identifier: Apache-2.0
#include "cli/render_comment.h"

#include <fmt/format.h>

#include <algorithm>

#include "halfspace/core/text.h"

namespace halfspace {

namespace {

// Quotes text that a shell would split or change. Control characters and bytes that are not UTF-8 are escaped, because image formats do not
// store them.
std::string quoted(const std::string& given) {
  const std::string text = printable(given);
  const bool is_plain = !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           std::string_view("._-+,:#%@/").find(c) != std::string_view::npos;
  });
  if (is_plain) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string quoted_file(const std::string& file, FileNames names) {
  return quoted(names == FileNames::as_given ? file : file.substr(file.find_last_of("/\\") + 1));
}

}  // namespace

std::string render_comment(const RenderArguments& args, const std::string& scene, double seconds, FileNames names) {
  std::string line = "halfspace render " + quoted_file(scene, names);
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) line += fmt::format(" {} {}", option, quoted(value));
  };
  const auto add_flag = [&](const char* option, bool given) {
    if (given) line += fmt::format(" {}", option);
  };
  add("--size", args.size);
  for (const std::string& setting : args.set) {
    const std::size_t equals = setting.find('=');
    line += fmt::format(" --set {}={}", setting.substr(0, equals), quoted_file(setting.substr(equals + 1), names));
  }
  add("--camera", args.camera);
  add("--shading", args.shading);
  if (seconds != 0.0) add("--time", number_text(seconds));
  add("--max-error", args.max_error);
  add("--max-error-color", args.max_error_color);
  add("--crop", args.output.crop);
  add("--bits", args.output.bits);
  const ModelArguments& m = args.model;
  const std::pair<const char*, const std::string*> options[] = {{"--yaw", &m.yaw},
                                                                {"--pitch", &m.pitch},
                                                                {"--zoom", &m.zoom},
                                                                {"--fov", &m.fov},
                                                                {"--eye", &m.eye},
                                                                {"--look-at", &m.look_at},
                                                                {"--up", &m.up},
                                                                {"--turntable", &m.turntable},
                                                                {"--background", &m.background},
                                                                {"--up-axis", &m.up_axis},
                                                                {"--scene", &m.model_scene},
                                                                {"--animation", &m.animation},
                                                                {"--variant", &m.variant}};
  for (const auto& [option, value] : options) add(option, *value);
  if (!m.environment.empty()) line += " --environment " + quoted_file(m.environment, names);
  if (!m.turntable.empty()) add("--fps", args.fps);
  if (!args.wireframe.empty()) line += args.wireframe == "hidden" ? " --wireframe=hidden" : " --wireframe";
  add_flag("--inside", m.inside);
  add_flag("--no-floor", m.no_floor);
  add_flag("--allow-outside", m.allow_outside);
  return line;
}

}  // namespace halfspace
