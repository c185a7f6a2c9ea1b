// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/displaced_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/geometry/double_vectors.h"
#include "halfspace/geometry/shapes.h"

namespace halfspace::HS_LANES {

namespace {

struct Relief {
  double radius, height_scale, zero_level;
};

double height_of(const HeightSample& s, const Relief& r) { return r.height_scale * (s.value - r.zero_level); }

// Returns (g_east, g_north, 1 + g/r).
glm::dvec3 slopes_of(const HeightSample& s, const Relief& r, double sin_pi_v) {
  const double east = r.height_scale * s.du / (2.0 * std::numbers::pi * r.radius * sin_pi_v);
  const double north = -r.height_scale * s.dv / (std::numbers::pi * r.radius);
  return {east, north, 1.0 + height_of(s, r) / r.radius};
}

// Returns a vertex that is not at a pole.
SurfaceVertex displaced_vertex(const HeightField& field, const Relief& relief, const SinCosDouble& pi_v, double u, double v) {
  const SphereFrame frame = sphere_frame(sincos_turns(u), pi_v);
  const HeightSample sample = field.at(u, v);
  const glm::dvec3 slopes = slopes_of(sample, relief, pi_v.sin);
  return {rounded((relief.radius + height_of(sample, relief)) * frame.normal),
          rounded(unit(slopes.z * frame.normal - slopes.x * frame.east - slopes.y * frame.north)),
          // P'u / 2πrs, normalized.
          glm::vec4(rounded(unit(slopes.z * frame.east + slopes.x * frame.normal)), 1.0f)};
}

void displace_row(Mesh& mesh, const SphereRow& row, const HeightField& field, const Relief& relief, ReliefNormals normals) {
  const SinCosDouble pi_v = sincos_turns(0.5 * row.v);
  for (int j = 0; j < row.count; ++j) {
    const std::size_t vertex = static_cast<std::size_t>(row.first + j);
    const SurfaceVertex displaced = displaced_vertex(field, relief, pi_v, row.u(j), row.v);
    mesh.positions[vertex] = displaced.position;
    if (normals == ReliefNormals::undisplaced) continue;
    mesh.normals[vertex] = displaced.normal;
    mesh.tangents[vertex] = displaced.tangent;
  }
}

// Returns the distance of a pole from the center: the mean over `columns` vertices at (j + 1/2) / columns.
double pole_radius(const HeightField& field, const Relief& relief, double v, int columns) {
  double sum = 0;
  for (int j = 0; j < columns; ++j) sum += height_of(field.at((j + 0.5) / columns, v), relief);
  return relief.radius + sum / columns;
}

void displace_pole(Mesh& mesh, const SphereRow& row, const HeightField& field, const Relief& relief) {
  const double y = pole_radius(field, relief, row.v, row.count);
  for (int j = 0; j < row.count; ++j) {
    mesh.positions[static_cast<std::size_t>(row.first + j)] = rounded({0.0, row.v == 0.0 ? y : -y, 0.0});
  }
}

}  // namespace

Mesh displaced_uv_sphere(int latitudes, int longitudes, float radius, const HeightField& field, double height_scale, double zero_level,
                         const Workers& workers, ReliefNormals normals) {
  const Relief relief{static_cast<double>(radius), height_scale, zero_level};
  Mesh mesh = uv_sphere(latitudes, longitudes, radius);
  workers.for_each(latitudes + 1, [&](int i) {
    const SphereRow row = uv_sphere_row(i, latitudes, longitudes);
    if (row.is_pole) {
      displace_pole(mesh, row, field, relief);
    } else {
      displace_row(mesh, row, field, relief, normals);
    }
  });
  return mesh;
}

SphereSurface::SphereSurface(const HeightField* field, double radius, double height_scale, double zero_level, ReliefNormals normals)
    : field_(field),
      radius_(radius),
      height_scale_(height_scale),
      zero_level_(zero_level),
      normals_(normals),
      north_(radius),
      south_(radius) {
  const FloatMode float_mode;
  HS_CHECK_OP(radius, >, 0.0, "SphereSurface: the radius is not positive; expected more than 0");
  if (field == nullptr) return;
  const Relief relief{radius, height_scale, zero_level};
  north_ = pole_radius(*field, relief, 0.0, field->width());
  south_ = pole_radius(*field, relief, 1.0, field->width());
}

// Returns the distance of a point from the center.
double SphereSurface::distance_at(double u, double v) const {
  if (v == 0.0) return north_;
  if (v == 1.0) return south_;
  return field_ == nullptr ? radius_ : radius_ + height_of(field_->at(u, v), {radius_, height_scale_, zero_level_});
}

SurfaceVertex SphereSurface::at(double u, double v) const {
  const SinCosDouble pi_v = sincos_turns(0.5 * v);
  if (field_ != nullptr && normals_ == ReliefNormals::displaced && v != 0.0 && v != 1.0)
    return displaced_vertex(*field_, {radius_, height_scale_, zero_level_}, pi_v, u, v);
  const SphereFrame frame = sphere_frame(sincos_turns(u), pi_v);
  return {rounded(distance_at(u, v) * frame.normal), rounded(frame.normal), glm::vec4(rounded(frame.east), 1.0f)};
}

void SphereSurface::positions(std::span<const double> u, std::span<const double> v, std::span<glm::vec3> out) const {
  std::vector<SinCosDouble> turns;
  std::vector<HeightTaps> taps;
  for (const double x : u) {
    turns.push_back(sincos_turns(x));
    if (field_ != nullptr) taps.push_back(field_->taps(x));
  }
  std::vector<HeightSample> samples(taps.size());
  for (std::size_t j = 0; j < v.size(); ++j) {
    const SinCosDouble pi_v = sincos_turns(0.5 * v[j]);
    const bool is_displaced = field_ != nullptr && v[j] != 0.0 && v[j] != 1.0;
    if (is_displaced) field_->at(taps, v[j], samples);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double distance =
          is_displaced ? radius_ + height_of(samples[i], {radius_, height_scale_, zero_level_}) : distance_at(u[i], v[j]);
      out[j * u.size() + i] = rounded(distance * sphere_frame(turns[i], pi_v).normal);
    }
  }
}

glm::dvec3 slopes_at(const HeightField& field, double u, double v, double radius, double height_scale, double zero_level) {
  return slopes_of(field.at(u, v), {radius, height_scale, zero_level}, sincos_turns(0.5 * v).sin);
}

SlopeRows::SlopeRows(const HeightField& field, int width, int height, double radius, double height_scale, double zero_level)
    : field_(field),
      height_(height),
      radius_(radius),
      height_scale_(height_scale),
      zero_level_(zero_level),
      at_texels_(width == field.width() && height == field.height()) {
  HS_CHECK_OP(width, >=, 1, "displaced sphere: the width of the map is not positive; expected at least 1");
  HS_CHECK_OP(height, >=, 1, "displaced sphere: the height of the map is not positive; expected at least 1");
  HS_CHECK_OP(radius, >, 0.0, "displaced sphere: the radius is not positive; expected more than 0");
  for (int x = 0; x < width && !at_texels_; ++x) taps_.push_back(field.taps((x + 0.5) / width));
}

void SlopeRows::operator()(int row, std::span<glm::vec4> slopes) const {
  const double v = (row + 0.5) / height_;
  const double sin_pi_v = sincos_turns(0.5 * v).sin;
  std::vector<HeightSample> samples(slopes.size());
  at_texels_ ? field_.at_texels(row, samples) : field_.at(taps_, v, samples);
  const Relief relief{radius_, height_scale_, zero_level_};
  std::transform(samples.begin(), samples.end(), slopes.begin(),
                 [&](const HeightSample& s) { return glm::vec4(glm::vec3(slopes_of(s, relief, sin_pi_v)), 0.0f); });
}

Image<glm::vec4> slope_map(const HeightField& field, int width, int height, double radius, double height_scale, double zero_level,
                           const Workers& workers) {
  const SlopeRows rows(field, width, height, radius, height_scale, zero_level);
  Image<glm::vec4> map(width, height);
  workers.for_each(height, [&](int row) { rows(row, map.row(row)); });
  return map;
}

}  // namespace halfspace::HS_LANES
