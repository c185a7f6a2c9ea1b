// SPDX-License-Identifier: Apache-2.0
//
// `halfspace export SCENE -o FILE`: writes a scene or a model as glTF, OBJ, PLY or STL.
#include <span>

#include "cli/arguments.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/errors.h"
#include "cli/input_files.h"
#include "cli/scene_arguments.h"
#include "cli/stage_display.h"
#include "halfspace/core/check.h"
#include "halfspace/core/parallel.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/model/write_model.h"
#include "halfspace/render/export/embed_images.h"
#include "halfspace/render/export/pack_maps.h"
#include "halfspace/render/export/scene_model.h"
#include "halfspace/render/model_scene.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

namespace {

// A model and the files that it was read from.
struct ExportSource {
  Model model;
  std::vector<std::filesystem::path> inputs;
};

ExportSource model_source(const ExportArguments& args) {
  if (!args.set.empty()) throw UsageError("--set applies only to scenes; expected a model without it");
  Model model = read_model(args.scene, {.allow_outside = args.allow_outside});
  for (std::string& warning : model.warnings) warning.insert(0, args.scene + ": ");
  std::vector<std::filesystem::path> inputs = files_of(model);
  inputs.emplace_back(args.scene);
  return {std::move(model), std::move(inputs)};
}

ExportSource scene_source(const ExportArguments& args, bool with_lights, const Workers& workers) {
  SceneFile file = SceneFile::open(args.scene);
  if (args.allow_outside) allow_outside(file);
  set_scene(file, args.set, "");
  SceneAssets assets(workers);
  Model model = scene_model(file.at(0.0), assets, with_lights);
  std::vector<std::filesystem::path> inputs = input_files(file.description(), args.scene, {});
  for (const std::filesystem::path& input : files_of(model)) inputs.push_back(input);
  return {std::move(model), std::move(inputs)};
}

}  // namespace

void export_command(const ExportArguments& args) {
  set_limits(args.limits);
  const std::filesystem::path out = args.out;
  const std::optional<ModelFormat> format = model_format_of(out);
  if (!format) throw UsageError("-o is '" + args.out + "'; expected a file name ending in .glb, .gltf, .obj, .ply or .stl");
  const StageDisplay display("exporting " + args.scene);
  const Workers workers(parse_threads(args.threads));
  const bool is_gltf = *format == ModelFormat::glb || *format == ModelFormat::gltf;
  ExportSource source = is_model_file(args.scene) ? model_source(args) : scene_source(args, is_gltf, workers);
  if (source.model.meshes.empty())
    throw InputError(args.scene + ": has no meshes to export; expected at least one (particles are not exported)");
  embed_images(source.model, args.scene);
  if (is_gltf) pack_maps(source.model, args.scene);
  const WrittenModel written = written_model(source.model, out, *format);
  for (const ModelFile& file : written.files) reject_overwriting(out.parent_path() / file.name, source.inputs);
  for (const std::span<const std::string> warnings : {std::span<const std::string>(source.model.warnings), {written.warnings}}) {
    for (const std::string& warning : warnings) print_warning(warning);
  }
  // The main file is written last, so that it never refers to missing files.
  for (std::size_t i = written.files.size(); i-- > 0;) write_file(out.parent_path() / written.files[i].name, written.files[i].bytes);
}

}  // namespace halfspace
