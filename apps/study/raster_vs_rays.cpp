// SPDX-License-Identifier: Apache-2.0
//
// Compares the triangles that the rasterizer and Embree's rays find at each pixel, for meshes with different numbers of triangles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "halfspace/reference/pixel_truth.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "study/study.h"

namespace halfspace {

namespace {

constexpr const char* kMeshScene = R"({{
  "version": 1,
  "cameras": {{ "main": {{ "position": [0.3, 0.7, 3], "fov": 45, "near": 0.1, "far": 100 }} }},
  "lights": {{ "sun": {{ "direction": [1, 1, 1.5] }} }},
  "objects": {{ "ball": {{ "shape": "uv_sphere", "latitudes": {}, "longitudes": {}, "shading": "none" }} }}
}})";

// The nearest triangle at each pixel center, or −1. Computed in double from unsnapped vertices: a ray hits a triangle if it is on the
// inner side of the planes through the eye and each edge.
struct ExactTriangles {
  Image<int> triangle;
  double doubtful = 0.0;  // number of edge tests whose result may be due to rounding in double, divided by the number of pixels
};

ExactTriangles exact_triangles(const PreparedScene& scene, int width, int height) {
  const View& view = scene.view;
  const PlacedMesh& mesh = scene.meshes.front();
  const Indices& indices = *mesh.indices;
  ExactTriangles out{Image<int>(width, height), 0.0};
  Image<double> nearest(width, height);
  std::fill_n(out.triangle.data(), out.triangle.texels().size(), -1);
  std::fill_n(nearest.data(), nearest.texels().size(), std::numeric_limits<double>::infinity());
  // Eye space scaled so that the image plane at distance 1 spans [−1, 1]: the ray through NDC (x, y) has the direction (x, y, 1).
  const auto in_eye_space = [&](const glm::vec3& p_os) {
    const glm::dvec3 p = glm::dvec3(mesh.world_from_object * glm::dvec4(glm::dvec3(p_os), 1.0)) - view.eye_ws;
    return glm::dvec3(glm::dot(p, view.right_ws) / view.tan_x, glm::dot(p, view.up_ws) / view.tan_y, glm::dot(p, view.forward_ws));
  };
  std::vector<glm::dvec3> corners;
  for (const glm::vec3& p : mesh.positions) corners.push_back(in_eye_space(p));
  int64_t doubtful = 0;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    const glm::dvec3 &a = corners[indices[i]], &b = corners[indices[i + 1]], &c = corners[indices[i + 2]];
    const glm::dvec3 bc = glm::cross(b, c), ca = glm::cross(c, a), ab = glm::cross(a, b);
    const double volume = glm::dot(a, bc);
    if (volume == 0.0) continue;
    glm::dvec2 low(1e9), high(-1e9);
    for (const glm::dvec3& p : {a, b, c}) {
      const glm::dvec2 px((p.x / p.z + 1.0) * 0.5 * width, (1.0 - p.y / p.z) * 0.5 * height);
      low = glm::min(low, px);
      high = glm::max(high, px);
    }
    for (int y = std::max(0, static_cast<int>(low.y - 0.5)); y <= std::min(height - 1, static_cast<int>(high.y)); ++y) {
      for (int x = std::max(0, static_cast<int>(low.x - 0.5)); x <= std::min(width - 1, static_cast<int>(high.x)); ++x) {
        const glm::dvec3 ray(2.0 * (x + 0.5) / width - 1.0, 1.0 - 2.0 * (y + 0.5) / height, 1.0);
        const glm::dvec3 sides = glm::dvec3(glm::dot(ray, bc), glm::dot(ray, ca), glm::dot(ray, ab)) / volume;
        const double sum = sides.x + sides.y + sides.z, min_side = std::min({sides.x, sides.y, sides.z}) / std::abs(sum);
        doubtful += std::abs(min_side) < 1e-12;
        if (sum <= 0.0 || min_side < 0.0 || 1.0 / sum >= nearest.at(x, y)) continue;
        nearest.at(x, y) = 1.0 / sum;
        out.triangle.at(x, y) = static_cast<int>(i / 3);
      }
    }
  }
  out.doubtful = static_cast<double>(doubtful) / (static_cast<double>(width) * height);
  return out;
}

}  // namespace

Study study_raster_vs_rays(const StudyOptions& options, const Workers& workers) {
  const int width = options.quick ? 160 : 960, height = options.quick ? 90 : 540;
  const double pixels = static_cast<double>(width) * height;
  Study study{
      .name = "raster_vs_rays",
      .title = "Visible triangles: rasterizer and rays",
      .setting = fmt::format("A sphere without shading, {}x{}; labels give the number of latitude bands", width, height),
      .error_name = fmt::format("fraction of pixels that show the wrong triangle (zero is plotted at {:.0e})", 0.1 / pixels),
      .time_name = "frame",
      .truth = {"edge tests in double, without snapping", 0.1 / pixels, "a tenth of one pixel, as a fraction of all pixels"},
  };
  for (const int latitudes : options.quick ? std::vector{8, 64} : std::vector{8, 32, 128, 512, 1024}) {
    const SceneDescription description = SceneFile::parse(fmt::format(kMeshScene, latitudes, 2 * latitudes), "study", ".").description();
    SceneAssets assets(workers);
    const PreparedScene scene = assets.prepare(description, width, height);
    const ExactTriangles truth = exact_triangles(scene, width, height);
    study.truth.error = std::max(study.truth.error, truth.doubtful);
    const double triangles = static_cast<double>(scene.meshes.front().indices->size()) / 3.0;
    const auto add = [&](const std::string& group, const Timing& time, const auto& triangle_at) {
      int64_t wrong = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) wrong += triangle_at(x, y) != truth.triangle.at(x, y);
      study.variants.push_back({.name = fmt::format("{} {}", group, latitudes),
                                .group = group,
                                .parameters = {{"latitudes", static_cast<double>(latitudes)}, {"triangles", triangles}, {"pixels", pixels}},
                                .error = static_cast<double>(wrong) / pixels,
                                .time = time});
    };
    Image<glm::vec4> frame(width, height);
    const Timing raster = time_of([&] { render(scene, frame, workers); }, options);
    const ShadowPicture picture = draw_shadow_picture({&scene, 0}, scene.view, width, height, false, workers);
    add("rasterizer", raster,
        [&](int x, int y) { return picture.mask.at(x, y).z == 0.0f ? -1 : static_cast<int>(picture.mask.at(x, y).w); });
    Image<std::optional<RayHit>> hits;
    const auto by_rays = [&](const RayScene& rays) { hits = primary_hits(rays, scene.view, width, height, workers); };
    const auto hit_at = [&](int x, int y) { return hits.at(x, y) ? static_cast<int>(hits.at(x, y)->triangle) : -1; };
    const RayScene rays(scene.meshes, scene.view.eye_ws);
    const Timing traced = time_of([&] { by_rays(rays); }, options);
    add("rays", traced, hit_at);
    const Timing built = time_of([&] { by_rays(RayScene(scene.meshes, scene.view.eye_ws)); }, options);
    add("rays and tree", built, hit_at);
  }
  return study;
}

}  // namespace halfspace
