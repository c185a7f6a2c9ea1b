// SPDX-License-Identifier: Apache-2.0
//
// Constants are fitted to the measurements in docs/results/accuracy.md; nothing is timed.
#include "halfspace/render/error_budget/approximation_chooser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "halfspace/render/prepare/adaptive_meshes.h"
#include "halfspace/render/prepare/scene_particles.h"
#include "halfspace/render/prepare/scene_places.h"
#include "halfspace/scene/lights.h"
#include "halfspace/scene/object_keys.h"
#include "halfspace/scene/scene_check.h"
#include "halfspace/scene/shapes.h"
#include "halfspace/shading/values/tone.h"

namespace halfspace::HS_LANES {

namespace {

// With fewer bands, the vertex normals of a sphere are so far apart that interpolated normals are visibly wrong.
constexpr int kMinParts = 8;

// Measured on a textured, lit globe and compared with 1024 bands: the 99.9th percentile of the difference is 2, 8 and 33 8-bit steps at
// 128, 64 and 32 bands. It grows with the square of the angle between the normals at the ends of a quad's diagonal.
constexpr double kCodesPerSquaredAngle = 1700.0;

// Number of pixels per thousand that may show a different surface, so that edges do not determine the 99.9th percentile. (Of 208 random
// views with an allowed error of 8 steps, three exceeded the limit with 0.5, and two exceed it with this value. These two show bricks in
// relief at a grazing angle and have an error of 11 steps.)
constexpr double kEdgePixels = 0.35;

// With the bilinear filter, shadow edges are accurate to this many texels, except at grazing angles of the light. (With 0.5, 14 of
// 208 random views exceeded the allowed error, 2 of them by more than a factor of two. With this value, one did, by an eighth of a
// pixel.)
constexpr double kShadowEdgeTexels = 1.25;

// Cost of a vertex relative to the time that per-vertex lighting saves per pixel: about 10 ns versus 2.5 ns (docs/results/performance.md).
constexpr double kPixelsPerVertex = 4.0;

// From the study texture_filter: 99.9th percentile of the error in linear light at full contrast.
struct FilterError {
  int anisotropy;
  double linear;
};
constexpr std::array<FilterError, 4> kFilterErrors{{{1, 0.408}, {2, 0.314}, {4, 0.209}, {8, 0.111}}};
constexpr int kMaxAnisotropy = 16;

std::string rounded_text(double x) { return number_text(std::round(x * 1000.0) / 1000.0); }

// Returns the largest difference, in 8-bit steps, that a difference in linear light can cause. The sRGB curve is steepest at black.
double codes_of(double linear) {
  const glm::vec3 light(static_cast<float>(std::min(1.0, linear)));
  return 255.0 * static_cast<double>(encode_srgb(DisplayLight<float>{light}).rgb.x);
}

// Returns the allowed edge error if only a color error is given. Assumes that the total length of all edges is twice that of the image
// border.
double edge_for_color(const View& v) {
  const double pixels = static_cast<double>(v.width_px) * v.height_px;
  return kEdgePixels * 1e-3 * pixels / (4.0 * (v.width_px + v.height_px));
}

bool is_faceted(const ObjectDescription& o) {
  return o.surface.shading == ShadingRate::flat || o.surface.shading == ShadingRate::provoking;
}
bool is_ball(const ObjectDescription& o) { return kind_of(o).is_sphere_mesh && !is_map(o.height); }

// Returns true if shading uses more than the positions of the vertices. The mesh then affects the appearance of the object.
bool shades_by_vertex(const ObjectDescription& o) {
  if (o.surface.shading == ShadingRate::gouraud) return true;
  return is_map(o.height) && !(o.shape == Shape::uv_sphere && o.normals == NormalSource::pixel);
}

// Returns the maximum channel of the light that reaches a surface.
double max_light(const SceneDescription& scene) {
  glm::dvec3 sum(0.0);
  for (const auto& [name, l] : scene.lights) sum += l.color.linear * l.intensity * l.diffuse;
  return std::max({sum.x, sum.y, sum.z}) * (scene.post.hdr ? scene.post.exposure : 1.0);
}

// Returns true if the only lighting that varies over the surface is diffuse light from directional lights, which can be computed per
// vertex.
bool may_shade_by_vertex(const ObjectDescription& o, const SceneDescription& scene) {
  const SurfaceDescription& s = o.surface;
  const bool is_smooth = !is_map(o.height) && !is_map(s.normal_map) && !is_map(s.bump_map) && s.specular.linear == glm::dvec3(0.0) &&
                         s.reflection.linear == glm::dvec3(0.0);
  const bool is_shadowed = scene.shadow.method != ShadowMethod::none && o.receives_shadow;
  const bool is_metered = scene.post.hdr && scene.post.auto_exposure;
  return s.shading == ShadingRate::phong && is_smooth && !is_shadowed && !is_metered &&
         std::ranges::all_of(scene.lights, [](const auto& light) { return kind_of(light.second.type).is_distant; });
}

// The size and visibility of an object in the image.
struct Presence {
  double px_per_unit = 0.0;  // maximum; for units of object space
  double pixels = 0.0;       // covered by its bounding spheres, at most all pixels of the image
  bool is_seen = false;      // it is visible or may cast a visible shadow
};

Presence presence_of(const SceneDescription& scene, const ObjectDescription& o, const View& view, bool casts) {
  Presence p{.is_seen = casts};
  for (const glm::dmat4& world : places_of(scene, o)) {
    const double scale = std::max({glm::length(world[0]), glm::length(world[1]), glm::length(world[2])});
    const double reach = (kind_of(o).extent(o).radius + relief_height(o)) * scale;
    if (is_outside(view, glm::dvec3(world[3]), reach)) continue;
    p.is_seen = true;
    const double per_unit = (is_ball(o) ? silhouette_pixels_per_unit : pixels_per_unit)(view, glm::dvec3(world[3]), reach);
    p.px_per_unit = std::max(p.px_per_unit, scale * per_unit);
    p.pixels += std::numbers::pi * reach * reach * per_unit * per_unit;
  }
  p.pixels = std::min(p.pixels, static_cast<double>(view.width_px) * view.height_px);
  return p;
}

// With fewer vertices, a frame with a regular mesh takes no longer than one with an adaptive mesh (study adaptive_tessellation).
constexpr int64_t kMinAdaptiveVertices = 1 << 17;

// Returns true for a displaced sphere whose picture depends on its mesh only by the places of its points.
bool is_shaded_by_place(const ObjectDescription& o) {
  return o.shape == Shape::uv_sphere && is_map(o.height) && o.normals == NormalSource::pixel &&
         (o.surface.shading == ShadingRate::phong || o.surface.shading == ShadingRate::none);
}

// The meshes of a file are simplified when the scene is prepared.
ObjectDescription chosen_model(const ObjectDescription& authored, const std::string& path, double edge_px, std::optional<double> color,
                               std::vector<ApproximationChoice>& choices) {
  ObjectDescription o = authored;
  o.model_error = color || o.normal_lines > 0.0 ? 0.0 : edge_px;
  if (o.model_error != authored.model_error) {
    choices.push_back({path + ".model_error", number_text(o.model_error),
                       color                  ? "the colors of simplified meshes have no bound"
                       : o.normal_lines > 0.0 ? "each vertex has a line"
                                              : "meshes may be simplified within this error"});
  } else if (color) {
    choices.push_back({path + ".file", o.file.path.filename().string(),
                       "the meshes of a file are left unchanged, because the colors of simplified meshes have no bound", false});
  }
  return o;
}

}  // namespace

// `authored` must be an element of the scene's objects, because width_for finds it by its address.
ObjectDescription ApproximationChooser::chosen_object(const ObjectDescription& authored, const std::string& path, double edge_px,
                                                      std::optional<double> color, std::vector<ApproximationChoice>& choices) {
  if (authored.shape == Shape::file) return chosen_model(authored, path, edge_px, color, choices);
  if (is_faceted(authored) || authored.shape == Shape::sphere || authored.normal_lines > 0.0) return authored;
  if (is_ball(authored) && mesh_only_key(authored).empty() && has_uniformly_scaled_ancestors(scene_, authored)) {
    // A sprite takes 0.76 ms, a mesh 0.54 ms with 8 bands and 1.03 ms with 64 bands (study sphere_model).
    ObjectDescription sphere = authored;
    sphere.shape = Shape::sphere;
    sphere.mesh_error = 0.0;
    choices.push_back({path + ".shape", "sphere", "ray traced per pixel: exact, without a mesh"});
    return sphere;
  }
  const ShapeKind& kind = kind_of(authored);
  const Presence presence = presence_of(scene_, authored, view_, scene_.shadow.method != ShadowMethod::none && authored.casts_shadow);
  const std::shared_ptr<const ReliefDetail> detail = presence.is_seen ? maps_.relief_detail(authored, path + ".height") : nullptr;
  const auto off_px = [&](const ObjectDescription& o) {
    const double relief = detail == nullptr ? 0.0 : std::fabs(o.height_scale) * detail->error(kind.columns(o));
    return (chord_error(o) + relief) * presence.px_per_unit;
  };
  const auto is_enough = [&](const ObjectDescription& o) {
    const double angle = kind.diagonal_angle(o);
    return off_px(o) <= edge_px && (!color || kCodesPerSquaredAngle * angle * angle <= *color);
  };
  const bool has_curves = !kind.has_flat_faces || is_map(authored.height);
  int parts = has_curves ? kMinParts : 1;
  ObjectDescription o = with_parts(authored, parts, color.has_value());
  while (presence.is_seen && has_curves && parts < kind.max_parts && !is_enough(o)) {
    parts = std::min(part_step(parts + 1), kind.max_parts);
    o = with_parts(authored, parts, color.has_value());
  }
  const bool adapts = is_shaded_by_place(authored) && !color && presence.is_seen && kind.vertices(o) > kMinAdaptiveVertices &&
                      places_of(scene_, authored).size() <= kMaxAdaptiveCopies;
  if (adapts) {
    const std::string regular = fmt::format("the mesh adapts to the view; a regular one would have {} vertices", kind.vertices(o));
    o = authored;
    o.mesh_error = edge_px;
    if (o.mesh_error != authored.mesh_error) choices.push_back({path + ".mesh_error", number_text(edge_px), regular});
    return o;
  }
  if (shades_by_vertex(authored) && kind.columns(o) <= kind.columns(authored)) o = authored;
  o.mesh_error = 0.0;
  if (authored.mesh_error != 0.0)
    choices.push_back({path + ".mesh_error", "0", "a regular mesh takes no longer, or shading depends on it"});
  const std::string why = !presence.is_seen ? "not in the image"
                          : !has_curves     ? "its faces are flat"
                          : is_enough(o)    ? "at most " + rounded_text(off_px(o)) + " px off"
                                            : "the maximum: up to " + rounded_text(off_px(o)) + " px off";
  const auto tell = [&](const char* key, int from, int to) {
    if (from != to) choices.push_back({path + "." + key, std::to_string(to), why});
  };
  tell("latitudes", authored.latitudes, o.latitudes);
  tell("longitudes", authored.longitudes, o.longitudes);
  tell("level", authored.level, o.level);
  tell("segments", authored.segments, o.segments);
  // Linear interpolation of a cosine between two vertices has an error of at most an eighth of the squared angle.
  const double angle = kind.diagonal_angle(o), light_error = codes_of(max_light(scene_) * angle * angle / 8.0);
  if (color && may_shade_by_vertex(o, scene_) && light_error <= *color &&
      kPixelsPerVertex * static_cast<double>(kind.vertices(o)) <= presence.pixels) {
    o.surface.shading = ShadingRate::gouraud;
    choices.push_back({path + ".shading", "gouraud", "up to " + rounded_text(light_error) + " 8-bit steps off"});
  }
  return o;
}

namespace {

// The position of an edge is known to half the distance between samples.
void fit_samples(SceneHead& head, double edge_px, std::vector<ApproximationChoice>& choices) {
  int samples = 1;
  while (samples < 8 && 0.5 / std::sqrt(samples) > edge_px) samples *= 2;
  if (samples == head.samples) return;
  head.samples = samples;
  const double half = 0.5 / std::sqrt(samples);
  choices.push_back({"samples", std::to_string(samples),
                     "edges are accurate to " + rounded_text(half) + " px" + (half > edge_px ? ", the minimum" : "")});
}

bool compares(ShadowMethod m) { return m != ShadowMethod::none && m <= ShadowMethod::vogel; }

void fit_shadow(ShadowDescription& shadow, double edge_px, std::vector<ApproximationChoice>& choices) {
  if (shadow.method == ShadowMethod::none) return;
  if (compares(shadow.method) && shadow.method != ShadowMethod::bilinear) {
    shadow.method = ShadowMethod::bilinear;
    choices.push_back({"shadow.method", "bilinear", "the narrowest filter, whose edges are closest to the exact ones"});
  }
  shadow.resolution = 0;
  shadow.footprint = std::clamp(edge_px / kShadowEdgeTexels, 0.1, 100.0);
  const std::string why = fmt::format("fine enough for edges within {} px, at most {} texels",
                                      rounded_text(shadow.footprint * kShadowEdgeTexels), kMaxShadowTexels);
  choices.push_back({"shadow.resolution", "0", why});
  choices.push_back({"shadow.footprint", rounded_text(shadow.footprint), why});
}

// Returns the maximum distance in pixels between the circle of an original sprite and the ellipse of its sphere. Along the line through the
// image center, the ellipse extends from tan(θ − α) to tan(θ + α) with sin α = r/d. The circle extends by r/z on both sides of tan θ.
double original_error_px(const View& v, const Particles& particles) {
  if (v.to_eye_ws != glm::dvec3(0.0)) return 0.0;
  const double focal_px = 0.5 * v.height_px / v.tan_y;
  double worst = 0.0;
  for (std::size_t i = 0; i < particles.centers_ws.size(); ++i) {
    const glm::dvec3 from_eye = particles.centers_ws[i] - v.eye_ws;
    const double z = glm::dot(from_eye, v.forward_ws), squared = glm::dot(from_eye, from_eye), r = static_cast<double>(particles.radii[i]);
    if (z + r <= v.near || is_outside(v, particles.centers_ws[i], r)) continue;
    const double tan_center = std::sqrt(std::max(0.0, squared - z * z)) / z, tan_radius = r / std::sqrt(squared - r * r);
    if (z - r <= v.near || tan_center * tan_radius >= 1.0) return INFINITY;  // the projection is not an ellipse
    const double outer = (tan_center + tan_radius) / (1.0 - tan_center * tan_radius);
    worst = std::max(worst, focal_px * std::fabs(outer - tan_center - r / z));
  }
  return worst;
}

void fit_particles(ParticlesDescription& p, const std::string& path, double error_px, double edge_px,
                   std::vector<ApproximationChoice>& choices) {
  if (p.sprite == ParticleSprite::exact || error_px <= edge_px) return;
  p.sprite = ParticleSprite::exact;
  const std::string how_far = std::isfinite(error_px) ? "up to " + rounded_text(error_px) + " px" : std::string("arbitrarily far");
  choices.push_back({path + ".sprite", "exact", "circles are " + how_far + " off the spheres' ellipses"});
}

void fit_textures(Named<TextureDescription>& textures, double color, std::vector<ApproximationChoice>& choices) {
  const auto enough = std::ranges::find_if(kFilterErrors, [&](const FilterError& e) { return codes_of(e.linear) <= color; });
  const int anisotropy = enough == kFilterErrors.end() ? kMaxAnisotropy : enough->anisotropy;
  for (auto& [name, t] : textures) {
    if (t.filter != Filter::trilinear || t.anisotropy == anisotropy) continue;
    t.anisotropy = anisotropy;
    const std::string why =
        anisotropy == kMaxAnisotropy ? "the maximum" : "up to " + rounded_text(codes_of(enough->linear)) + " 8-bit steps";
    choices.push_back({"textures." + name + ".anisotropy", std::to_string(anisotropy), why});
  }
}

// Half floats have a relative error of at most 2^-11, which is less than 1/16 of an 8-bit step after sRGB encoding.
void fit_post(PostDescription& post, double color, std::vector<ApproximationChoice>& choices) {
  const LightFormat format = color >= 1.0 / 16.0 ? LightFormat::rgba16f : LightFormat::rgba32f;
  if (!post.hdr || post.format == format) return;
  post.format = format;
  choices.push_back(
      {"post.format", format == LightFormat::rgba16f ? "rgba16f" : "rgba32f", "half floats are accurate to 1/16 of an 8-bit step"});
}

}  // namespace

SceneWithinError ApproximationChooser::choose_within_error(const AllowedError& allowed) {
  SceneWithinError out{scene_, {}};
  SceneDescription& scene = out.scene;
  if (allowed.edge_px) fit_samples(scene.head, *allowed.edge_px, out.choices);
  const double edge_px = allowed.edge_px ? *allowed.edge_px : edge_for_color(view_);
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    const auto& [name, authored] = scene_.objects[i];
    if (authored.visible) scene.objects[i].second = chosen_object(authored, "objects." + name, edge_px, allowed.color, out.choices);
  }
  fit_shadow(scene.shadow, edge_px, out.choices);
  const auto fit_system = [&](ParticlesDescription& p, const std::string& path) {
    if (const auto spheres = scene_particles(p, path, used_))
      fit_particles(p, path, original_error_px(view_, *spheres), edge_px, out.choices);
  };
  fit_system(scene.particles, "particles");
  for (auto& [name, p] : scene.particle_systems) fit_system(p, "particle_systems." + name);
  if (allowed.color) {
    fit_textures(scene.textures, *allowed.color, out.choices);
    fit_post(scene.post, *allowed.color, out.choices);
  }
  check_mesh_limits(scene.objects, "the cheapest model");  // thousands of copies of a fine mesh may exceed the limit
  return out;
}

}  // namespace halfspace::HS_LANES
