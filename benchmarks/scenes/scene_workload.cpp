// SPDX-License-Identifier: Apache-2.0
//
// The scenes as workloads, drawn by Halfspace.
#include "halfspace/raster/depth_on_demand.h"
#include "scenes/scene_draw.h"
#include "scenes/shadow_map_use.h"
#include "workloads/workload_assets.h"
#include "workloads/workload_canvas.h"

namespace halfspace {

namespace {

// The vertex stage of a smaller mesh takes too little time to matter.
constexpr uint32_t kMinClusteredTriangles = 1024;

// Returns the number of objects, from the front, that are drawn before the other ones are tested against them: those with an eighth of the
// triangles if near objects hide others, and all otherwise, because a second pass has its price.
std::size_t near_objects(const Scene& scene, const SceneView& view) {
  if (!scene.near_hides_far) return view.order.size();
  const auto triangles = [&](std::size_t i) { return scene.mesh(scene.objects[i]).count / 3; };
  std::size_t all = 0, near = 0, count = 0;
  for (const std::size_t i : view.order) all += triangles(i);
  while (near < all / 8) near += triangles(view.order[count++]);
  return count;
}

class SceneWorkload final : public Workload {
 public:
  SceneWorkload(std::shared_ptr<const Scene> scene, const SceneRow& row, WorkloadSize size)
      : scene_(std::move(scene)),
        keeps_map_(row.keeps_map),
        views_(scene_views(*scene_, row, size)),
        map_(kShadowMapSize, kShadowMapSize),
        canvas_(size) {
    const std::span<const uint32_t> indices(scene_->indices);
    const VertexStream positions = stream(scene_->vertices, &SceneVertex::position);
    for (const SceneMesh& mesh : scene_->meshes) {
      const Indices& list = meshes_.emplace_back(indices.subspan(mesh.first, mesh.count), scene_->vertices.size());
      clusters_.emplace_back();
      if (mesh.count >= 3 * kMinClusteredTriangles) clusters_.back().emplace(positions, list);
    }
    for (const SceneView& view : views_) {
      SceneJob& job = jobs_.emplace_back(SceneJob{*scene_, view, meshes_, clusters_, {}});
      job.uniforms.clip_from_world = view.clip_from_world;
      job.uniforms.light_from_world = view.light_from_world;
      job.uniforms.eye_ws = view.eye_ws;
      job.uniforms.shadow_map = {map_.data(), nullptr};
      job.uniforms.light = &scene_->light;
    }
  }

  void frame(const Workers& workers) override {
    for (const SceneJob& recorded : jobs_) {
      if (!keeps_map_ || &recorded == &jobs_.front()) draw_shadow_map(recorded, workers);
      SceneJob job = recorded;
      job.uniforms.shadow_map.tiles = shadow_ ? &shadow_->tiles() : nullptr;
      const std::span<const std::size_t> order(job.view.order);
      const std::size_t near = near_objects(*scene_, job.view);
      Pass pass = canvas_.pass();
      for (const std::size_t i : order.first(near)) draw(pass, job, scene_->objects[i]);
      statistics_ = pass.run(workers);
      if (near == order.size()) continue;
      const DepthPyramid pyramid(canvas_.depth_target(), workers);
      job.hidden_by = &pyramid;
      Pass second = canvas_.pass_over();
      for (const std::size_t i : order.subspan(near)) draw(second, job, scene_->objects[i]);
      statistics_ += second.run(workers);
    }
  }

  WorkloadPicture picture() const override { return canvas_.picture(); }
  // Blended surfaces read the map, too, but do not write depth and are not counted.
  std::optional<ShadowMapUse> shadow_map_use(const Workers& workers) const override {
    if (shadow_) shadow_->draw_all(workers);
    const SceneJob& job = jobs_.back();
    Canvas lit({canvas_.picture().color->width(), canvas_.picture().color->height()});
    Pass pass = lit.pass();
    for (const std::size_t i : job.view.order) {
      const SceneObject& object = scene_->objects[i];
      if (scene_->material(object).surface <= SceneSurface::cutout) draw(pass, job, object);
    }
    pass.run(workers);
    return halfspace::shadow_map_use(*lit.picture().depth, glm::dmat4(job.view.clip_from_world), glm::dmat4(job.view.light_from_world),
                                     map_);
  }
  std::optional<GeometryUse> geometry_use() const override {
    GeometryUse use{.triangles = statistics_.primitives_in,
                    .skipped_triangles = statistics_.culled_cluster,
                    .shaded_vertices = statistics_.vertices_shaded,
                    .binned_triangles = statistics_.triangles_binned};
    for (const std::size_t i : jobs_.back().view.order) use.vertices += meshes_[scene_->objects[i].mesh].used_count();
    return use;
  }
  bool has_truth() const override { return false; }
  WorkloadTruth truth() const override { return canvas_.truth(); }  // not called, because has_truth() is false

 private:
  void draw_shadow_map(const SceneJob& job, const Workers& workers) {
    shadow_.reset();  // so that the next pass can use its memory
    Pass pass(kShadowMapSize, kShadowMapSize, ColorTarget{}, d32f_target(map_));
    for (const std::size_t i : job.view.casters) draw_scene_depth(pass, job, scene_->objects[i]);
    // A map that many views read is drawn at once, so that no view has to ask for its tiles.
    if (keeps_map_) {
      pass.run(workers);
    } else {
      shadow_.emplace(std::move(pass), workers);
    }
  }
  void draw(Pass& pass, const SceneJob& job, const SceneObject& object) const {
    switch (scene_->material(object).surface) {
      case SceneSurface::opaque: return draw_scene_opaque(pass, job, object);
      case SceneSurface::cutout: return draw_scene_cutout(pass, job, object);
      case SceneSurface::unlit: return draw_scene_unlit(pass, job, object);
      case SceneSurface::blended: return draw_scene_blended(pass, job, object);
    }
  }

  std::shared_ptr<const Scene> scene_;
  bool keeps_map_;
  std::vector<SceneView> views_;
  std::vector<Indices> meshes_;
  std::vector<std::optional<Clusters>> clusters_;  // one per mesh
  std::vector<SceneJob> jobs_;                     // one per view
  Image<float> map_;
  std::optional<DepthOnDemand> shadow_;  // draws the tiles of map_; empty if all views share the map
  Canvas canvas_;
  PassStatistics statistics_;  // of the last picture, without its shadow map
};

std::vector<WorkloadKind> workloads_of(std::span<const SceneRow> rows) {
  std::vector<WorkloadKind> all;
  for (const SceneRow& row : rows) {
    all.push_back({row.name, row.what, [&row](WorkloadSize size, WorkloadAssets& assets) {
                     return std::make_unique<SceneWorkload>(shared_scene(assets, row.kind), row, size);
                   }});
  }
  return all;
}

}  // namespace

std::span<const WorkloadKind> scene_workloads() {
  static const std::vector<WorkloadKind> kinds = workloads_of(scene_rows());
  return kinds;
}

std::span<const WorkloadKind> view_workloads() {
  static const std::vector<WorkloadKind> kinds = workloads_of(view_rows());
  return kinds;
}

}  // namespace halfspace
