// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/model_bumps.h"

#include <algorithm>
#include <cmath>

#include "halfspace/core/resource_limits.h"
#include "halfspace/geometry/height_slopes.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_samples.h"

namespace halfspace::HS_LANES {

namespace {

// A normal map whose slopes are those of the heights, divided by `steepest`.
struct ModelBumps {
  Texture2D map;
  float steepest;
};

ModelBumps bumps_of(const Image<float>& heights, const Sampler& sampler) {
  constexpr float kFlat = 1e-6f;
  Image<glm::vec4> normals = height_slopes(heights, sampler.wrap_s, sampler.wrap_t);
  float steepest = kFlat;
  for (const glm::vec4& slope : normals.texels()) steepest = std::max({steepest, std::fabs(slope.x), std::fabs(slope.y)});
  std::transform(normals.data(), normals.data() + normals.texels().size(), normals.data(), [&](const glm::vec4& slope) {
    const glm::vec3 normal(-slope.x / steepest, slope.y / steepest, 1.0f);  // green is up, v points down
    return glm::vec4(normal / std::sqrt(glm::dot(normal, normal)) * 0.5f + 0.5f, 1.0f);
  });
  return {Texture2D(normals, TexelFormat::rgba16f), steepest};
}

// Returns the first channel of an image.
Image<float> heights_of(const ModelImage& image) {
  if (image.pixels != nullptr) return to_numbers(first_channel(*image.pixels), image.name);
  return image.bytes != nullptr ? read_gray(*image.bytes, image.name) : read_gray(image.file);
}

// Returns the size of the unit square of texture coordinates on a mesh, in model units: the mean over all triangles.
double uv_size(const ModelMesh& mesh, int set) {
  const std::vector<glm::vec2>& uvs = mesh.uvs[static_cast<std::size_t>(set)];
  double area = 0.0, uv_area = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    const glm::dvec3 side(mesh.positions[b] - mesh.positions[a]), other(mesh.positions[c] - mesh.positions[a]);
    const glm::dvec2 u(uvs[b] - uvs[a]), v(uvs[c] - uvs[a]);
    area += glm::length(glm::cross(side, other));
    uv_area += std::fabs(u.x * v.y - u.y * v.x);
  }
  return uv_area > 0.0 ? std::sqrt(area / uv_area) : 0.0;
}

}  // namespace

// The slopes depend on the size of the texture on the surface, which can differ at every point. The mean over the mesh is used instead.
void add_bumps(MetallicMaterial& surface, const ObjectDescription& o, const Model& model, int mesh, const ModelMaterial& material,
               UsedAssets& used, Warnings& warnings) {
  const TextureUse& use = material.bump_map;
  const ModelMesh& m = model.meshes[static_cast<std::size_t>(mesh)];
  const ModelTexture& texture = model.textures[static_cast<std::size_t>(use.texture)];
  if (texture.image < 0 || m.uvs[static_cast<std::size_t>(use.uv_set)].empty()) return;
  const ModelImage& image = model.images[static_cast<std::size_t>(texture.image)];
  if (!image.has_content()) return;
  const std::string file = o.file.path.string();
  const double size = *used.asset<double>(recipe("model uv size", file, mesh, use.uv_set), [&] { return uv_size(m, use.uv_set); });
  const glm::vec2 u = use.uv_transform[0], v = use.uv_transform[1];
  const double map_scale = std::sqrt(std::fabs(double{u.x} * v.y - double{u.y} * v.x));
  if (size == 0.0) return;
  try {
    const Sampler& sampler = texture.sampler;
    const auto bumps = used.asset<ModelBumps>(
        recipe("model bumps", file, texture.image, static_cast<int>(sampler.wrap_s), static_cast<int>(sampler.wrap_t)),
        [&] { return bumps_of(heights_of(image), sampler); });
    MaterialMap& map = surface.maps[kNormalMap];
    map.map = &bumps->map;
    map.sampler = sampler;
    map.uv_set = use.uv_set;
    map.uv_transform = use.uv_transform;
    surface.normal_scale = static_cast<float>(static_cast<double>(material.bump_scale * bumps->steepest) * map_scale / size);
  } catch (const LimitError&) {
    throw;
  } catch (const InputError& e) {  // drawn without it
    warnings.warn_once(file + ": " + e.what());
  }
}

}  // namespace halfspace::HS_LANES
