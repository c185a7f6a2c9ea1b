// SPDX-License-Identifier: Apache-2.0
//
// `halfspace info`: describes a model file or, without one, the program: its version, its build, and the tools found on this machine.
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/build_commit.h"
#include "cli/commands.h"
#include "cli/stage_display.h"
#include "command_line/errors.h"
#include "halfspace/core/cpu.h"
#include "halfspace/render/model_file/model_info.h"
#include "halfspace/render/program_info.h"

namespace halfspace {

namespace {

void print_text(const nlohmann::ordered_json& info) {
  const auto tool = [&](const char* name, const char* missing) {
    return info.at(name).is_null() ? std::string("not found: ") + missing : info.at(name).get<std::string>();
  };
  std::cout << "halfspace " << HALFSPACE_VERSION << '\n'
            << "commit        " << build_commit() << '\n'
            << "build         " << build_description() << ", " << info.at("compiler").get<std::string>() << '\n'
            << "cores         " << info.at("cores") << " (" << info.at("cores_limit").get<std::string>() << ")\n"
            << "draco tool    " << tool("draco_tool", "glTF meshes that are compressed with Draco cannot be read") << '\n'
            << "image tool    " << tool("image_tool", "only PNG images and, with the JPEG tool, JPEG can be read") << '\n'
            << "jpeg tool     " << tool("jpeg_tool", "JPEG images need the image tool") << '\n';
}

std::optional<UpAxis> parse_up_axis(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (text != "y" && text != "z") throw UsageError("--up-axis is '" + text + "'; expected y or z");
  return text == "z" ? UpAxis::z : UpAxis::y;
}

}  // namespace

void info_command(const InfoArguments& args) {
  set_limits(args.limits);
  const auto read = [&] {
    const StageDisplay reading("reading " + args.model);
    return model_info(args.model, args.allow_outside, parse_up_axis(args.up_axis));
  };
  nlohmann::ordered_json info = args.model.empty() ? program_info(HALFSPACE_VERSION) : read();
  if (args.model.empty()) info["commit"] = build_commit();
  if (args.json) {
    std::cout << info.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  } else if (args.model.empty()) {
    print_text(info);
  } else {
    std::cout << model_info_text(info);
  }
}

}  // namespace halfspace
