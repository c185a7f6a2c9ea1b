// SPDX-License-Identifier: Apache-2.0
#include "halfspace/reference/shadow_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "halfspace/core/trig_double.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/shadow/shadow_views.h"
#include "halfspace/scene/lights.h"
#include "halfspace/shading/shadow/shadow_bias.h"
#include "halfspace/shading/shadow/terminator.h"

namespace halfspace::HS_LANES {

namespace {

enum class PixelKind : uint8_t { nothing, sides_differ, compared };

struct Pixels {
  Image<PixelKind> kind;
  Image<std::optional<RayHit>> hits;
  Image<float> shading_l;  // cosine of the angle between shading normal and light, where only the shading normal faces the light
};

// Returns the normals that the surfaces are lit with, and zero vectors where the frame does not show the mesh that the rays hit.
Image<glm::vec3> shading_normals(const PreparedScene& scene, const Image<std::optional<RayHit>>& hits, const Workers& workers) {
  Image<glm::vec3> normals(hits.width(), hits.height());
  Image<uint32_t> objects(hits.width(), hits.height());
  FrameImages images;
  images.normal = &normals;
  images.object = &objects;
  render_frame(scene, images, workers);
  for (int y = 0; y < hits.height(); ++y) {
    for (int x = 0; x < hits.width(); ++x) {
      const std::optional<RayHit>& hit = hits.at(x, y);
      if (!hit || static_cast<uint32_t>(scene.meshes[static_cast<std::size_t>(hit->mesh)].object) != objects.at(x, y))
        normals.at(x, y) = glm::vec3(0.0f);
    }
  }
  return normals;
}

// A point of the smooth surface above a triangle.
struct SmoothPoint {
  glm::dvec3 position_rws, normal_ws;
};

// to_eye: 1 if the eye is on the side of the triangle from which it is counter-clockwise, otherwise −1.
SmoothPoint smooth_point(const PlacedMesh& mesh, const RayHit& hit, const glm::dvec3& eye_ws, double to_eye) {
  const double side = mesh.mirrored() ? -to_eye : to_eye;
  const glm::dmat3 normal_from_object = glm::transpose(glm::inverse(glm::dmat3(mesh.world_from_object)));
  std::array<vec3<double>, 3> p, n;
  glm::dvec3 normal(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const uint32_t vertex = (*mesh.indices)[3 * std::size_t{hit.triangle} + k];
    const glm::dvec3 unit = side * unit_or_zero(normal_from_object * glm::dvec3(mesh.normals[vertex]));
    p[k] = vec3<double>(glm::dvec3(mesh.world_from_object * glm::dvec4(glm::dvec3(mesh.positions[vertex]), 1.0)) - eye_ws);
    n[k] = vec3<double>(unit);
    normal += hit.weights[k] * unit;
  }
  normal = unit_or_zero(normal);
  return {hit.position_rws + normal * smooth_height(p, n, hit.weights), normal};
}

// Returns the world-space width of a shadow map texel at a position, in the view that a lookup at that position would use.
double texel_at(const Shadow& shadow, const glm::dvec3& position_rws) {
  for (const ShadowView& view : shadow.views) {
    const ShadowCoordinates<float> p = shadow_coordinates(view, vec3<float>(glm::vec3(position_rws)));
    if (holds(view, p, filter_reach(shadow.settings))) return static_cast<double>(view.texel_per_w * p.w);
  }
  return 0.0;
}

// Measures the distance, in the plane perpendicular to the light, from a point to the nearest change as seen from the light: the end of the
// surface, or a transition between lit and shadowed. The result is in texels beyond the filter radius, rounded up to the next step, or 1e9
// if nothing changes within the last step.
class EdgeFinder {
 public:
  EdgeFinder(const RayScene& rays, const RayScene& casters, const RayLight& light) : rays_(rays), casters_(casters), light_(light) {}

  double distance(const RayHit& hit, const glm::dvec3& face_normal_ws, bool lit, double texel, double radius) const {
    const bool distant = kind_of(light_.light.type).is_distant;
    const glm::dvec3 axis =
        distant ? glm::dvec3(light_.light.position_rws) : unit_or_zero(glm::dvec3(light_.light.position_rws) - hit.position_rws);
    const glm::dvec3 right = unit_or_zero(glm::cross(std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), axis));
    const glm::dvec3 up = glm::cross(axis, right);
    const double lean = glm::dot(face_normal_ws, axis);
    for (const double step : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0}) {
      const double r = (radius + step) * texel;
      for (int k = 0; k < 16; ++k) {
        const SinCosDouble a = sincos_turns(k / 16.0);
        const glm::dvec3 aside = (right * a.cos + up * a.sin) * r;
        // Assume that the surface continues in its plane, and accept a deviation of twice the distance.
        const double along = std::abs(lean) > 1e-3 ? -glm::dot(face_normal_ws, aside) / lean : 0.0;
        const glm::dvec3 start = hit.position_rws + aside + axis * (along + 2.0 * r);
        const auto there = rays_.nearest(glm::vec3(start), glm::vec3(-axis), 0.0f, static_cast<float>(4.0 * r));
        if (!there) return step;
        if ((light_truth(casters_, light_, there->position_rws, there->face_normal_ws, 0).share > 0.5f) != lit) return step;
      }
    }
    return 1e9;
  }

 private:
  const RayScene& rays_;
  const RayScene& casters_;
  RayLight light_;
};

// Returns true if two adjacent pixels show the same surface without a step between them.
bool is_continuous(const RayHit& a, const RayHit& b) {
  if (a.mesh != b.mesh) return false;
  const glm::dvec3 way = b.position_rws - a.position_rws;
  const double length = glm::length(way);
  return std::abs(glm::dot(way, a.face_normal_ws)) <= 0.3 * length && std::abs(glm::dot(way, b.face_normal_ws)) <= 0.3 * length;
}

// Returns the pixels at which light crosses 1/2 between the pixel and its right or lower neighbor on the same surface.
std::vector<glm::ivec2> edge_pixels(const Image<float>& light, const Pixels& pixels) {
  std::vector<glm::ivec2> edges;
  const auto differ = [&](int x, int y, int x1, int y1) {
    return pixels.kind.at(x1, y1) == PixelKind::compared && (light.at(x, y) > 0.5f) != (light.at(x1, y1) > 0.5f) &&
           is_continuous(*pixels.hits.at(x, y), *pixels.hits.at(x1, y1));
  };
  for (int y = 0; y + 1 < light.height(); ++y) {
    for (int x = 0; x + 1 < light.width(); ++x) {
      if (pixels.kind.at(x, y) == PixelKind::compared && (differ(x, y, x + 1, y) || differ(x, y, x, y + 1))) edges.emplace_back(x, y);
    }
  }
  return edges;
}

// Projects a texel along the light onto the surface at a hit. Returns the length of its longer side in the image, in pixels.
double texel_on_surface_px(const RayHit& hit, const Light& light, double texel, const View& view) {
  const glm::dvec3 axis = light_at<double>(light, hit.position_rws).l_ws;
  const glm::dvec3 sight = view.to_eye_ws == glm::dvec3(0.0) ? unit_or_zero(hit.position_rws) : -view.to_eye_ws;
  const double lean = std::max(std::abs(glm::dot(hit.face_normal_ws, axis)), 1e-3);
  const glm::dmat3 axes = light_axes(axis);
  double longest = 0.0;
  for (int side = 0; side < 2; ++side) {
    const glm::dvec3 along = axes[side] * texel, on_surface = along - axis * (glm::dot(hit.face_normal_ws, along) / lean);
    longest = std::max(longest, glm::length(glm::cross(on_surface, sight)));
  }
  return longest / pixel_width(view, hit.position_rws);
}

void add(DistanceShares& shares, double distance, double weight) {
  (distance <= 1.0 ? shares.within_1 : distance <= 3.0 ? shares.from_1_to_3 : shares.beyond_3) += weight;
}

void divide(DistanceShares& s, int64_t count) {
  for (double* share : {&s.within_1, &s.from_1_to_3, &s.beyond_3}) *share /= static_cast<double>(std::max<int64_t>(count, 1));
}

// Computes the fractions of wrong pixels. If there are more than kMaxCount, every n-th is examined and counts n times.
void score_false_pixels(ShadowComparison& c, const Pixels& pixels, const Shadow& shadow, const EdgeFinder& edges, const Workers& workers) {
  constexpr std::size_t kMaxCount = 4000;
  std::vector<glm::ivec2> wrong;
  for (int y = 0; y < c.map.height(); ++y) {
    for (int x = 0; x < c.map.width(); ++x) {
      if (pixels.kind.at(x, y) == PixelKind::compared && std::abs(c.map.at(x, y) - c.truth.at(x, y)) > 0.5f) wrong.emplace_back(x, y);
    }
  }
  const std::size_t stride = wrong.size() / kMaxCount + 1, count = (wrong.size() + stride - 1) / stride;
  std::vector<double> distances(count);
  // The reference for a PCSS shadow is also soft, so the filter width does not excuse errors above 1/2.
  const double radius = shadow.settings.filter == ShadowFilter::pcss ? 0.0 : static_cast<double>(filter_reach(shadow.settings)) - 0.5;
  workers.for_each(static_cast<int>(count), [&](int i) {
    const glm::ivec2 p = wrong[static_cast<std::size_t>(i) * stride];
    const RayHit& hit = *pixels.hits.at(p.x, p.y);
    const double texel = texel_at(shadow, hit.position_rws);
    distances[static_cast<std::size_t>(i)] =
        texel > 0.0 ? edges.distance(hit, hit.face_normal_ws, c.truth.at(p.x, p.y) > 0.5f, texel, radius) : 1e9;
  });
  for (std::size_t i = 0; i < count; ++i) {
    const glm::ivec2 p = wrong[i * stride];
    const auto weight = static_cast<double>(std::min(stride, wrong.size() - i * stride));
    add(c.truth.at(p.x, p.y) > 0.5f ? c.score.false_shadow : c.score.false_light, distances[i], weight);
  }
  divide(c.score.false_shadow, c.score.lit);
  divide(c.score.false_light, c.score.shadowed);
}

void score_sides(ShadowComparison& c, const Pixels& pixels) {
  SidesScore& s = c.score.sides;
  int64_t false_shadow = 0, false_light = 0;
  for (int y = 0; y < c.map.height(); ++y) {
    for (int x = 0; x < c.map.width(); ++x) {
      if (pixels.kind.at(x, y) != PixelKind::sides_differ || c.truth.at(x, y) < 0.0f) continue;
      const float error = c.map.at(x, y) - c.truth.at(x, y);
      ++(c.truth.at(x, y) > 0.5f ? s.lit : s.shadowed);
      false_shadow += error < -0.5f;
      false_light += error > 0.5f;
      s.error += static_cast<double>(std::abs(error) * pixels.shading_l.at(x, y));
    }
  }
  s.false_shadow = static_cast<double>(false_shadow) / static_cast<double>(std::max<int64_t>(1, s.lit));
  s.false_light = static_cast<double>(false_light) / static_cast<double>(std::max<int64_t>(1, s.shadowed));
  s.error /= static_cast<double>(std::max<int64_t>(1, s.lit + s.shadowed));
}

void score_means(ShadowComparison& c, const Pixels& pixels) {
  double penumbra_sum = 0.0, sum = 0.0;
  int64_t penumbra = 0, compared = 0, differ = 0;
  for (int y = 0; y < c.map.height(); ++y) {
    for (int x = 0; x < c.map.width(); ++x) {
      differ += pixels.kind.at(x, y) == PixelKind::sides_differ;
      if (pixels.kind.at(x, y) != PixelKind::compared) continue;
      ++compared;
      const auto truth = static_cast<double>(c.truth.at(x, y)), error = std::abs(static_cast<double>(c.map.at(x, y)) - truth);
      ++(truth > 0.5 ? c.score.lit : c.score.shadowed);
      sum += error;
      if (truth <= 0.0 || truth >= 1.0) continue;
      ++penumbra;
      penumbra_sum += error;
    }
  }
  score_sides(c, pixels);
  c.score.sides_differ = static_cast<double>(differ) / static_cast<double>(std::max<int64_t>(1, differ + compared));
  c.score.error = sum / static_cast<double>(std::max<int64_t>(1, compared));
  c.score.penumbra_error = penumbra_sum / static_cast<double>(std::max<int64_t>(1, penumbra));
}

double median_draw_ms(const LightChoice& light, const View& view, int width, int height, bool with_shadow, const Workers& workers) {
  std::array<double, 3> ms;
  for (double& m : ms) m = draw_shadow_picture(light, view, width, height, with_shadow, workers).draw_ms;
  std::ranges::sort(ms);
  return ms[1];
}

}  // namespace

ShadowComparison compare_shadow(const LightChoice& choice, const RayScene& rays, const RayScene& casters, int width, int height,
                                int rays_per_pixel, const Workers& workers) {
  const PreparedLight& light = choice.scene->lights[choice.index];
  const View& view = choice.scene->view;
  static const Shadow kNone;
  const Shadow& shadow = light.light.shadow == nullptr ? kNone : *light.light.shadow;
  const RayLight ray_light{light.light, static_cast<double>(shadow.settings.light_radius),
                           shadow.settings.light_radius > 0.0f ? rays_per_pixel : 1};
  ShadowComparison out{Image<float>(width, height), Image<float>(width, height), Image<float>(width, height), {}};
  Pixels pixels{Image<PixelKind>(width, height), primary_hits(rays, view, width, height, workers), Image<float>(width, height)};
  const Image<glm::vec3> normals = shading_normals(*choice.scene, pixels.hits, workers);
  const ShadowPicture picture = draw_shadow_picture(choice, view, width, height, true, workers, &normals);
  std::vector<float> errors(static_cast<std::size_t>(height));
  workers.for_each(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      out.map.at(x, y) = out.truth.at(x, y) = -1.0f;
      const glm::vec4& mask = picture.mask.at(x, y);
      const uint32_t seed = static_cast<uint32_t>(y) * static_cast<uint32_t>(width) + static_cast<uint32_t>(x);
      const std::optional<RayHit>& hit = pixels.hits.at(x, y);
      // At silhouettes, the rasterizer and the rays may show different surfaces. compare_visibility counts these pixels.
      if (!hit || static_cast<float>(hit->mesh + 1) != mask.z) continue;
      const PlacedMesh& mesh = choice.scene->meshes[static_cast<std::size_t>(hit->mesh)];
      if (!mesh.receives_shadow) continue;
      const IncidentLight<double> arriving = light_at<double>(light.light, hit->position_rws);
      const PictureRay ray = picture_ray(view, width, height, x + 0.5, y + 0.5);
      const double side = glm::dot(hit->face_normal_ws, glm::dvec3(ray.direction_ws)) < 0.0 ? 1.0 : -1.0;
      const double face_l = side * glm::dot(hit->face_normal_ws, glm::dvec3(arriving.l_ws));
      if ((face_l > 0.0) != (mask.y > 0.0f)) {
        pixels.kind.at(x, y) = PixelKind::sides_differ;
        if (mask.y <= 0.0f) continue;
        const SmoothPoint smooth = smooth_point(mesh, *hit, view.eye_ws, side);
        const bool away = glm::dot(smooth.normal_ws, glm::dvec3(arriving.l_ws)) <= 0.0;
        out.truth.at(x, y) = away ? 0.0f : light_truth(casters, ray_light, smooth.position_rws, smooth.normal_ws, seed).share;
        out.map.at(x, y) = mask.x;
        pixels.shading_l.at(x, y) = mask.y;
        continue;
      }
      pixels.kind.at(x, y) = PixelKind::compared;
      out.map.at(x, y) = out.truth.at(x, y) = 0.0f;
      if (face_l <= 0.0) continue;
      out.facing.at(x, y) = static_cast<float>(face_l);
      const LightTruth truth = light_truth(casters, ray_light, hit->position_rws, hit->face_normal_ws, seed);
      out.truth.at(x, y) = truth.share;
      out.map.at(x, y) = mask.x;
      errors[static_cast<std::size_t>(y)] = std::max(errors[static_cast<std::size_t>(y)], truth.standard_error);
    }
  });
  ShadowScore& s = out.score;
  s.light = light.name;
  s.truth_error = static_cast<double>(*std::ranges::max_element(errors));
  score_means(out, pixels);
  score_false_pixels(out, pixels, shadow, EdgeFinder(rays, casters, {ray_light.light, 0.0, 1}), workers);
  const std::vector<glm::ivec2> edges = edge_pixels(out.map, pixels);
  const std::vector<double> distances = edge_distances(edges, edge_pixels(out.truth, pixels), width, height);
  s.edge_px = summary_of(distances);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const RayHit& hit = *pixels.hits.at(edges[i].x, edges[i].y);
    const double texel_px = texel_on_surface_px(hit, light.light, texel_at(shadow, hit.position_rws), view);
    if (texel_px > 0.0) s.edge_texels += distances[i] / texel_px / static_cast<double>(distances.size());
  }
  s.map_ms = light.map_ms;
  s.lookup_ms = std::max(
      0.0, median_draw_ms(choice, view, width, height, true, workers) - median_draw_ms(choice, view, width, height, false, workers));
  return out;
}

}  // namespace halfspace::HS_LANES
