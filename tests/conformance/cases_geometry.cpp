// SPDX-License-Identifier: Apache-2.0
//
// Cases of the geometry stage, after the groups geometry_shading.input, .conversion, .emit and .instanced of VK-GL-CTS. The truth is a draw
// without a geometry stage of the primitives that it emits, which are computed here one vertex at a time.
#include <utility>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "conformance/shaders.h"

namespace halfspace::conformance {

namespace {

using In = GeometryInputPrimitive;
using Out = GeometryOutputPrimitive;

constexpr std::pair<const char*, In> kInputs[] = {{"points", In::points},
                                                  {"lines", In::lines},
                                                  {"lines_adjacency", In::lines_adjacency},
                                                  {"triangles", In::triangles},
                                                  {"triangles_adjacency", In::triangles_adjacency}};
constexpr std::pair<const char*, Out> kOutputs[] = {
    {"points", Out::points}, {"line_strip", Out::line_strip}, {"triangle_strip", Out::triangle_strip}};

struct NamedTopology {
  const char* name;
  Topology topology;
  In input;
};
constexpr NamedTopology kInputTopologies[] = {{"points", Topology::points, In::points},
                                              {"lines", Topology::lines, In::lines},
                                              {"line_loop", Topology::line_loop, In::lines},
                                              {"line_strip", Topology::line_strip, In::lines},
                                              {"triangles", Topology::triangles, In::triangles},
                                              {"triangle_strip", Topology::triangle_strip, In::triangles},
                                              {"triangle_fan", Topology::triangle_fan, In::triangles},
                                              {"lines_adjacency", Topology::lines_adjacency, In::lines_adjacency},
                                              {"line_strip_adjacency", Topology::line_strip_adjacency, In::lines_adjacency},
                                              {"triangles_adjacency", Topology::triangles_adjacency, In::triangles_adjacency},
                                              {"triangle_strip_adjacency", Topology::triangle_strip_adjacency, In::triangles_adjacency}};

Topology list_topology(In input) {
  switch (input) {
    case In::points: return Topology::points;
    case In::lines: return Topology::lines;
    case In::lines_adjacency: return Topology::lines_adjacency;
    case In::triangles: return Topology::triangles;
    case In::triangles_adjacency: return Topology::triangles_adjacency;
  }
  return Topology::points;
}

Picture emitted(Topology topology, const GeometryLayout& layout, int mode, float value, int vertices, uint32_t instances = 1) {
  Picture p;
  p.samples = vertices % 2 == 0 ? 4 : 1;
  Drawing d;
  d.kind = Kind::geometry;
  d.mode = mode;
  d.value = value;
  d.geometry = layout;
  d.state.topology = topology;
  d.state.point_size = 2.0f;
  d.state.depth.test = false;
  d.state.instances = instances;
  d.vertices = scattered(p, vertices, 41, true);
  p.draws.push_back(std::move(d));
  return p;
}

using Strip = std::vector<Vertex>;

// The strips that an invocation emits for a primitive; see GeometryShader.
std::vector<Strip> strips_of(const Drawing& d, const std::vector<Vertex>& v, int primitive, int instance, int invocation) {
  std::vector<Strip> strips(1);
  const auto emit = [&](const Vertex& at, float x, float y, const glm::vec4& color) {
    const glm::vec4 p = 0.5f * at.pos_clip;
    strips.back().push_back({{p.x + x * p.w, p.y + y * p.w, p.z, p.w}, color});
  };
  if (d.mode == kByNumber) {
    const float t = static_cast<float>(invocation) / 32.0f;
    const glm::vec4 color(static_cast<float>(primitive) / 16.0f, static_cast<float>(instance) / 4.0f, t, 1.0f);
    for (const Vertex& at : v) emit(at, 0.5f * t, -0.5f * t, color);
    if ((primitive + invocation) % 4 == 1) return {};
    return strips;
  }
  const int count = static_cast<int>(d.value) % 4, ends = static_cast<int>(d.value) / 4;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (d.mode == kWhole) {
      emit(v[i], 0.0f, 0.0f, v[i].color);
      if (v.size() < 3) emit(v[i], 0.25f, -0.25f, v[i].color);
      if (v.size() < 3) emit(v[i], 0.25f, 0.25f, v[i].color);
      continue;
    }
    for (int k = 0; k < count; ++k) emit(v[i], k == 0 ? 0.0f : 0.25f, k == 2 ? 0.25f : 0.0f, v[i].color);
    if (ends > 0) strips.emplace_back();
  }
  return strips;
}

// Appends the primitives of a strip as a list.
void add_strip(const Strip& s, Out output, Drawing& list) {
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (output == Out::points) list.vertices.push_back(s[i]);
    if (output == Out::line_strip && i + 1 < s.size()) list.vertices.insert(list.vertices.end(), {s[i], s[i + 1]});
    if (output == Out::triangle_strip && i + 2 < s.size())
      list.vertices.insert(list.vertices.end(), {s[i + i % 2], s[i + 1 - i % 2], s[i + 2]});
  }
}

// The picture must equal that of a list of the emitted primitives.
std::string as_list(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  Drawing list;
  list.mode = kFlat;
  list.state = d.state;
  list.state.instances = 1;
  list.state.topology = d.geometry.output == Out::points       ? Topology::points
                        : d.geometry.output == Out::line_strip ? Topology::lines
                                                               : Topology::triangles;
  std::vector<uint32_t> indices = d.indices;
  for (uint32_t i = 0; d.indices.empty() && i < d.vertices.size(); ++i) indices.push_back(i);
  const auto primitives = oracle::assemble_with_neighbors(indices, d.restart ? std::optional(oracle::kRestart) : std::nullopt, d.state);
  for (uint32_t instance = 0; instance < d.state.instances; ++instance) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      std::vector<Vertex> v;
      for (int k = 0; k < vertices_of(d.geometry.input); ++k) v.push_back(d.vertices[primitives[i][static_cast<std::size_t>(k)]]);
      for (int invocation = 0; invocation < d.geometry.invocations; ++invocation) {
        for (const Strip& s : strips_of(d, v, static_cast<int>(i), static_cast<int>(instance), invocation))
          add_strip(s, d.geometry.output, list);
      }
    }
  }
  Picture plain = p;
  plain.draws = {list};
  if (list.vertices.empty()) plain.draws.clear();
  const Seen expected = draw(plain);
  return for_each_pixel(seen, [&](int x, int y) { return expect_near(glm::dvec4(expected.color(x, y)), seen.color(x, y), 0.0); });
}

void add_inputs(Cases& cases) {
  for (const NamedTopology& t : kInputTopologies) {
    const GeometryLayout layout{t.input, Out::triangle_strip, kGeometryVertices, 1};
    const Topology topology = t.topology;
    cases.push_back({std::string("input_") + t.name, [=] { return emitted(topology, layout, kWhole, 0.0f, 13); }, as_list});
    cases.push_back({std::string("input_") + t.name + "_first",
                     [=] {
                       Picture p = emitted(topology, layout, kWhole, 0.0f, 14);
                       p.draws[0].state.provoking = ProvokingVertex::first;
                       return p;
                     },
                     nullptr});
    cases.push_back({std::string("input_") + t.name + "_restart",
                     [=] {
                       Picture p = emitted(topology, layout, kWhole, 0.0f, 17);
                       p.draws[0].restart = true;
                       for (uint32_t i = 0; i < 17; ++i) {
                         p.draws[0].indices.push_back(i);
                         if (i == 7 || i == 8) p.draws[0].indices.push_back(oracle::kRestart);
                       }
                       return p;
                     },
                     as_list});
  }
  for (int n = 0; n <= 12; ++n) {
    const GeometryLayout layout{In::triangles_adjacency, Out::triangle_strip, kGeometryVertices, 1};
    cases.push_back({"input_triangle_strip_adjacency_vertex_count_" + std::to_string(n),
                     [=] { return emitted(Topology::triangle_strip_adjacency, layout, kWhole, 0.0f, n); }, as_list, n < 6});
  }
}

void add_conversions(Cases& cases) {
  for (const auto& [in_name, in] : kInputs) {
    for (const auto& [out_name, out] : kOutputs) {
      const GeometryLayout layout{in, out, kGeometryVertices, 1};
      const Topology topology = list_topology(in);
      cases.push_back(
          {std::string("conversion_") + in_name + "_to_" + out_name, [=] { return emitted(topology, layout, kWhole, 0.0f, 18); }, as_list});
    }
  }
}

void add_emits(Cases& cases) {
  for (const auto& [name, out] : kOutputs) {
    for (int vertices = 0; vertices < 4; ++vertices) {
      for (int ends = 0; ends < 3; ++ends) {
        const GeometryLayout layout{In::triangles, out, kGeometryVertices, 1};
        const float value = static_cast<float>(vertices + 4 * ends);
        const bool is_empty = vertices == 0 || (ends > 0 && vertices < (layout.output == Out::points       ? 1
                                                                        : layout.output == Out::line_strip ? 2
                                                                                                           : 3));
        cases.push_back({std::string("emit_") + name + "_emit_" + std::to_string(vertices) + "_end_" + std::to_string(ends),
                         [=] { return emitted(Topology::triangles, layout, kAtVertices, value, 9); }, as_list, is_empty});
      }
    }
  }
}

void add_invocations(Cases& cases) {
  for (const int invocations : {1, 2, 8, 32}) {
    for (const uint32_t instances : {1u, 2u, 4u}) {
      const GeometryLayout layout{In::triangles, Out::triangle_strip, kGeometryVertices, invocations};
      cases.push_back(
          {"instanced_draw_" + std::to_string(instances) + "_instances_geometry_" + std::to_string(invocations) + "_invocations",
           [=] { return emitted(Topology::triangles, layout, kByNumber, 0.0f, 18, instances); }, as_list});
    }
  }
}

}  // namespace

Cases geometry_shading_cases() {
  Cases cases;
  add_inputs(cases);
  add_conversions(cases);
  add_emits(cases);
  add_invocations(cases);
  return cases;
}

}  // namespace halfspace::conformance
