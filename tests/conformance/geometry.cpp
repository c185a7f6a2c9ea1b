// SPDX-License-Identifier: Apache-2.0
#include "conformance/geometry.h"

#include <cmath>
#include <sstream>

#include "support/random.h"

namespace halfspace::conformance {

glm::vec4 clip_at(const Picture& p, double x, double y, float z_ndc, float w) {
  const auto ndc = [](double px, int size) { return static_cast<float>(px / (0.5 * size) - 1.0); };
  return {ndc(x, p.width) * w, ndc(y, p.height) * w, z_ndc * w, w};
}

glm::dvec2 window_of(const Picture& p, const glm::vec4& c) {
  const glm::dvec4 d(c);
  return {(d.x / d.w + 1.0) * 0.5 * p.width, (d.y / d.w + 1.0) * 0.5 * p.height};
}

void add_quad(Drawing& d, const std::array<Vertex, 4>& corners) {
  const auto n = static_cast<uint32_t>(d.vertices.size());
  d.vertices.insert(d.vertices.end(), corners.begin(), corners.end());
  d.indices.insert(d.indices.end(), {n, n + 1, n + 2, n, n + 2, n + 3});
}

void add_rectangle(Drawing& d, const Picture& p, const glm::dvec4& r, const glm::vec4& color, float z_ndc) {
  add_quad(d, {Vertex{clip_at(p, r.x, r.y, z_ndc), color},
               {clip_at(p, r.z, r.y, z_ndc), color},
               {clip_at(p, r.z, r.w, z_ndc), color},
               {clip_at(p, r.x, r.w, z_ndc), color}});
}

glm::vec4 color_number(int i) {
  const auto channel = [i](int step, int codes) { return static_cast<float>((i * step + 31) % codes) / static_cast<float>(codes); };
  return {channel(37, 101), channel(61, 97), channel(29, 103), 0.25f + 0.75f * channel(43, 89)};
}

std::vector<Vertex> scattered(const Picture& p, int n, uint64_t seed, bool projected) {
  Random random(seed);
  std::vector<Vertex> out;
  for (int i = 0; i < n; ++i) {
    const double x = random.below(p.width * 256) / 256.0, y = random.below(p.height * 256) / 256.0;
    const float z = static_cast<float>(random.between(-14, 14)) / 16.0f;
    out.push_back({clip_at(p, x, y, z, projected ? random.pick({0.5f, 1.0f, 2.0f}) : 1.0f), color_number(i)});
  }
  return out;
}

std::vector<Vertex> zigzag(const Picture& p, int n, bool projected) {
  std::vector<Vertex> out;
  for (int i = 0; i < n; ++i) {
    const double x = std::round((1.3 + (p.width - 2.6) * i / (n - 1)) * 256.0) / 256.0;
    const double y = std::round((i % 2 == 0 ? 0.1 + 0.02 * i : 0.9 - 0.03 * i) * p.height * 256.0) / 256.0;
    out.push_back({clip_at(p, x, y, 0.0f, projected ? (i % 3 == 0 ? 0.5f : 2.0f) : 1.0f), color_number(i)});
  }
  return out;
}

std::vector<Assembled> assembled(const Drawing& d) {
  std::vector<uint32_t> index = d.indices;
  for (uint32_t i = 0; d.indices.empty() && i < d.vertices.size(); ++i) index.push_back(i);
  const bool first = d.state.provoking == ProvokingVertex::first;
  const std::size_t n = index.size();
  std::vector<Assembled> out;
  const auto line = [&](std::size_t a, std::size_t b) { out.push_back({{index[a], index[b], index[b]}, index[first ? a : b]}); };
  switch (d.state.topology) {
    case Topology::points:
      for (const uint32_t i : index) out.push_back({{i, i, i}, i});
      break;
    case Topology::lines:
      for (std::size_t i = 0; i + 1 < n; i += 2) line(i, i + 1);
      break;
    case Topology::line_strip:
    case Topology::line_loop:
      for (std::size_t i = 0; i + 1 < n; ++i) line(i, i + 1);
      if (d.state.topology == Topology::line_loop && n > 1) line(n - 1, 0);
      break;
    case Topology::triangles:
      for (std::size_t i = 0; i + 2 < n; i += 3) out.push_back({{index[i], index[i + 1], index[i + 2]}, index[first ? i : i + 2]});
      break;
    case Topology::triangle_strip:
      for (std::size_t i = 0; i + 2 < n; ++i) {
        const std::size_t odd = i % 2;
        out.push_back({{index[i + odd], index[i + 1 - odd], index[i + 2]}, index[first ? i : i + 2]});
      }
      break;
    case Topology::triangle_fan:
      for (std::size_t i = 1; i + 1 < n; ++i) out.push_back({{index[0], index[i], index[i + 1]}, index[first ? i : i + 1]});
      break;
    default: break;  // those with adjacency are not used here
  }
  return out;
}

Where where(const Region& region, const glm::dvec2& p, double margin) {
  Where result = Where::inside;
  for (const HalfPlane& h : region.planes) {
    const double distance = (h.a * p.x + h.b * p.y + h.c), reach = margin * std::hypot(h.a, h.b);
    if (distance < -reach) return Where::outside;
    if (distance <= reach) result = Where::unsure;
  }
  return result;
}

Region polygon(std::span<const glm::dvec2> corners) {
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    area += a.x * b.y - a.y * b.x;
  }
  const double turn = area < 0.0 ? -1.0 : 1.0;
  Region r;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 &a = corners[i], e = corners[(i + 1) % corners.size()] - a;
    r.planes.push_back({-e.y * turn, e.x * turn, (e.y * a.x - e.x * a.y) * turn});
  }
  return r;
}

// With p = Σ bi·pi and p = (X, Y, ·, 1), b = M⁻¹·(X, Y, 1), where the columns of M are (xi, yi, wi). X and Y are linear in the window
// coordinates x and y.
std::optional<Weighed> weigh(const Picture& picture, const DepthState& depth, const std::array<glm::vec4, 3>& v) {
  glm::dmat3 m;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec4 c(v[static_cast<std::size_t>(i)]);
    m[i] = {c.x, c.y, c.w};
  }
  if (std::fabs(glm::determinant(m)) < 1e-12) return std::nullopt;
  const glm::dmat3 inverse = glm::inverse(m);
  Weighed out;
  for (int i = 0; i < 3; ++i) {
    const double a = inverse[0][i] * 2.0 / picture.width, b = inverse[1][i] * 2.0 / picture.height;
    out.weight[static_cast<std::size_t>(i)] = {a, b, inverse[2][i] - inverse[0][i] - inverse[1][i]};
  }
  const auto plane = [&](const auto& of) {  // Σ weight·of(vertex)
    HalfPlane h{0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const double k = of(glm::dvec4(v[i]));
      h = {h.a + k * out.weight[i].a, h.b + k * out.weight[i].b, h.c + k * out.weight[i].c};
    }
    out.region.planes.push_back(h);
  };
  out.region.planes.assign(out.weight.begin(), out.weight.end());
  if (!depth.clamp) {
    const bool from_zero = depth.clip == ClipDepth::zero_to_one;
    plane([&](const glm::dvec4& c) { return from_zero ? c.z : c.z + c.w; });
    plane([](const glm::dvec4& c) { return c.w - c.z; });
  }
  return out;
}

glm::dvec4 Weighed::color(const std::array<glm::vec4, 3>& of, const glm::dvec2& p) const {
  glm::dvec4 sum(0.0);
  double weights = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double w = weight[i].a * p.x + weight[i].b * p.y + weight[i].c;
    sum += w * glm::dvec4(of[i]);
    weights += w;
  }
  return sum / weights;
}

Share share_of(const std::vector<Region>& regions, int x, int y, int samples) {
  Share share;
  for (int s = 0; s < samples; ++s) {
    const oracle::Point at = oracle::position_of({x, y, s}, samples);
    for (const Region& r : regions) {
      const Where w = where(r, glm::dvec2(static_cast<double>(at.x), static_cast<double>(at.y)) / 256.0);
      share.low += w == Where::inside ? 1.0 : 0.0;
      share.high += w == Where::outside ? 0.0 : 1.0;
    }
  }
  return {share.low / samples, share.high / samples};
}

std::string expect_red(const Picture& picture, const Seen& seen, const std::vector<Region>& regions, double weight) {
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const Share share = share_of(regions, x, y, picture.samples);
    const double red = static_cast<double>(seen.color(x, y).x), rounding = 1e-6;
    if (red >= share.low * weight - rounding && red <= share.high * weight + rounding) return {};
    return "red " + std::to_string(red) + ", expected " + std::to_string(share.low * weight) + " to " + std::to_string(share.high * weight);
  });
}

std::string quads_once(const Picture& picture, const Seen& seen) {
  std::vector<Region> regions;
  const std::vector<Vertex>& v = picture.draws[0].vertices;
  for (std::size_t i = 0; i < v.size(); i += 4) {
    std::array<glm::dvec2, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = window_of(picture, v[i + k].pos_clip);
    regions.push_back(polygon(corners));
  }
  return expect_red(picture, seen, regions);
}

std::string expect_near(const glm::dvec4& expected, const glm::vec4& got, double tolerance) {
  bool near = true;
  for (int k = 0; k < 4; ++k) near = near && std::fabs(expected[k] - static_cast<double>(got[k])) <= tolerance;
  if (near) return {};
  std::ostringstream out;
  out << expected.x << ' ' << expected.y << ' ' << expected.z << ' ' << expected.w << " expected, got " << got.x << ' ' << got.y << ' '
      << got.z << ' ' << got.w;
  return out.str();
}

}  // namespace halfspace::conformance
