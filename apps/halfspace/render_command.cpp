// SPDX-License-Identifier: Apache-2.0
//
// `halfspace render SCENE`: checks all arguments, renders, writes the picture.
#include <array>
#include <charconv>
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>

#include "core/check.h"
#include "core/parallel.h"
#include "halfspace/commands.h"
#include "halfspace/statistics.h"
#include "scene/earth.h"
#include "scene/image_io.h"
#include "scene/nearest_name.h"
#include "scene/output_file.h"

namespace halfspace {

namespace {

constexpr std::array<std::string_view, 1> kScenes = {"earth"};
constexpr std::array<std::string_view, 1> kEarthKeys = {"earth.color"};
constexpr int kMostEdge = 16384;
constexpr int kMostThreads = 1024;

struct RenderArguments {
  std::string scene;
  std::string out;  // empty: SCENE.png
  std::string size = "1920x1080";
  std::vector<std::string> set;
  std::string threads;  // empty: one a core
  std::string statistics;
};

struct Size {
  int width, height;
};

// A whole decimal number; something negative where it is none.
int parse_number(std::string_view text) {
  int n = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  return error == std::errc() && end == text.data() + text.size() ? n : -1;
}

Size parse_size(std::string_view text) {
  const std::size_t x = text.find('x');
  if (x != std::string_view::npos && x > 0 && x + 1 < text.size()) {
    const Size size{parse_number(text.substr(0, x)), parse_number(text.substr(x + 1))};
    if (std::min(size.width, size.height) >= 1 && std::max(size.width, size.height) <= kMostEdge) return size;
  }
  throw UsageError("--size is '" + std::string(text) + "'; expected WxH with 1 to 16384 each, for example 1920x1080");
}

std::filesystem::path output_path(const RenderArguments& args) {
  const std::filesystem::path path = args.out.empty() ? args.scene + ".png" : args.out;
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  std::error_code error;
  const bool special = std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error);
  if (extension != ".png" && !special) throw UsageError("-o is '" + path.string() + "'; expected a name that ends in .png");
  return path;
}

void apply_setting(EarthOptions& options, std::string_view setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw UsageError("--set is '" + std::string(setting) + "'; expected KEY=VALUE, for example earth.color=FILE");
  }
  const std::string_view key = setting.substr(0, equals);
  const std::string_view value = setting.substr(equals + 1);
  if (key != kEarthKeys[0]) throw InputError("--set: unknown key '" + std::string(key) + "'" + suggestion(key, kEarthKeys));
  if (value.empty()) throw InputError("--set: earth.color is empty; expected the name of an image file");
  options.color_map = value;
}

int parse_threads(std::string_view text) {
  if (text.empty()) return Workers::cores();
  const int threads = parse_number(text);
  if (threads >= 1 && threads <= kMostThreads) return threads;
  throw UsageError("--threads is '" + std::string(text) + "'; expected 1 to " + std::to_string(kMostThreads));
}

void check_statistics(const std::string& format) {
  if (format == "" || format == "text" || format == "json") return;
  throw UsageError("--stats is '" + format + "'; expected --stats or --stats=json");
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void render(const RenderArguments& args) {
  const Size size = parse_size(args.size);
  const int threads = parse_threads(args.threads);
  check_statistics(args.statistics);
  if (args.scene != kScenes[0]) throw InputError("unknown scene '" + args.scene + "'" + suggestion(args.scene, kScenes));
  EarthOptions options;
  options.width = size.width;
  options.height = size.height;
  for (const std::string& setting : args.set) apply_setting(options, setting);
  const std::filesystem::path out = output_path(args);
  check_writable(out);

  const Workers workers(threads);
  const auto start = std::chrono::steady_clock::now();
  const RenderResult result = render_earth(options, workers);
  const double render_ms = milliseconds_since(start);
  write_png(out, result.image);
  if (args.statistics.empty()) return;
  const double write_ms = milliseconds_since(start) - render_ms;
  const RenderReport report{args.scene, out.string(), size.width, size.height, threads, render_ms, write_ms, result.statistics};
  std::cout << (args.statistics == "json" ? json_report(report) : text_report(report));
}

}  // namespace

void add_render_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "Render a scene to a picture");
  const auto args = std::make_shared<RenderArguments>();
  command->add_option("SCENE", args->scene, "The scene's name: earth")->required()->type_name("");
  command->add_option("-o,--output", args->out, "The picture (default SCENE.png)")->type_name("OUT.png");
  command->add_option("--size", args->size, "Pixels (default 1920x1080)")->type_name("WxH");
  command->add_option("--set", args->set, "Set a key: earth.color (the map, a file)")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--threads", args->threads, "Threads (default: one a core)")->type_name("N");
  command->add_flag("--stats{text}", args->statistics, "Print times and counts, as text or JSON")->option_text("[=json]");
  command->footer(
      "Examples:\n"
      "  halfspace render earth -o earth.png --size 1280x720\n"
      "  halfspace render earth --set earth.color=earthmap.jpg --stats");
  command->callback([args] { render(*args); });
}

}  // namespace halfspace
