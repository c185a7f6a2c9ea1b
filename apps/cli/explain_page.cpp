// SPDX-License-Identifier: Apache-2.0
//
// The page of `halfspace explain`.
#include "halfspace/explain/page.h"

#include "cli/errors.h"
#include "cli/explain_command.h"
#include "cli/render_comment.h"
#include "halfspace/render/model_scene.h"

namespace halfspace {

std::filesystem::path page_path(const ExplainArguments& args) {
  if (args.out.empty()) return std::filesystem::path(args.scene).stem().string() + (is_model_file(args.scene) ? "-explain.html" : ".html");
  const std::filesystem::path out = args.out;
  if (out.extension() != ".html" && out.extension() != ".htm" && out.has_extension())
    throw UsageError("-o is '" + args.out + "'; expected a file name ending in .html");
  return out;
}

std::string explain_command_line(const ExplainArguments& args, double seconds) {
  RenderArguments render;
  render.scene = args.scene;
  render.size = args.size == kExplainSize ? "" : args.size;
  render.set = args.set;
  render.camera = args.camera;
  render.shading = args.shading;
  render.model = args.model;
  std::string line = render_comment(render, seconds);
  const std::string_view name = "render";
  return line.replace(line.find(name), name.size(), "explain");
}

std::string page_of(const ExplainJob& job) {
  return explain_page(job.scene, job.prepared, {job.title, job.command, HALFSPACE_VERSION, job.pixel}, job.workers);
}

}  // namespace halfspace
