// SPDX-License-Identifier: Apache-2.0
//
// `halfspace info`: describes a model file or, without one, the program: its version, its build, and the tools found on this machine.
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/model_info.h"
#include "cli/stage_display.h"
#include "halfspace/core/cpu.h"
#include "halfspace/core/lanes.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/image_tool.h"
#include "halfspace/model/draco_process.h"

namespace halfspace {

namespace {

constexpr const char* kCompiler =
#ifdef __clang__
    "Clang " __clang_version__;
#else
    "GCC " __VERSION__;
#endif

void print_text() {
  const std::filesystem::path tool = find_image_tool(), jpeg = find_jpeg_tool(), draco = find_draco_tool();
  std::cout << "halfspace " << HALFSPACE_VERSION << '\n'
            << "build         " << build_description() << ", " << kCompiler << '\n'
            << "cores         " << Workers::cores() << '\n'
            << "draco tool    " << (draco.empty() ? "not found: glTF meshes that are compressed with Draco cannot be read" : draco.string())
            << '\n'
            << "image tool    " << (tool.empty() ? "not found: only PNG images and, with the JPEG tool, JPEG can be read" : tool.string())
            << '\n'
            << "jpeg tool     " << (jpeg.empty() ? "not found: JPEG images need the image tool" : jpeg.string()) << '\n';
}

void print_json() {
  const std::filesystem::path tool = find_image_tool(), jpeg = find_jpeg_tool(), draco = find_draco_tool();
  nlohmann::ordered_json json = {{"version", HALFSPACE_VERSION}, {"arch", build_arch()},  {"lanes", kLanes},      {"compiler", kCompiler},
                                 {"cores", Workers::cores()},    {"image_tool", nullptr}, {"jpeg_tool", nullptr}, {"draco_tool", nullptr}};
  if (!tool.empty()) json["image_tool"] = tool.string();
  if (!jpeg.empty()) json["jpeg_tool"] = jpeg.string();
  if (!draco.empty()) json["draco_tool"] = draco.string();
  std::cout << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

}  // namespace

void info_command(const InfoArguments& args) {
  set_limits(args.limits);
  if (!args.model.empty()) {
    const std::string text = [&] {
      const StageDisplay reading("reading " + args.model);
      return model_info(args);
    }();
    std::cout << text;
  } else {
    args.json ? print_json() : print_text();
  }
}

}  // namespace halfspace
