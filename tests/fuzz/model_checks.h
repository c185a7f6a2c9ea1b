// SPDX-License-Identifier: Apache-2.0
//
// Invariants of every model that a reader returns, whatever its file contains, and of the views of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string_view>

#include "halfspace/core/check.h"
#include "halfspace/model/model.h"
#include "halfspace/model/pose/pose.h"
#include "halfspace/render/model_file/frame_model.h"

namespace halfspace {

/// Checks that all indices of the mesh are in range and that its lists have one entry per vertex.
inline void check_mesh(const ModelMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  for (const uint32_t index : mesh.indices) HS_CHECK_OP(index, <, count);
  const auto check_list = [&](std::size_t size) { HS_CHECK(size == 0 || size == count); };
  for (const auto& uvs : mesh.uvs) check_list(uvs.size());
  for (const std::size_t size : {mesh.normals.size(), mesh.tangents.size(), mesh.colors.size(), mesh.joints.size(), mesh.weights.size()}) {
    check_list(size);
  }
  if (mesh.topology == MeshTopology::triangles) HS_CHECK_OP(mesh.indices.size() % 3, ==, 0u);
}

/// Checks that the factors of a material are finite and that its textures exist.
inline void check_material(const ModelMaterial& m, const Model& model) {
  for (const float x : {m.base_color.x,     m.base_color.y,  m.base_color.z,       m.base_color.w,        m.alpha_cutoff,
                        m.metallic,         m.roughness,     m.specular,           m.specular_color.x,    m.specular_color.y,
                        m.specular_color.z, m.ior,           m.clearcoat,          m.clearcoat_roughness, m.clearcoat_normal_scale,
                        m.normal_scale,     m.bump_scale,    m.occlusion_strength, m.emissive.x,          m.emissive.y,
                        m.emissive.z,       m.sheen_color.x, m.sheen_color.y,      m.sheen_color.z}) {
    HS_CHECK(std::isfinite(x));
  }
  for (const float x : {m.base_color.w, m.metallic, m.roughness, m.clearcoat, m.clearcoat_roughness, m.sheen, m.sheen_roughness})
    HS_CHECK(x >= 0.0f && x <= 1.0f);
  for (const auto map : kTextureUses) {
    const TextureUse& use = m.*map;
    HS_CHECK(use.texture >= -1 && use.texture < static_cast<int>(model.textures.size()));
    HS_CHECK(use.uv_set == 0 || use.uv_set == 1);
  }
}

inline void check_model(const Model& model) {
  for (const ModelMesh& mesh : model.meshes) check_mesh(mesh);
  for (const ModelMaterial& material : model.materials) check_material(material, model);
  for (const ModelTexture& texture : model.textures) HS_CHECK(texture.image >= -1 && texture.image < static_cast<int>(model.images.size()));
  for (const std::string& warning : model.warnings) HS_CHECK(warning.find('\n') == std::string_view::npos);
}

/// A small file can place a mesh many times. Above this number of placed vertices, visiting all of them with sanitizers, for every pose,
/// would take longer than a fuzz target may.
inline constexpr std::size_t kMaxVisitedVertices = std::size_t{1} << 18;

inline std::size_t placed_vertices(const Model& model, const PosedModel& posed) {
  std::size_t count = 0;
  for (const PosedMesh& mesh : posed.meshes) count += model.meshes[static_cast<std::size_t>(mesh.mesh)].positions.size();
  return count;
}

/// Fits the camera to a posed model, also for a camera that goes around it.
inline void check_fitted_view(const ModelPoses& poses) {
  const ModelBounds bounds = bounds_of(poses, "a");
  for (const double seconds : {0.0, 1.0}) {
    ModelView view;
    view.turn_seconds = seconds;
    const FramedView fitted = frame_model(poses, bounds, view);
    for (int i = 0; i < 3; ++i) HS_CHECK(std::isfinite(fitted.eye[i]) && std::isfinite(fitted.target[i]));
  }
}

/// Poses the model without animation, in every scene and with every variant and animation, but with at most four of each. Shows poses with
/// few vertices by a fitted camera, as `halfspace render` does.
inline void check_poses(const Model& model) {
  const auto last = [](std::size_t count) { return static_cast<int>(std::min<std::size_t>(count, 4)); };
  const auto use = [&](PoseOptions options) {
    options.bounds = false;
    const PosedModel posed = pose(model, options);
    for (const PosedMesh& mesh : posed.meshes) {
      if (mesh.deformed != nullptr) check_mesh(*mesh.deformed);
    }
    if (placed_vertices(model, posed) > kMaxVisitedVertices) return;
    options.bounds = true;
    const ModelPoses poses(model, options, {options.time});
    for (int i = 0; i < 3; ++i) HS_CHECK(!std::isnan(poses.first().low[i]) && !std::isnan(poses.first().high[i]));
    check_fitted_view(poses);
  };
  use({});
  for (int i = 0; i < last(model.scenes.size()); ++i) use({.scene = i});
  for (int i = 0; i < last(model.variants.size()); ++i) use({.variant = i});
  for (int i = 0; i < last(model.animations.size()); ++i) {
    for (const double time : {0.0, 0.3, 1e6}) use({.animation = i, .time = time});
  }
}

/// Calls f(). An InputError is accepted if its message is one line; other exceptions are not caught.
template <class F>
void accept_input_error(F&& f) {
  try {
    f();
  } catch (const InputError& e) {
    HS_CHECK(std::string_view(e.what()).find('\n') == std::string_view::npos);
  }
}

}  // namespace halfspace
