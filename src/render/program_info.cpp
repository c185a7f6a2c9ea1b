// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/program_info.h"

#include <nlohmann/json.hpp>

#include "halfspace/core/available_cpus.h"
#include "halfspace/core/cpu.h"
#include "halfspace/core/lanes.h"
#include "halfspace/image/image_tool.h"
#include "halfspace/model/gltf/draco_process.h"

namespace halfspace::HS_LANES {

namespace {

constexpr const char* kCompiler =
#ifdef __clang__
    "Clang " __clang_version__;
#else
    "GCC " __VERSION__;
#endif

}  // namespace

nlohmann::ordered_json program_info(const std::string& version) {
  const AvailableCpus cpus = available_cpus();
  nlohmann::ordered_json json = {{"version", version},    {"arch", build_arch()}, {"lanes", kLanes},
                                 {"compiler", kCompiler}, {"cores", cpus.count},  {"cores_limit", name_of(cpus.limit)}};
  const auto add = [&](const char* name, const std::filesystem::path& tool) {
    json[name] = tool.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(tool.string());
  };
  add("image_tool", find_image_tool());
  add("jpeg_tool", find_jpeg_tool());
  add("draco_tool", find_draco_tool());
  return json;
}

}  // namespace halfspace::HS_LANES
