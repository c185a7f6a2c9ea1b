// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/ply/ply_contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/model/ply/ply_values.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

/// Returns the number as a float of at most kMaxModelNumber, or NaN if it is not finite.
float limited(double x) {
  if (!std::isfinite(x)) return std::numeric_limits<float>::quiet_NaN();
  return static_cast<float>(std::clamp(x, -kMaxModelNumber, kMaxModelNumber));
}

glm::vec2 texture_coordinate(double u, double v) { return {limited(u), limited(1.0 - v)}; }

/// Indices of properties in their element; -1 if the element does not have the property.
template <std::size_t N>
struct Fields {
  std::array<int, N> properties;

  bool present() const {
    return std::ranges::none_of(properties, [](int p) { return p < 0; });
  }
};

/// The color properties of an element.
struct ColorFields {
  Fields<3> rgb;
  int alpha;
  std::array<PlyType, 4> types{};

  explicit ColorFields(const PlyElement& element)
      : rgb{{element.find_value({"red", "diffuse_red", "r"}), element.find_value({"green", "diffuse_green", "g"}),
             element.find_value({"blue", "diffuse_blue", "b"})}},
        alpha(element.find_value({"alpha", "a"})) {
    for (std::size_t i = 0; i < 3; ++i) types[i] = type_of(element, rgb.properties[i]);
    types[3] = type_of(element, alpha);
  }

  /// row: the values of all properties.
  glm::vec4 color(std::span<const double> row) const {
    const auto value = [&](int property) { return limited(row[static_cast<std::size_t>(property)]); };
    return {value(rgb.properties[0]), value(rgb.properties[1]), value(rgb.properties[2]), alpha < 0 ? 255.0f : value(alpha)};
  }

 private:
  static PlyType type_of(const PlyElement& element, int property) {
    return property < 0 ? PlyType::uint8 : element.properties[static_cast<std::size_t>(property)].type;
  }
};

class ContentsReader {
 public:
  ContentsReader(const PlyHeader& header, std::string_view data, const std::string& file)
      : header_(header), values_(data, header.encoding, file) {}

  PlyContents read() {
    const PlyElement* const vertex = first("vertex");
    vertex_count_ = vertex == nullptr ? 0 : vertex->count;
    for (const PlyElement& element : header_.elements) read_element(element);
    return std::move(contents_);
  }

 private:
  const PlyElement* first(std::string_view name) const {
    const auto found = std::ranges::find(header_.elements, name, &PlyElement::name);
    return found == header_.elements.end() ? nullptr : &*found;
  }

  void read_element(const PlyElement& element) {
    if (element.properties.empty()) return;
    if (&element == first("vertex")) return read_vertices(element);
    if (&element == first("face")) return read_faces(element);
    if (&element == first("tristrips")) return read_strips(element);
    if (&element == first("edge")) return read_edges(element);
    for_each_row(
        element, [] {}, [](std::size_t) { return false; });
  }

  /// Reads all rows from `first`. Single values are stored in row_. list(property) reads a list and returns true, or returns false if it is
  /// not needed.
  template <class Row, class List>
  void for_each_row(const PlyElement& element, Row&& row, List&& list, uint64_t first = 0) {
    row_.resize(element.properties.size());
    const bool are_floats = std::ranges::all_of(
        element.properties, [](const PlyProperty& property) { return !property.count_type && property.type == PlyType::float32; });
    for (uint64_t i = first; i < element.count; ++i) {
      values_.set_row(element, i);
      if (are_floats && values_.read_floats(row_)) {
        row();
        continue;
      }
      for (std::size_t p = 0; p < row_.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (!property.count_type) {
          row_[p] = values_.number(property.type);
        } else if (!list(p)) {
          values_.skip(property);
        }
      }
      row();
    }
  }

  glm::dvec3 vector(const Fields<3>& f) const { return {value(f.properties[0]), value(f.properties[1]), value(f.properties[2])}; }
  double value(int property) const { return row_[static_cast<std::size_t>(property)]; }

  void read_vertices(const PlyElement& element) {
    const Fields<3> position{{element.find_value({"x"}), element.find_value({"y"}), element.find_value({"z"})}};
    const Fields<3> normal{{element.find_value({"nx"}), element.find_value({"ny"}), element.find_value({"nz"})}};
    const Fields<2> uv{
        {element.find_value({"s", "u", "texture_u", "texture_s"}), element.find_value({"t", "v", "texture_v", "texture_t"})}};
    const ColorFields color(element);
    const bool has_normals = normal.present(), has_uvs = uv.present(), has_colors = color.rgb.present();
    values_.set_row(element, 0);
    if (!position.present()) values_.fail("no coordinates; expected the properties x, y and z");
    contents_.positions.reserve(element.count);
    if (has_normals) contents_.normals.reserve(element.count);
    if (has_uvs) contents_.uvs.reserve(element.count);
    if (has_colors) contents_.colors.values.reserve(element.count);
    contents_.colors.types = color.types;
    const auto row = [&] {
      contents_.positions.push_back(vector(position));
      if (has_normals) contents_.normals.push_back(vector(normal));
      if (has_uvs) contents_.uvs.push_back(texture_coordinate(value(uv.properties[0]), value(uv.properties[1])));
      if (has_colors) contents_.colors.values.push_back(color.color(row_));
    };
    for_each_row(element, row, [](std::size_t) { return false; });
  }

  uint32_t vertex_index(double value) const {
    if (value >= 0.0 && value < static_cast<double>(vertex_count_) && value == std::floor(value)) return static_cast<uint32_t>(value);
    values_.fail(fmt::format("vertex index {}; expected an integer from 0 to {}", value, static_cast<int64_t>(vertex_count_) - 1));
  }

  // Whether the element has nothing but a list of 32-bit integers with 8-bit lengths, as in nearly all binary files.
  static bool is_list_of_indices(const PlyElement& element) {
    if (element.properties.size() != 1) return false;
    const PlyProperty& list = element.properties[0];
    const bool has_short_length = list.count_type == PlyType::uint8 || list.count_type == PlyType::int8;
    return has_short_length && (list.type == PlyType::int32 || list.type == PlyType::uint32);
  }

  // Returns whether the next row is a triangle; if so, reads it.
  bool read_triangle(PlyType type) {
    std::array<uint32_t, 3> triangle;
    if (!values_.read_triangle(triangle)) return false;
    for (const uint32_t index : triangle) {
      if (index >= vertex_count_) vertex_index(type == PlyType::int32 ? static_cast<double>(static_cast<int32_t>(index)) : index);
    }
    contents_.corners.insert(contents_.corners.end(), triangle.begin(), triangle.end());
    contents_.lengths.push_back(3);
    return true;
  }

  void read_faces(const PlyElement& element) {
    const int vertices = element.find_list({"vertex_indices", "vertex_index"}), uvs = element.find_list({"texcoord"});
    const ColorFields color(element);
    const bool in_strips = first("tristrips") != nullptr;  // strips have neither colors nor texture coordinates
    const bool has_uvs = uvs >= 0 && !in_strips, has_colors = color.rgb.present() && !in_strips;
    contents_.face_colors.types = color.types;
    std::size_t length = 0;
    std::vector<double> uv_values;
    const auto list = [&](std::size_t p) {
      const PlyProperty& property = element.properties[p];
      if (static_cast<int>(p) == vertices) {
        length = values_.list_length(property);
        for (std::size_t i = 0; i < length; ++i) contents_.corners.push_back(vertex_index(values_.number(property.type)));
        return true;
      }
      if (static_cast<int>(p) != uvs || !has_uvs) return false;
      uv_values.resize(values_.list_length(property));
      for (double& value : uv_values) value = values_.number(property.type);
      return true;
    };
    const auto row = [&] {
      contents_.lengths.push_back(static_cast<uint32_t>(length));
      if (has_colors) contents_.face_colors.values.push_back(color.color(row_));
      if (!has_uvs) return;
      uv_values.resize(2 * length);  // MeshLab writes two numbers per corner
      for (std::size_t i = 0; i < length; ++i) {
        contents_.corner_uvs.push_back(texture_coordinate(uv_values[2 * i], uv_values[2 * i + 1]));
      }
    };
    if (vertices >= 0) {
      contents_.lengths.reserve(element.count);
      contents_.corners.reserve(3 * element.count);
      uint64_t first = 0;
      if (is_list_of_indices(element)) {
        for (; first < element.count; ++first) {
          values_.set_row(element, first);
          if (!read_triangle(element.properties[0].type)) break;
        }
      }
      for_each_row(element, row, list, first);
    } else {
      for_each_row(
          element, [] {}, [](std::size_t) { return false; });
    }
  }

  void read_strips(const PlyElement& element) {
    const int vertices = element.find_list({"vertex_indices", "vertex_index"});
    const auto list = [&](std::size_t p) {
      if (static_cast<int>(p) != vertices) return false;
      const PlyProperty& property = element.properties[p];
      const std::size_t length = values_.list_length(property);
      std::array<uint32_t, 2> last{};
      std::size_t in_strip = 0;
      for (std::size_t i = 0; i < length; ++i) {
        const double value = values_.number(property.type);
        if (value == -1.0) {  // starts a new strip
          in_strip = 0;
          continue;
        }
        const uint32_t next = vertex_index(value);
        if (in_strip >= 2) add_strip_triangle(last, next, in_strip % 2 == 1);
        last = {last[1], next};
        ++in_strip;
      }
      return true;
    };
    for_each_row(
        element, [] {}, list);
  }

  void add_strip_triangle(const std::array<uint32_t, 2>& last, uint32_t next, bool is_reversed) {
    if (last[0] == last[1] || last[0] == next || last[1] == next) return;  // connects two parts of a strip
    contents_.lengths.push_back(3);
    contents_.corners.insert(contents_.corners.end(), {last[is_reversed ? 1 : 0], last[is_reversed ? 0 : 1], next});
  }

  void read_edges(const PlyElement& element) {
    const Fields<2> ends{{element.find_value({"vertex1"}), element.find_value({"vertex2"})}};
    const bool has_ends = ends.present();
    const auto row = [&] {
      if (!has_ends) return;
      for (const int end : ends.properties) contents_.edges.push_back(vertex_index(value(end)));
    };
    for_each_row(element, row, [](std::size_t) { return false; });
  }

  const PlyHeader& header_;
  PlyValues values_;
  uint64_t vertex_count_ = 0;
  std::vector<double> row_;
  PlyContents contents_;
};

}  // namespace

PlyContents read_ply_contents(const PlyHeader& header, std::string_view data, const std::string& file) {
  return ContentsReader(header, data, file).read();
}

}  // namespace halfspace::HS_LANES
