// SPDX-License-Identifier: Apache-2.0
//
// The scenes as workloads, drawn by Halfspace.
#include "scenes/scene_draw.h"
#include "workloads/workload_assets.h"
#include "workloads/workload_canvas.h"

namespace halfspace {

namespace {

class SceneWorkload final : public Workload {
 public:
  SceneWorkload(std::shared_ptr<const Scene> scene, int camera, WorkloadSize size)
      : scene_(std::move(scene)),
        view_(scene_view(*scene_, scene_->cameras[static_cast<std::size_t>(camera)], size)),
        map_(kShadowMapSize, kShadowMapSize),
        canvas_(size),
        job_{*scene_, view_, {}, {}} {
    const std::span<const uint32_t> indices(scene_->indices);
    for (const SceneMesh& mesh : scene_->meshes) job_.meshes.emplace_back(indices.subspan(mesh.first, mesh.count), scene_->vertices.size());
    job_.uniforms.clip_from_world = view_.clip_from_world;
    job_.uniforms.light_from_world = view_.light_from_world;
    job_.uniforms.eye_ws = view_.eye_ws;
    job_.uniforms.shadow_map = map_.data();
    job_.uniforms.light = &scene_->light;
  }

  void frame(const Workers& workers) override {
    Pass light(kShadowMapSize, kShadowMapSize, ColorTarget{}, d32f_target(map_));
    for (const std::size_t i : view_.casters) draw_scene_depth(light, job_, scene_->objects[i]);
    light.run(workers);
    Pass pass = canvas_.pass();
    for (const std::size_t i : view_.order) draw(pass, scene_->objects[i]);
    pass.run(workers);
  }

  WorkloadPicture picture() const override { return canvas_.picture(); }
  bool has_truth() const override { return false; }
  WorkloadTruth truth() const override { return canvas_.truth(); }  // not called, because has_truth() is false

 private:
  void draw(Pass& pass, const SceneObject& object) const {
    switch (scene_->material(object).surface) {
      case SceneSurface::opaque: return draw_scene_opaque(pass, job_, object);
      case SceneSurface::cutout: return draw_scene_cutout(pass, job_, object);
      case SceneSurface::unlit: return draw_scene_unlit(pass, job_, object);
      case SceneSurface::blended: return draw_scene_blended(pass, job_, object);
    }
  }

  std::shared_ptr<const Scene> scene_;
  SceneView view_;
  Image<float> map_;
  Canvas canvas_;
  SceneJob job_;
};

}  // namespace

std::span<const WorkloadKind> scene_workloads() {
  static const std::vector<WorkloadKind> kinds = [] {
    std::vector<WorkloadKind> all;
    for (const SceneRow& row : scene_rows()) {
      all.push_back({row.name, row.what, [&row](WorkloadSize size, WorkloadAssets& assets) {
                       return std::make_unique<SceneWorkload>(shared_scene(assets, row.kind), row.camera, size);
                     }});
    }
    return all;
  }();
  return kinds;
}

}  // namespace halfspace
