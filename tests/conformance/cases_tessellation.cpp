// SPDX-License-Identifier: Apache-2.0
//
// Cases of tessellation, after the groups tessellation.misc_draw, .winding, .common_edge and .primitive_discard of VK-GL-CTS. A divided
// triangle or quad must cover each sample inside of it once, and no other.
#include <utility>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "conformance/shaders.h"

namespace halfspace::conformance {

namespace {

using Domain = TessellationDomain;
using Spacing = TessellationSpacing;

constexpr std::pair<const char*, Spacing> kSpacings[] = {{"equal_spacing", Spacing::equal},
                                                         {"fractional_even_spacing", Spacing::fractional_even},
                                                         {"fractional_odd_spacing", Spacing::fractional_odd}};
constexpr std::pair<const char*, Domain> kAreas[] = {{"triangles", Domain::triangles}, {"quads", Domain::quads}};
constexpr float kLevels[] = {1.0f, 2.5f, 5.0f, 13.7f};

// Patches of adjacent triangles, or of parallelograms that share edges. The first row of patches begins at the lower left.
Picture divided(const TessellationLayout& layout, int mode, float value, int samples) {
  Picture p;
  p.samples = samples;
  p.colors = {ColorFormat::rgba32f};
  Drawing d;
  d.kind = Kind::tessellation;
  d.mode = mode;
  d.value = value;
  d.tessellation = layout;
  d.state.topology = Topology::patches;
  d.state.depth.test = false;
  d.state.blend = kAdd;
  const auto corner = [&](double x, double y) { return Vertex{clip_at(p, x, y), glm::vec4(1.0f, 0.5f, 0.25f, 1.0f)}; };
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 3; ++x) {
      const double x0 = 1.5 + 8.0 * x + 2.0 * y, y0 = 2.25 + 13.0 * y;
      const std::array<Vertex, 4> q{corner(x0, y0), corner(x0 + 8, y0), corner(x0 + 10, y0 + 13), corner(x0 + 2, y0 + 13)};
      if (layout.patch_vertices == 4) d.vertices.insert(d.vertices.end(), q.begin(), q.end());
      if (layout.patch_vertices == 3) d.vertices.insert(d.vertices.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    }
  }
  p.draws.push_back(std::move(d));
  return p;
}

// Each patch that is not discarded covers its polygon once.
std::string patches_once(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  const auto n = static_cast<std::size_t>(d.tessellation.patch_vertices);
  std::vector<Region> regions;
  for (std::size_t i = 0; i < d.vertices.size() / n; ++i) {
    if (d.mode == kDiscardOdd && i % 2 == 1) continue;
    std::vector<glm::dvec2> corners;
    for (std::size_t k = 0; k < n; ++k) corners.push_back(window_of(p, d.vertices[i * n + k].pos_clip));
    regions.push_back(polygon(corners));
  }
  return expect_red(p, seen, regions);
}

std::string is_empty(const Picture&, const Seen& seen) { return seen.is_constant() ? "" : "something is drawn"; }

std::string name_of(const std::string& group, const char* domain, const char* spacing, float level) {
  return group + "_" + domain + "_" + spacing + "_" + std::to_string(static_cast<int>(level * 10));
}

TessellationLayout layout_of(Domain domain, Spacing spacing, bool clockwise = false, bool points = false) {
  return {domain == Domain::triangles ? 3 : 4, domain, spacing, clockwise, points};
}

void add_areas(Cases& cases) {
  for (const auto& [domain_name, domain] : kAreas) {
    for (const auto& [spacing_name, spacing] : kSpacings) {
      const TessellationLayout layout = layout_of(domain, spacing);
      for (const float level : kLevels) {
        const int samples = level == 5.0f ? 4 : 1;
        cases.push_back({name_of("fill_cover", domain_name, spacing_name, level), [=] { return divided(layout, kUniform, level, samples); },
                         patches_once});
        cases.push_back({name_of("common_edge", domain_name, spacing_name, level),
                         [=] { return divided(layout, kPerEdge, level, samples); }, patches_once});
      }
      cases.push_back({name_of("primitive_discard", domain_name, spacing_name, 4.0f), [=] { return divided(layout, kDiscardOdd, 4.0f, 1); },
                       patches_once});
      cases.push_back({name_of("primitive_discard_all", domain_name, spacing_name, 0.0f),
                       [=] { return divided(layout, kUniform, 0.0f, 1); }, is_empty, true});
    }
  }
}

// Patches are counter-clockwise in the window, so a clockwise layout turns their triangles around.
void add_windings(Cases& cases) {
  for (const auto& [name, domain] : kAreas) {
    for (const bool clockwise : {false, true}) {
      for (const bool culls_back : {false, true}) {
        const TessellationLayout layout = layout_of(domain, Spacing::equal, clockwise);
        const auto picture = [=] {
          Picture p = divided(layout, kUniform, 4.0f, 1);
          p.draws[0].state.cull = culls_back ? CullMode::back : CullMode::front;
          return p;
        };
        const bool is_visible = clockwise != culls_back;
        cases.push_back({std::string("winding_") + name + (clockwise ? "_cw" : "_ccw") + (culls_back ? "_cull_back" : "_cull_front"),
                         picture, is_visible ? patches_once : is_empty, !is_visible});
      }
    }
  }
}

void add_lines_and_points(Cases& cases) {
  for (const auto& [spacing_name, spacing] : kSpacings) {
    for (const float level : kLevels) {
      const TessellationLayout layout = layout_of(Domain::isolines, spacing);
      cases.push_back({name_of("isolines", "lines", spacing_name, level), [=] { return divided(layout, kPerEdge, level, 1); }});
    }
  }
  for (const Domain domain : {Domain::triangles, Domain::quads, Domain::isolines}) {
    for (const float level : kLevels) {
      const char* const name = domain == Domain::triangles ? "triangles" : domain == Domain::quads ? "quads" : "isolines";
      const TessellationLayout layout = layout_of(domain, Spacing::equal, false, true);
      cases.push_back({name_of("point_mode", name, "equal_spacing", level), [=] { return divided(layout, kUniform, level, 1); }});
    }
  }
}

}  // namespace

Cases tessellation_cases() {
  Cases cases;
  add_areas(cases);
  add_windings(cases);
  add_lines_and_points(cases);
  return cases;
}

}  // namespace halfspace::conformance
