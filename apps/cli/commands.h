// SPDX-License-Identifier: Apache-2.0
//
// The subcommands of `halfspace` as functions of their arguments. They throw UsageError, DifferenceError, InputError or
// OutputError. main.cpp declares their options, so that they need not include the command line parser, which is slow to
// compile.
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
  std::string camera;   ///< empty: the scene's
  std::string shading;  ///< empty: the objects'
  std::string time;     ///< empty: 0
  std::string frames;   ///< empty: one picture
  std::string fps;      ///< empty: 30
  std::string threads;  ///< empty: one per core
  std::string statistics;
  std::string max_error, max_error_color;  ///< empty: the scene as it is
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
  std::string out;  ///< empty: no pictures
  std::string size = "960x540";
  std::vector<std::string> set;
  std::string camera, time, threads, rays;
  bool json = false, table = false, full = false;
};
/// Only where the program has rays.
void validate_command(const ValidateArguments& args);

struct CompareArguments {
  std::string a, b;
  std::string out;        ///< empty: no picture
  std::string tolerance;  ///< empty: none, differences are no error
  bool json = false;
};
void compare_command(const CompareArguments& args);

struct ChartArguments {
  std::string study, out = "charts", threads;
  bool quick = false;
};
/// Only where the program has rays.
void chart_command(const ChartArguments& args);
/// The names of all studies, in lines of less than 80 characters. Only where the program has rays.
std::string study_lines();

struct ListArguments {
  std::string scene;  ///< empty: the scenes that ship
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
/// words: returns the options of a command, or the names of all commands for "".
void completion_command(const CompletionArguments& args, const std::function<std::vector<std::string>(const std::string& command)>& words);

}  // namespace halfspace
