// SPDX-License-Identifier: Apache-2.0
#include "peers/gl/gl_scenes.h"

#include <fmt/format.h>

#include "peers/gl/gl_scene_glsl.h"
#include "peers/gl/gl_state.h"
#include "peers/gl/gl_workload.h"
#include "peers/gl/glsl_light.h"
#include "scenes/scene.h"
#include "workloads/workload_shadow.h"

namespace halfspace {

namespace {

// Returns the functions that shaders of lit surfaces call.
std::string shading() {
  return fmt::format("#define BIAS {:.9f}\n#define NORMAL_OFFSET {:.9f}\n{}{}{}", kSceneBias, kSceneNormalOffset, kGlslLight, kGlslShadow,
                     kSceneShading);
}

// A program that draws objects, and the locations of the uniforms that differ between them.
class ObjectProgram {
 public:
  ObjectProgram(const std::string& fragment, const Scene& scene, bool is_lit)
      : program_("", kSceneVertex, fragment),
        world_from_object_(program_.location("world_from_object")),
        tint_(program_.location("tint")),
        is_lit_(is_lit) {
    program_.set("map", 0);
    if (!is_lit) return;
    const SceneLighting& light = scene.light;
    program_.set("shadow_map", 1);
    program_.set("to_sun", light.to_sun);
    program_.set("sun", light.sun);
    program_.set("sky", light.sky);
    program_.set("ground", light.ground);
    program_.set("lamp_ws", light.lamp_ws);
    program_.set("lamp", light.lamp);
    program_.set("haze", light.haze);
    program_.set("haze_distance", light.haze_distance);
    gloss_ = program_.location("gloss");
  }

  void use() const { program_.use(); }
  void set_view(const SceneView& view) {
    program_.set("clip_from_world", view.clip_from_world);
    if (!is_lit_) return;
    program_.set("light_from_world", view.light_from_world);
    program_.set("eye_ws", view.eye_ws);
  }
  void set_material(const SceneMaterial& material) {
    glUniform3fv(tint_, 1, &material.tint[0]);
    if (is_lit_) glUniform1f(gloss_, material.gloss);
    if (material.surface == SceneSurface::blended) program_.set("alpha", material.alpha);
  }
  void set_transform(const glm::mat4& world_from_object) const {
    glUniformMatrix4fv(world_from_object_, 1, GL_FALSE, &world_from_object[0][0]);
  }

 private:
  GlProgram program_;
  GLint world_from_object_, tint_, gloss_ = -1;
  bool is_lit_;
};

class GlScene final : public GlWorkload {
 public:
  GlScene(const GlInput& in, const SceneRow& row)
      : GlWorkload(in),
        scene_(shared_scene(in.assets, row.kind)),
        keeps_map_(row.keeps_map),
        views_(scene_views(*scene_, row, in.size)),
        map_({kShadowMapSize, kShadowMapSize}, 0, true),
        mesh_(floats_of(std::span<const SceneVertex>(scene_->vertices)), {3, 3, 2}, scene_->indices),
        programs_{{{shading() + std::string(kSceneOpaque), *scene_, true},
                   {shading() + std::string(kSceneCutout), *scene_, true},
                   {std::string(kSceneUnlit), *scene_, false},
                   {shading() + std::string(kSceneBlended), *scene_, true}}} {
    for (const auto& texels : scene_->textures) textures_.push_back(std::make_unique<GlTexture>(*texels, Sampler{}));
    if (views_.size() == 1) set_view(views_[0]);
  }

  bool has_truth() const override { return false; }  // the picture is compared with Halfspace's
  std::unique_ptr<Workload> twin() const override { return make_twin(); }

 private:
  void draw() override {
    for (const SceneView& view : views_) {
      if (views_.size() > 1) set_view(view);
      if (!keeps_map_ || &view == &views_.front()) draw_shadow_map(view);
      draw_picture(view);
    }
  }

  void set_view(const SceneView& view) {
    for (ObjectProgram& program : programs_) program.set_view(view);
  }

  void draw_picture(const SceneView& view) {
    begin();
    glActiveTexture(GL_TEXTURE1);
    map_.bind_depth();
    glActiveTexture(GL_TEXTURE0);
    const SceneMaterial* current = nullptr;
    for (const std::size_t i : view.order) {
      const SceneObject& object = scene_->objects[i];
      const SceneMaterial& material = scene_->material(object);
      ObjectProgram& program = programs_[static_cast<std::size_t>(material.surface)];
      if (current != &material) set_material(program, material);
      current = &material;
      program.set_transform(glm::mat4(object.world_from_object));
      draw_mesh(object);
    }
  }

  void draw_shadow_map(const SceneView& view) {
    map_.bind();
    map_.clear(glm::vec4(0));
    set_gl_state(scene_shadow_state(), true);
    const SceneMaterial* current = nullptr;
    GLint location = -1;
    for (const std::size_t i : view.casters) {
      const SceneObject& object = scene_->objects[i];
      const SceneMaterial& material = scene_->material(object);
      if (current != &material) {
        const GlProgram& program = material.surface == SceneSurface::cutout ? cutout_depth_ : depth_;
        location = program.location("clip_from_object");
        textures_[material.texture]->bind();
        current = &material;
      }
      const glm::mat4 clip_from_object = view.light_from_world * glm::mat4(object.world_from_object);
      glUniformMatrix4fv(location, 1, GL_FALSE, &clip_from_object[0][0]);
      draw_mesh(object);
    }
  }

  void set_material(ObjectProgram& program, const SceneMaterial& material) const {
    program.use();
    program.set_material(material);
    textures_[material.texture]->bind();
    set_gl_state(scene_state(material), true);
  }

  void draw_mesh(const SceneObject& object) const {
    const SceneMesh& mesh = scene_->mesh(object);
    mesh_.draw_part(GL_TRIANGLES, mesh.first, mesh.count, 1);
  }

  std::shared_ptr<const Scene> scene_;
  bool keeps_map_;
  std::vector<SceneView> views_;
  GlTarget map_;
  GlMesh mesh_;
  std::array<ObjectProgram, 4> programs_;  // by surface
  GlProgram depth_{"", kSceneDepthVertex, kSceneDepth}, cutout_depth_{"", kSceneDepthVertex, kSceneCutoutDepth};
  std::vector<std::unique_ptr<GlTexture>> textures_;
};

std::vector<WorkloadKind> workloads_of(std::span<const SceneRow> rows, std::span<const WorkloadKind> twins) {
  std::vector<WorkloadKind> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const WorkloadKind& twin = twins[i];
    const SceneRow& row = rows[i];
    all.push_back({twin.name, twin.what, [&row, &twin](WorkloadSize size, WorkloadAssets& assets) {
                     return std::make_unique<GlScene>(GlInput{twin, size, assets}, row);
                   }});
  }
  return all;
}

}  // namespace

std::span<const WorkloadKind> gl_scene_workloads() {
  static const std::vector<WorkloadKind> kinds = workloads_of(scene_rows(), scene_workloads());
  return kinds;
}

std::span<const WorkloadKind> gl_view_workloads() {
  static const std::vector<WorkloadKind> kinds = workloads_of(view_rows(), view_workloads());
  return kinds;
}

}  // namespace halfspace
