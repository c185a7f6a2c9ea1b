// SPDX-License-Identifier: Apache-2.0
//
// The page of `halfspace explain`.
#include "explain/page.h"

#include "cli/explain_command.h"
#include "cli/render_comment.h"
#include "command_line/errors.h"
#include "halfspace/render/model_file/model_scene.h"

namespace halfspace {

std::filesystem::path page_path(const ExplainArguments& args) {
  if (args.out.empty()) return std::filesystem::path(args.scene).stem().string() + (is_model_file(args.scene) ? "-explain.html" : ".html");
  const std::filesystem::path out = args.out;
  if (out.extension() != ".html" && out.extension() != ".htm" && out.has_extension())
    throw UsageError("-o is '" + args.out + "'; expected a file name ending in .html");
  return out;
}

ExplainCommands explain_commands(const ExplainArguments& args, double seconds) {
  RenderArguments render;
  render.set = args.set;
  render.camera = args.camera;
  render.shading = args.shading;
  render.model = args.model;
  render.size = args.size;
  const std::string rendered = render_comment(render, args.scene, seconds, FileNames::as_given);
  if (args.size == kExplainSize) render.size.clear();
  const std::string_view before = "halfspace render";
  return {"halfspace explain" + render_comment(render, args.scene, seconds, FileNames::as_given).substr(before.size()), rendered};
}

std::string page_of(const ExplainJob& job) {
  return explain_page(job.scene, job.prepared,
                      {job.title, job.commands.explain, job.commands.render, HALFSPACE_VERSION, job.lessons, job.pixel}, job.workers);
}

}  // namespace halfspace
