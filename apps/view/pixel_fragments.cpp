// SPDX-License-Identifier: Apache-2.0
#include "view/pixel_fragments.h"

#include <fmt/format.h>

#include <utility>

#include "halfspace/render/frame.h"

namespace halfspace {

namespace {

// One pixel of the images that identify a surface.
struct PixelValues {
  Image<float> depth{1, 1};
  Image<uint32_t> object{1, 1}, instance{1, 1}, triangle{1, 1};
  Image<glm::vec3> normal{1, 1}, albedo{1, 1};
};

PixelValues values_at(const PreparedScene& scene, const glm::ivec2& pixel, const Workers& workers) {
  PixelValues v;
  render_frame(scene,
               {.depth = &v.depth,
                .normal = &v.normal,
                .albedo = &v.albedo,
                .object = &v.object,
                .instance = &v.instance,
                .triangle = &v.triangle,
                .crop = ImageRect{pixel.x, pixel.y, 1, 1}},
               workers);
  return v;
}

std::string object_name(const SceneDescription& description, uint32_t object) {
  const std::size_t objects = description.objects.size();
  if (object < objects) return description.objects[object].first;
  if (object == objects) return "particles";
  return description.particle_systems[object - objects - 1].first;
}

}  // namespace

std::string PixelFragments::visible_object() const {
  for (const PixelFragment& f : fragments) {
    if (f.visible) return f.object;
  }
  return {};
}

PixelFragments pixel_fragments(PreparedScene& scene, const SceneDescription& description, const Image<glm::u8vec4>& picture,
                               const glm::ivec2& pixel, const Workers& workers) {
  PixelFragments result{pixel, picture.at(pixel.x, pixel.y), {}};
  std::vector<PreparedDraw> draws = std::exchange(scene.draws, {});
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    if (draws[i].source.object < 0) continue;
    scene.draws.push_back(std::move(draws[i]));
    const PixelValues v = values_at(scene, pixel, workers);
    draws[i] = std::move(scene.draws.back());
    scene.draws.clear();
    if (v.object.at(0, 0) == kNoId) continue;
    const float depth = v.depth.at(0, 0);
    if (result.fragments.empty() || depth < result.fragments[nearest].depth) nearest = result.fragments.size();
    result.fragments.push_back({i, object_name(description, v.object.at(0, 0)), v.instance.at(0, 0), v.triangle.at(0, 0), depth, false,
                                v.normal.at(0, 0), v.albedo.at(0, 0)});
  }
  scene.draws = std::move(draws);
  if (!result.fragments.empty()) result.fragments[nearest].visible = true;
  return result;
}

std::vector<std::string> lines_of(const PixelFragments& p) {
  std::vector<std::string> lines{fmt::format("pixel {},{}: #{:02x}{:02x}{:02x}", p.pixel.x, p.pixel.y, p.color.x, p.color.y, p.color.z)};
  for (const PixelFragment& f : p.fragments) {
    lines.push_back(fmt::format("draw {}: {} (part {}), triangle {}", f.draw, f.object, f.instance, f.triangle));
    lines.push_back(fmt::format("  depth {:.6g}: {}", f.depth, f.visible ? "visible" : "hidden"));
    lines.push_back(fmt::format("  normal {:.3f} {:.3f} {:.3f}, albedo {:.3f} {:.3f} {:.3f}", f.normal_ws.x, f.normal_ws.y, f.normal_ws.z,
                                f.albedo.x, f.albedo.y, f.albedo.z));
  }
  if (p.fragments.empty()) lines.emplace_back("no opaque surface: background or blended surfaces");
  return lines;
}

}  // namespace halfspace
