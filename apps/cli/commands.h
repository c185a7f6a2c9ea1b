// SPDX-License-Identifier: Apache-2.0
//
// The subcommands of `halfspace`. They throw UsageError, DifferenceError, InputError or OutputError. Only main.cpp and
// options.cpp, which declare their options, include the command-line parser, because it is slow to compile.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/output_arguments.h"
#include "command_line/limit_arguments.h"
#include "command_line/model_arguments.h"

namespace halfspace {

// The structs contain option values as given on the command line. An empty string means that the option was not given.

struct RenderArguments {
  std::vector<std::string> scenes;
  std::string list;  ///< file with further scenes
  std::string out;   ///< default: SCENE.png, or MODEL-render.png
  std::string size = "1920x1080";
  std::vector<std::string> set;
  std::string camera;   ///< default: the camera set in the scene
  std::string shading;  ///< default: the shading rate of each object
  std::string time;     ///< default: 0
  std::string frames;   ///< default: one image, without a frame number
  std::string shard;    ///< default: all frames
  std::string fps;      ///< default: 30
  std::string threads;  ///< default: one per core
  std::string statistics;
  std::string max_error, max_error_color;  ///< if both are empty, the scene is rendered unchanged
  std::string wireframe;                   ///< "lines", "hidden", or empty: surfaces
  std::string format;                      ///< of standard output; default: png
  std::string loop;                        ///< of animations; default: 0, forever
  std::string report;                      ///< file for the JSON report of --list
  std::string progress;                    ///< "json", or empty: a bar on terminals
  bool quiet = false, verbose = false;
  bool mpi = false;
  bool naive = false;  ///< draw with the naive pipeline
  bool resume = false;
  bool no_cache = false;  ///< do not keep simplified meshes on disk
  bool print = false;
  ModelArguments model;
  LimitArguments limits;
  OutputArguments output;
};
void render_command(const RenderArguments& args);

struct ExplainArguments {
  std::string scene;
  std::string out;  ///< default: SCENE.html, or MODEL-explain.html
  std::string size = "640x360";
  std::vector<std::string> set;
  std::string camera, shading, time, threads;  ///< see RenderArguments
  std::string pixel;                           ///< default: the pixel with the most fragments
  std::string lessons;                         ///< see PageOptions; empty: none
  bool text = false, json = false;
  ModelArguments model;
  LimitArguments limits;
};
void explain_command(const ExplainArguments& args);

struct ExportArguments {
  std::string scene, out, threads;
  std::vector<std::string> set;
  bool allow_outside = false;
  LimitArguments limits;
};
void export_command(const ExportArguments& args);

struct ConvertNormalArguments {
  std::string height, out;
  std::string strength;  ///< default: 8
  std::string edges = "repeat";
};
void convert_normal_command(const ConvertNormalArguments& args);

struct ValidateArguments {
  std::string scene;
  std::string out;  ///< default: write no images
  std::string size = "960x540";
  std::vector<std::string> set;
  std::string camera, time, threads, rays;
  bool json = false, table = false, full = false;
  ModelArguments model;  ///< only allow_outside
  LimitArguments limits;
};
/// Only defined in builds with ray casting (HALFSPACE_HAS_RAYS).
void validate_command(const ValidateArguments& args);

struct CompareArguments {
  std::string a, b;
  std::string out;        ///< default: write no difference image
  std::string tolerance;  ///< default: accept any difference
  bool json = false;
};
void compare_command(const CompareArguments& args);

struct CheckLessonArguments {
  std::string lesson, file;
  std::string out;  ///< default: FILE-difference.png, and no differences of the pictures in a folder
};
void check_lesson_command(const CheckLessonArguments& args);

struct ChartArguments {
  std::string study, out = "charts", threads;
  bool quick = false;
};
/// Only defined in builds with ray casting (HALFSPACE_HAS_RAYS).
void chart_command(const ChartArguments& args);
/// Returns the names of all studies in lines of less than 80 characters. Only defined in builds with ray casting.
std::string study_lines();

struct ListArguments {
  std::string scene;  ///< default: list the built-in scenes
  bool names = false, schema = false;
};
void list_command(const ListArguments& args);

struct InfoArguments {
  std::string model;    ///< default: describe the program
  std::string up_axis;  ///< default: that of the format
  bool json = false, allow_outside = false;
  LimitArguments limits;
};
void info_command(const InfoArguments& args);

struct CompletionArguments {
  std::string shell, command;
};
/// `words` must return the options of a command, or the names of all commands if the name is empty.
void completion_command(const CompletionArguments& args, const std::function<std::vector<std::string>(const std::string& command)>& words);

}  // namespace halfspace
