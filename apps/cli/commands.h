// SPDX-License-Identifier: Apache-2.0
//
// The subcommands of `halfspace`. They throw UsageError, DifferenceError, InputError or OutputError. Only main.cpp, which declares
// their options, includes the command-line parser, because it is slow to compile.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace halfspace {

struct RenderArguments {
  std::string scene;
  std::string out;  ///< empty: SCENE.png
  std::string size = "1920x1080";
  std::vector<std::string> set;
  std::string camera;   ///< empty: the camera set in the scene
  std::string shading;  ///< empty: the shading rate of each object
  std::string time;     ///< empty: 0
  std::string frames;   ///< empty: one image, without a frame number
  std::string fps;      ///< empty: 30
  std::string threads;  ///< empty: one per core
  std::string statistics;
  std::string max_error, max_error_color;  ///< both empty: render the scene as it is
  bool resume = false;
  bool print = false;
};
void render_command(const RenderArguments& args);

struct ConvertNormalArguments {
  std::string height, out;
  std::string strength;  ///< empty: 8
  std::string edges = "repeat";
};
void convert_normal_command(const ConvertNormalArguments& args);

struct ValidateArguments {
  std::string scene;
  std::string out;  ///< empty: write no images
  std::string size = "960x540";
  std::vector<std::string> set;
  std::string camera, time, threads, rays;
  bool json = false, table = false, full = false;
};
/// Only defined in builds with ray casting (HALFSPACE_HAS_RAYS).
void validate_command(const ValidateArguments& args);

struct CompareArguments {
  std::string a, b;
  std::string out;        ///< empty: write no difference image
  std::string tolerance;  ///< empty: accept any difference
  bool json = false;
};
void compare_command(const CompareArguments& args);

struct ChartArguments {
  std::string study, out = "charts", threads;
  bool quick = false;
};
/// Only defined in builds with ray casting (HALFSPACE_HAS_RAYS).
void chart_command(const ChartArguments& args);
/// Returns the names of all studies in lines of less than 80 characters. Only defined in builds with ray casting.
std::string study_lines();

struct ListArguments {
  std::string scene;  ///< empty: list the built-in scenes
  bool names = false, schema = false;
};
void list_command(const ListArguments& args);

struct InfoArguments {
  bool json = false;
};
void info_command(const InfoArguments& args);

struct CompletionArguments {
  std::string shell, command;
};
/// `words` must return the options of a command, or the names of all commands if the name is empty.
void completion_command(const CompletionArguments& args, const std::function<std::vector<std::string>(const std::string& command)>& words);

}  // namespace halfspace
