// SPDX-License-Identifier: Apache-2.0
//
// Cases of layered targets, after the group geometry_shading.layered of VK-GL-CTS (GLES 3.1). The truth draws each layer on its own: the
// primitives that are in it, in order. What is drawn into a texture of the kind must be the same.
#include <cstring>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "conformance/shaders.h"
#include "halfspace/shading/texture/texture_memory.h"

namespace halfspace::conformance {

namespace {

struct LayeredKind {
  const char* name;
  TextureKind kind;
  int layers;
};
constexpr LayeredKind kLayeredKinds[] = {{"2d_array", TextureKind::two_d_array, 8},
                                         {"cube", TextureKind::cube, 6},
                                         {"cube_array", TextureKind::cube_array, 12},
                                         {"3d", TextureKind::three_d, 7}};

Picture layered(const LayeredKind& kind) {
  Picture p;
  p.layers = kind.layers;
  p.kind = kind.kind;
  if (kind.kind == TextureKind::three_d) p.depth = DepthFormat::none;  // OpenGL has no 3D textures of depths
  return p;
}

// ---- the layers of primitives --------------------------------------------------------------------------------------

// Returns whether a primitive of an instance is drawn into a layer.
bool is_in_layer(const Drawing& d, int layer, int primitive, uint32_t provoking, uint32_t instance) {
  if (d.kind == Kind::color) return layer == 0;
  if (d.kind == Kind::layer_geometry) return layer < kGeometryLayers && (d.mode == kAllLayers || ((primitive + layer) & 3) != 1);
  const glm::vec4& extra = d.rows.empty() ? d.vertices[provoking].extra : d.rows[instance / d.divisor];
  return static_cast<int>(extra.x) == layer;
}

// Adds what a draw does in one layer to the picture of this layer.
void add_part(const Drawing& d, int layer, Picture& to) {
  Drawing cleared;
  cleared.vertices.resize(3);  // no area
  cleared.clear = d.clear;
  if (d.clear) to.draws.push_back(std::move(cleared));
  const std::vector<Assembled> primitives = assembled(d);
  for (uint32_t instance = 0; instance < d.state.instances; ++instance) {
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const Assembled& a = primitives[i];
      if (!is_in_layer(d, layer, static_cast<int>(i), a.provoking, instance)) continue;
      Drawing one;
      one.state = d.state;
      one.state.instances = 1;
      const bool points = d.state.topology == Topology::points;
      one.state.topology = points ? Topology::points : is_lines(d.state.topology) ? Topology::lines : Topology::triangles;
      if (d.kind != Kind::color) one.state.point_size = kLayerPointSize;
      for (std::size_t k = 0; k < (points ? 1u : is_lines(d.state.topology) ? 2u : 3u); ++k) {
        one.vertices.push_back(d.vertices[a.vertex[k]]);
        if (d.kind != Kind::color) one.vertices.back().color.z = static_cast<float>(layer) * kLayerCode;
      }
      to.draws.push_back(std::move(one));
    }
  }
}

std::string each_layer_on_its_own(const Picture& p, const Seen& seen) {
  TextureMemory texture(p.kind, p.colors[0], {p.width, p.height, p.layers});
  draw_into(p, texture);
  for (int layer = 0; layer < p.layers; ++layer) {
    Picture own = p;
    own.layers = 1;
    own.draws.clear();
    for (const Drawing& d : p.draws) add_part(d, layer, own);
    const Seen expected = draw(own);
    const std::string wrong = for_each_pixel(seen, [&](int x, int y) -> std::string {
      const std::span<const std::byte> texel = seen.texel_bytes(x, y, 0, layer);
      if (std::memcmp(texel.data(), texture.level().at(x, y, layer), texel.size()) != 0) return "the texture has another color";
      if (expected.depth(x, y) != seen.depth(x, y, layer)) return "another depth than that of the primitives on their own";
      return expect_near(glm::dvec4(expected.color(x, y)), seen.color(x, y, 0, layer), 0.0);
    });
    if (!wrong.empty()) return "layer " + std::to_string(layer) + ": " + wrong;
  }
  return {};
}

// ---- draws ---------------------------------------------------------------------------------------------------------

constexpr int kLayeredVertices = 48;

Drawing layered_drawing(const Picture& p, Kind kind, Topology topology, uint64_t seed) {
  Drawing d;
  d.kind = kind;
  d.state.topology = topology;
  d.vertices = scattered(p, kLayeredVertices, seed, topology != Topology::points);
  return d;
}

// Sets the layer of each vertex to that of the function.
template <class F>
Picture by_vertex(const LayeredKind& kind, Topology topology, const F& layer) {
  Picture p = layered(kind);
  Drawing d = layered_drawing(p, Kind::layer, topology, 81);
  for (int i = 0; i < kLayeredVertices; ++i) d.vertices[static_cast<std::size_t>(i)].extra.x = static_cast<float>(layer(i));
  p.draws.push_back(std::move(d));
  return p;
}

Picture by_instance(const LayeredKind& kind) {
  Picture p = layered(kind);
  Drawing d = layered_drawing(p, Kind::layer, Topology::triangles, 82);
  d.vertices.resize(9);
  d.state.instances = static_cast<uint32_t>(kind.layers);
  d.divisor = 2;
  for (int i = 0; i < kind.layers; ++i) d.rows.push_back({static_cast<float>(i * 5 % kind.layers), 0.0f, 0.0f, 0.0f});
  p.draws.push_back(std::move(d));
  return p;
}

Picture by_geometry(const LayeredKind& kind, std::size_t layout, LayerMode mode) {
  constexpr Topology kLayoutTopologies[] = {Topology::triangles, Topology::triangle_strip, Topology::lines, Topology::points};
  Picture p = layered(kind);
  Drawing d = layered_drawing(p, Kind::layer_geometry, kLayoutTopologies[layout], 83 + layout);
  d.geometry = kLayerLayouts[layout];
  d.mode = mode;
  p.draws.push_back(std::move(d));
  return p;
}

// Triangles in all layers, a clear of all of them, and other triangles.
Picture with_clear(const LayeredKind& kind, const ClearValues& values) {
  Picture p = by_geometry(kind, 0, kAllLayers);
  p.draws.push_back(by_geometry(kind, 1, kSomeLayers).draws[0]);
  p.draws[1].clear = values;
  if (p.depth == DepthFormat::none) p.draws[1].clear->depth.reset();
  return p;
}

void set_layered_state(int number, Picture& p) {
  DrawState& s = p.draws[0].state;
  const StencilFace counting{.compare = CompareOp::less, .pass = StencilOp::increment_wrap, .reference = 0, .read_mask = 1};
  switch (number) {
    case 0:
      s.blend = kAdd;
      s.depth.test = false;
      break;
    case 1:
      s.stencil = StencilState{{.pass = StencilOp::increment_wrap}, counting};
      s.scissor = Rect{3, 4, 22, 25};
      s.cull = CullMode::back;
      break;
    default:
      s.viewport = Rect{5, 2, 24, 28};
      s.color_mask = {true, false, true, true};
      s.depth.compare = CompareOp::greater;
      p.clear_depth = 0.25f;
      p.clear_color = {0.25f, 0.5f, 0.75f, 1.0f};
  }
}

struct LayeredShape {
  const char* name;
  Topology topology;
};
constexpr LayeredShape kLayeredShapes[] = {{"points", Topology::points},
                                           {"lines", Topology::lines},
                                           {"line_strip", Topology::line_strip},
                                           {"triangles", Topology::triangles},
                                           {"triangle_strip", Topology::triangle_strip},
                                           {"triangle_fan", Topology::triangle_fan}};

void add_vertex_cases(const LayeredKind& kind, Cases& cases) {
  const std::string prefix = std::string(kind.name) + "_";
  const auto add = [&](const std::string& name, const std::function<Picture()>& picture, const char* not_by_mesa = nullptr) {
    cases.push_back({prefix + name, picture, each_layer_on_its_own, false, not_by_mesa});
  };
  add("default", [=] {
    Picture p = layered(kind);
    p.draws.push_back(layered_drawing(p, Kind::color, Topology::triangles, 80));
    return p;
  });
  add("one", [=] { return by_vertex(kind, Topology::triangles, [=](int) { return kind.layers - 1; }); });
  add("instances", [=] { return by_instance(kind); });
  add(
      "out_of_range", [=] { return by_vertex(kind, Topology::triangles, [=](int i) { return i % (kind.layers + 2) - 1; }); },
      "OpenGL does not define layers that do not exist");
  for (const LayeredShape& shape : kLayeredShapes) {
    for (const ProvokingVertex provoking : {ProvokingVertex::first, ProvokingVertex::last}) {
      const bool first = provoking == ProvokingVertex::first;
      // GL_LAYER_PROVOKING_VERTEX is for the implementation to choose.
      const bool differs = shape.topology != Topology::points && !first;
      add(
          std::string("by_vertex_") + shape.name + (first ? "_first" : ""),
          [=] {
            Picture p = by_vertex(kind, shape.topology, [=](int i) { return (i * 5 + i / 3) % kind.layers; });
            p.draws[0].state.provoking = provoking;
            return p;
          },
          differs ? "llvmpipe always takes the layer of the first vertex" : nullptr);
    }
  }
}

void add_geometry_cases(const LayeredKind& kind, Cases& cases) {
  const std::string prefix = std::string(kind.name) + "_";
  const auto add = [&](const std::string& name, const std::function<Picture()>& picture) {
    cases.push_back({prefix + name, picture, each_layer_on_its_own});
  };
  constexpr const char* kLayoutNames[] = {"invocations", "triangle_strips", "line_strips", "points"};
  for (std::size_t layout = 0; layout < kLayerLayouts.size(); ++layout) {
    add(std::string("geometry_") + kLayoutNames[layout] + "_all", [=] { return by_geometry(kind, layout, kAllLayers); });
    add(std::string("geometry_") + kLayoutNames[layout] + "_some", [=] { return by_geometry(kind, layout, kSomeLayers); });
  }
  add("clear", [=] { return with_clear(kind, {.colors = {glm::vec4(0.25f, 0.5f, 0.75f, 1.0f)}, .depth = 0.75f}); });
  add("clear_rectangle", [=] {
    return with_clear(kind, {.rect = Rect{5, 6, 20, 11}, .colors = {glm::vec4(0.25f, 0.5f, 0.75f, 1.0f)}, .depth = 0.5f});
  });
  add("clear_masked", [=] { return with_clear(kind, {.colors = {glm::vec4(1.0f)}, .mask = {false, true, false, true}}); });
  for (int state = 0; state < 3; ++state) {
    for (const int samples : {1, 4}) {
      add("state_" + std::to_string(state) + (samples == 1 ? "" : "_multisample"), [=] {
        Picture p = by_geometry(kind, 0, kSomeLayers);
        p.samples = samples;
        set_layered_state(state, p);
        return p;
      });
    }
  }
}

}  // namespace

Cases layered_rendering_cases() {
  Cases cases;
  for (const LayeredKind& kind : kLayeredKinds) {
    add_vertex_cases(kind, cases);
    add_geometry_cases(kind, cases);
  }
  return cases;
}

}  // namespace halfspace::conformance
