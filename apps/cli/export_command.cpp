// SPDX-License-Identifier: Apache-2.0
//
// `halfspace export SCENE -o FILE`: writes a scene or a model as glTF, OBJ, PLY or STL.
#include "cli/commands.h"
#include "cli/stage_display.h"
#include "command_line/arguments.h"
#include "command_line/command_line.h"
#include "command_line/errors.h"
#include "command_line/scene_arguments.h"
#include "halfspace/core/parallel.h"
#include "halfspace/render/export/export_files.h"
#include "halfspace/render/model_file/model_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

namespace {

ExportSource model_source(const ExportArguments& args) {
  if (!args.set.empty()) throw UsageError("--set applies only to scenes; expected a model without it");
  return export_source(args.scene, args.allow_outside);
}

ExportSource scene_source(const ExportArguments& args, ModelFormat format, const Workers& workers) {
  SceneFile file = SceneFile::open(args.scene);
  if (args.allow_outside) allow_outside(file);
  set_scene(file, args.set, "");
  SceneAssets assets(workers);
  return export_source(file.at(0.0), args.scene, assets, format);
}

}  // namespace

void export_command(const ExportArguments& args) {
  set_limits(args.limits);
  const std::filesystem::path out = args.out;
  const std::optional<ModelFormat> format = model_format_of(out);
  if (!format) throw UsageError("-o is '" + args.out + "'; expected a file name ending in .glb, .gltf, .obj, .ply or .stl");
  const StageDisplay display("exporting " + args.scene);
  const Workers workers(parse_threads(args.threads));
  ExportSource source = is_model_file(args.scene) ? model_source(args) : scene_source(args, *format, workers);
  write_files(out, exported_files(std::move(source), out, *format, print_warning));
}

}  // namespace halfspace
