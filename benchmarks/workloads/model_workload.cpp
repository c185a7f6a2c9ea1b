// SPDX-License-Identifier: Apache-2.0
#include "workloads/model_workload.h"

#include <array>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/model_file/opened_scene.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace {

namespace {

class ModelWorkload final : public Workload {
 public:
  ModelWorkload(PreparedScene scene, WorkloadSize size) : scene_(std::move(scene)), picture_(size.width, size.height) {}

  void frame(const Workers& workers) override { render(scene_, picture_, workers); }
  WorkloadPicture picture() const override { return {&picture_, nullptr}; }
  bool has_truth() const override { return false; }
  WorkloadTruth truth() const override {  // not called, because has_truth() is false
    return {picture_.width(), picture_.height(), vec4<double>(0.0), 1.0};
  }

 private:
  PreparedScene scene_;
  Image<glm::u8vec4> picture_;
};

}  // namespace

std::span<const ModelRow> model_rows() {
  static const std::array<ModelRow, 2> rows{
      {{"model", "a model file with metallic-roughness materials", 1}, {"model_msaa4", "the same with 4 samples per pixel", 4}}};
  return rows;
}

PreparedScene prepared_model(const std::string& file, WorkloadSize size, int samples) {
  if (!is_model_file(file)) throw InputError(file + ": not a model file; expected .glb, .gltf, .obj, .ply or .stl");
  ModelView view;
  view.aspect = static_cast<double>(size.width) / size.height;
  view.floor = false;
  OpenedScene opened = open_scene_or_model(file, view);
  opened.scene.set("shadow.method=none");
  opened.scene.set("samples=" + std::to_string(samples));
  const Workers workers(1);
  SceneAssets assets(workers);
  assets.add_model(opened.model_file, opened.model);
  return assets.prepare(opened.scene.description(), size.width, size.height);
}

std::vector<WorkloadKind> model_workloads(const std::string& file) {
  std::vector<WorkloadKind> kinds;
  for (const ModelRow& row : model_rows()) {
    kinds.push_back({row.name, row.what, [file, samples = row.samples](WorkloadSize size, WorkloadAssets&) {
                       return std::make_unique<ModelWorkload>(prepared_model(file, size, samples), size);
                     }});
  }
  return kinds;
}

}  // namespace halfspace
