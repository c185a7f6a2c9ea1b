// SPDX-License-Identifier: Apache-2.0
//
// Cases of vertex arrays, after the group vertex_arrays of VK-GL-CTS (GLES 3). A point or triangle in each cell of 8 x 8 px shows the
// attributes of its provoking vertex in attachments of 32-bit floats and integers. The truth decodes the arrays by their definition.
#include <bit>
#include <map>
#include <optional>
#include <utility>

#include "conformance/attribute_arrays.h"
#include "conformance/geometry.h"
#include "conformance/groups.h"

namespace halfspace::conformance {

namespace {

constexpr int kCell = 8, kCells = 4;

struct TypeName {
  const char* name;
  ComponentType type;
};
constexpr TypeName kIntegerTypes[] = {{"ubyte", ComponentType::uint8}, {"byte", ComponentType::int8},   {"ushort", ComponentType::uint16},
                                      {"short", ComponentType::int16}, {"uint", ComponentType::uint32}, {"int", ComponentType::int32}};
constexpr TypeName kFloatTypes[] = {
    {"half", ComponentType::float16}, {"float", ComponentType::float32}, {"double", ComponentType::float64}};
constexpr TypeName kPackedTypes[] = {{"uint_2_10_10_10", ComponentType::uint_2_10_10_10},
                                     {"int_2_10_10_10", ComponentType::int_2_10_10_10}};

// Returns the vertices of a point or a triangle in each cell of the first columns. The pixel at (2, 2) of each cell is covered.
std::vector<glm::ivec2> vertices_of(Topology topology, int columns) {
  std::vector<glm::ivec2> vertices;
  for (int x = 0; x < columns * kCell; x += kCell) {
    for (int y = 0; y < kCells * kCell; y += kCell) {
      if (topology == Topology::points) vertices.insert(vertices.end(), {{x + 4, y + 4}});
      if (topology != Topology::points) vertices.insert(vertices.end(), {{x + 1, y + 1}, {x + 7, y + 1}, {x + 1, y + 7}});
    }
  }
  return vertices;
}

// The formats of the attributes of the shader.
struct Formats {
  AttributeFormat position, color, integers{ComponentType::int32, ReadAs::integers}, last;
};

Picture with_arrays(const Formats& f, Topology topology, int columns = kCells) {
  Picture p;
  p.colors = {ColorFormat::rgba32f, ColorFormat::rgba32i, ColorFormat::rgba32f};
  Drawing d;
  d.kind = Kind::attributes;
  d.value = 2.0f / static_cast<float>(p.width);
  d.state.topology = topology;
  d.state.point_size = 4.0f;
  const std::vector<glm::ivec2> positions = vertices_of(topology, columns);
  const std::size_t n = positions.size();
  d.arrays = {position_array(f.position, positions), random_array(f.color, n, 1), random_array(f.integers, n, 2),
              random_array(f.last, n, 3)};
  p.draws.push_back(std::move(d));
  return p;
}

// The vertex and the instance that a cell shows.
struct Source {
  std::size_t vertex, instance;
};
std::map<std::pair<int, int>, Source> sources_of(const Drawing& d) {
  Drawing submitted;
  submitted.state = d.state;
  std::vector<uint32_t> all = d.indices;
  for (uint32_t i = 0; d.indices.empty() && i < vertex_count(d); ++i) all.push_back(i);
  for (const uint32_t i : oracle::selected(all, d.state)) submitted.indices.push_back(i + static_cast<uint32_t>(d.state.base_vertex));
  std::map<std::pair<int, int>, Source> sources;
  for (std::size_t instance = 0; instance < d.state.instances; ++instance) {
    for (const Assembled& a : assembled(submitted)) {
      const std::array<float, 4> position = numbers_of(d.arrays[0].stream, a.provoking);
      const int column = static_cast<int>(position[0]) / kCell + static_cast<int>(instance);
      sources[{column, static_cast<int>(position[1]) / kCell}] = {a.provoking, instance};
    }
  }
  return sources;
}

// source: null if nothing is drawn there.
std::string wrong_cell(const Drawing& d, const Seen& seen, int x, int y, const Source* source) {
  const auto numbers = [&](std::size_t array) {
    if (source == nullptr) return std::array<float, 4>{};
    const VertexStream& s = d.arrays[array].stream;
    return numbers_of(s, s.divisor == 0 ? source->vertex : source->instance / s.divisor + d.state.base_instance);
  };
  for (const auto& [attachment, array] : {std::pair<std::size_t, std::size_t>{0, 1}, {2, 3}}) {
    const std::array<float, 4> n = numbers(array);
    const std::string wrong = expect_near({n[0], n[1], n[2], n[3]}, seen.color(x, y, attachment), 0.0);
    if (!wrong.empty()) return "attachment " + std::to_string(attachment) + ": " + wrong;
  }
  return std::bit_cast<glm::ivec4>(numbers(2)) == seen.integers(x, y, 1) ? "" : "the integers differ";
}

std::string shows_the_attributes(const Picture& p, const Seen& seen) {
  const Drawing& d = p.draws[0];
  const auto sources = sources_of(d);
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    if (x % kCell == 0 && y % kCell == 0) return wrong_cell(d, seen, x, y, nullptr);
    if (x % kCell != 2 || y % kCell != 2) return {};
    const auto found = sources.find({x / kCell, y / kCell});
    return wrong_cell(d, seen, x, y, found == sources.end() ? nullptr : &found->second);
  });
}

class Builder {
 public:
  template <class F>
  void add(const std::string& name, const F& picture, const char* not_by_mesa = nullptr) {
    cases.push_back({name, picture, shows_the_attributes, false, not_by_mesa});
  }
  // Adds a case with points and triangles in turn.
  void add(const std::string& name, const Formats& formats) {
    const Topology topology = cases.size() % 2 == 0 ? Topology::points : Topology::triangles;
    add(name, [=] { return with_arrays(formats, topology); });
  }
  Cases cases;
};

// ---- formats -------------------------------------------------------------------------------------------------------

void add_formats(Builder& b) {
  const auto add_reals = [&](const std::string& name, const AttributeFormat& f) {
    Formats formats;
    formats.color = formats.last = f;
    b.add("single_attribute_" + name, formats);
  };
  for (int n = 1; n <= 4; ++n) {
    const std::string count = "_" + std::to_string(n);
    for (const TypeName& t : kFloatTypes) add_reals(t.name + count, {t.type, ReadAs::floats, n});
    for (const TypeName& t : kIntegerTypes) {
      add_reals(t.name + count, {t.type, ReadAs::floats, n});
      add_reals(t.name + count + "_normalized", {t.type, ReadAs::normalized, n});
      Formats formats;
      formats.integers = {t.type, ReadAs::integers, n};
      b.add(std::string("single_attribute_") + t.name + count + "_integer", formats);
    }
  }
  for (const TypeName& t : kPackedTypes) {
    add_reals(t.name, {t.type, ReadAs::floats});
    add_reals(std::string(t.name) + "_normalized", {t.type, ReadAs::normalized});
    add_reals(std::string(t.name) + "_bgra", {t.type, ReadAs::normalized, 4, true});
  }
  add_reals("ubyte_bgra", {ComponentType::uint8, ReadAs::normalized, 4, true});
}

void add_positions(Builder& b) {
  const auto add = [&](const std::string& name, const AttributeFormat& f) {
    Formats formats;
    formats.position = f;
    b.add("position_" + name, formats);
  };
  for (int n = 2; n <= 4; ++n) {
    for (const TypeName& t : kFloatTypes) add(t.name + ("_" + std::to_string(n)), {t.type, ReadAs::floats, n});
    for (const TypeName& t : kIntegerTypes) add(t.name + ("_" + std::to_string(n)), {t.type, ReadAs::floats, n});
  }
  for (const TypeName& t : kPackedTypes) add(t.name, {t.type, ReadAs::floats});
}

// ---- memory --------------------------------------------------------------------------------------------------------

struct Mix {
  const char* name;
  Formats formats;
};
constexpr Mix kMixes[] = {
    {"floats", {}},
    {"bytes",
     {{ComponentType::uint8, ReadAs::floats, 2},
      {ComponentType::uint8, ReadAs::normalized, 3},
      {ComponentType::int8, ReadAs::integers, 1},
      {ComponentType::int8, ReadAs::normalized, 4}}},
    {"shorts",
     {{ComponentType::int16, ReadAs::floats, 3},
      {ComponentType::uint16, ReadAs::normalized, 4},
      {ComponentType::uint16, ReadAs::integers, 3},
      {ComponentType::int16, ReadAs::floats, 1}}},
    {"small",
     {{ComponentType::float16, ReadAs::floats, 2},
      {ComponentType::int_2_10_10_10, ReadAs::normalized},
      {ComponentType::uint8, ReadAs::integers, 4},
      {ComponentType::float16, ReadAs::floats, 3}}},
    {"large",
     {{ComponentType::float64, ReadAs::floats, 3},
      {ComponentType::float64, ReadAs::floats, 2},
      {ComponentType::uint32, ReadAs::integers, 2},
      {ComponentType::uint32, ReadAs::normalized, 4}}},
    {"mixed",
     {{ComponentType::int_2_10_10_10, ReadAs::floats},
      {ComponentType::float64, ReadAs::floats, 4},
      {ComponentType::int16, ReadAs::integers, 4},
      {ComponentType::uint8, ReadAs::normalized, 4, true}}},
};

void add_layouts(Builder& b) {
  for (const auto& [name, mix] : kMixes) {
    const Formats formats = mix;  // lambdas do not capture structured bindings
    b.add(std::string("multiple_attributes_") + name, formats);
    for (const int offset : {0, 1, 4}) {
      for (const int gap : {0, 1, 4, 13}) {
        const Topology topology = (offset + gap) % 2 == 0 ? Topology::points : Topology::triangles;
        b.add(std::string("interleaved_") + name + "_offset_" + std::to_string(offset) + "_gap_" + std::to_string(gap), [=] {
          Picture p = with_arrays(formats, topology);
          p.draws[0].arrays = interleaved(p.draws[0].arrays, offset, gap);
          return p;
        });
      }
    }
    b.add(std::string("constant_") + name, [=] {
      Picture p = with_arrays(formats, Topology::triangles);
      for (std::size_t i = 1; i < p.draws[0].arrays.size(); ++i) p.draws[0].arrays[i].stream.stride = 0;
      return p;
    });
  }
}

// ---- instances -----------------------------------------------------------------------------------------------------

void add_instance_arrays(Builder& b) {
  for (const auto& [name, mix] : kMixes) {
    for (const uint32_t divisor : {1u, 2u, 3u}) {
      for (const uint32_t first : {0u, 3u}) {
        const Formats formats = mix;
        const bool two = divisor == 2;  // whether the integers have one row per instance as well
        const bool has_bytes = formats.last.type == ComponentType::int8 && formats.last.read_as == ReadAs::normalized;
        const char* not_by_mesa = has_bytes ? "llvmpipe reads the code −128 of a byte with a divisor as −1.008" : nullptr;
        b.add(
            std::string("instances_") + name + "_divisor_" + std::to_string(divisor) + "_base_" + std::to_string(first),
            [=] {
              Picture p = with_arrays(formats, first == 0 ? Topology::points : Topology::triangles, 1);
              Drawing& d = p.draws[0];
              d.state.instances = kCells;
              d.state.base_instance = first;
              for (std::size_t i = two ? 2 : 3; i < d.arrays.size(); ++i) {
                const AttributeFormat& format = i == 2 ? formats.integers : formats.last;
                d.arrays[i] = random_array(format, kCells + first, 10 + i);
                d.arrays[i].stream.divisor = divisor;
              }
              return p;
            },
            not_by_mesa);
      }
    }
  }
}

// ---- ranges and indices --------------------------------------------------------------------------------------------

constexpr std::pair<const char*, IndexLayout> kIndexLayouts[] = {
    {"arrays", IndexLayout::none}, {"ubyte", IndexLayout::bytes}, {"ushort", IndexLayout::narrow}, {"uint", IndexLayout::wide}};

void add_draw_ranges(Builder& b) {
  struct Range {
    uint32_t first;
    std::optional<uint32_t> count;
  };
  constexpr Range kRanges[] = {{0, {}}, {0, 9}, {3, 6}, {5, {}}, {1, 8}};  // in primitives
  for (const auto& [name, layout] : kIndexLayouts) {
    for (const Topology topology : {Topology::points, Topology::triangles}) {
      for (const Range& range : kRanges) {
        for (const int32_t base : {0, 4, -3}) {
          if (base != 0 && (layout == IndexLayout::none || range.first == 0)) continue;
          const IndexLayout stored = layout;
          const std::string place = "_first_" + std::to_string(range.first) + (range.count ? "_" + std::to_string(*range.count) : "");
          const std::string moved = base == 0 ? "" : base < 0 ? "_base_minus_" + std::to_string(-base) : "_base_" + std::to_string(base);
          b.add(std::string("draw_") + name + (topology == Topology::points ? "_points" : "_triangles") + place + moved, [=] {
            Picture p = with_arrays(kMixes[3].formats, topology);
            Drawing& d = p.draws[0];
            const int32_t corners = topology == Topology::points ? 1 : 3, n = static_cast<int32_t>(vertex_count(d));
            d.index_layout = stored;
            d.state.first = range.first * static_cast<uint32_t>(corners);
            if (range.count) d.state.count = *range.count * static_cast<uint32_t>(corners) + (corners == 3 ? 2 : 0);  // two are left over
            d.state.base_vertex = base * corners;
            if (stored == IndexLayout::none) return p;
            for (int32_t vertex = n - 1; vertex >= 0; --vertex) {  // from the last one on
              if (vertex >= d.state.base_vertex) d.indices.push_back(static_cast<uint32_t>(vertex - d.state.base_vertex));
            }
            return p;
          });
        }
      }
    }
  }
}

}  // namespace

Cases vertex_arrays_cases() {
  Builder b;
  add_formats(b);
  add_positions(b);
  add_layouts(b);
  add_instance_arrays(b);
  add_draw_ranges(b);
  return b.cases;
}

}  // namespace halfspace::conformance
