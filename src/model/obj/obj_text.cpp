// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/obj/obj_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <span>
#include <unordered_map>

#include "halfspace/core/check.h"
#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/geometry/single_mesh.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::string_view kCurveStatements[] = {"bmat", "con",  "cstype", "curv", "curv2", "deg",  "end", "hole",
                                                 "parm", "scrv", "sp",     "step", "surf",  "trim", "vp"};
constexpr std::string_view kIgnoredStatements[] = {"bevel", "c_interp", "ctech",      "d_interp",  "lod",    "maplib",
                                                   "mg",    "stech",    "shadow_obj", "trace_obj", "usemap", "vw"};

bool is_one_of(std::span<const std::string_view> names, std::string_view name) { return std::ranges::find(names, name) != names.end(); }

// The largest index in a file, and its line.
struct LargestIndex {
  uint64_t index = 0;  // counted from 1; 0: no index
  std::size_t line = 0;
};

class ObjParser {
 public:
  ObjParser(const std::filesystem::path& file, std::string_view text, std::vector<std::string>& warnings)
      : file_(file), lines_(text), warnings_(warnings) {}

  ObjText parse() {
    while (lines_.next()) {
      std::string_view rest = lines_.line();
      if (const std::string_view word = take_word(rest); !word.empty() && word[0] != '#') statement(word, rest);
    }
    check_indices();
    if (has_infinite_) skip_infinite_elements();
    return std::move(obj_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem, std::size_t line) const {
    throw InputError(fmt::format("{}:{}: {}", file_.string(), line, problem));
  }
  [[noreturn]] void fail(const std::string& problem) const { fail(problem, lines_.number()); }

  void warn_once(const std::string& kind, const std::string& text) {
    if (warned_.insert(kind).second) warnings_.push_back(fmt::format("line {}: {}", lines_.number(), text));
  }

  void statement(std::string_view word, std::string_view rest) {
    if (word == "v") return vertex(rest);
    if (word == "vt") return texture_coordinate(rest);
    if (word == "vn") return normal(rest);
    if (word == "f" || word == "fo") return element(MeshTopology::triangles, 3, rest);
    if (word == "l") return element(MeshTopology::lines, 2, rest);
    if (word == "p") return element(MeshTopology::points, 1, rest);
    if (word == "usemtl") return use_material(trimmed(rest));
    if (word == "o" || word == "g") return set_name(trimmed(rest));
    if (word == "s") return set_smoothing(take_value(rest));
    if (word == "mtllib") return add_library(trimmed(rest));
    if (is_one_of(kIgnoredStatements, word)) return;
    if (is_one_of(kCurveStatements, word)) return warn_once("curves", "free-form curves and surfaces are not drawn");
    warn_once("unknown", "unknown statement " + in_quotes(word) + " is ignored, like all other unknown statements");
  }

  // Reads up to 7 numbers, which may be infinite or NaN. Returns how many there are.
  template <class OnBad>
  std::size_t numbers(std::string_view rest, std::array<double, 7>& values, OnBad on_bad) {
    std::size_t count = 0;
    for (std::string_view word = take_value(rest); !word.empty() && count < values.size(); word = take_value(rest)) {
      const std::optional<double> value = parse_number(word);
      if (!value || (std::isfinite(*value) && std::abs(*value) > kMaxModelNumber)) on_bad(word);
      values[count++] = value.value_or(0.0);
    }
    return count;
  }

  // x y z, x y z w, or x y z red green blue. w is the weight for rational curves and is ignored.
  void vertex(std::string_view rest) {
    std::array<double, 7> v{};
    const std::size_t count = numbers(rest, v, [&](std::string_view word) {
      fail(fmt::format("cannot read {} as a coordinate; expected a number between -1e18 and 1e18", in_quotes(word)));
    });
    if (count < 3) fail(fmt::format("a vertex has {} coordinates; expected 3", count));
    if (count >= 6) {
      obj_.colors.resize(obj_.positions.size(), kNoColor);
      obj_.colors.push_back(color(v[3], v[4], v[5]));
    } else if (!obj_.colors.empty()) {
      obj_.colors.push_back(kNoColor);
    }
    obj_.positions.emplace_back(v[0], v[1], v[2]);
    has_infinite_ = has_infinite_ || !is_finite(obj_.positions.back());
  }

  glm::vec3 color(double red, double green, double blue) {
    const glm::dvec3 c(red, green, blue);
    if (is_finite(c)) return glm::vec3(glm::max(c, 0.0));
    warn_once("colors", "colors that are not finite are replaced by white");
    return kNoColor;
  }

  void texture_coordinate(std::string_view rest) {
    std::array<double, 7> v{};
    bool good = true;
    numbers(rest, v, [&](std::string_view) { good = false; });
    good = good && std::isfinite(v[0]) && std::isfinite(v[1]);
    if (!good) warn_once("vt", "unusable texture coordinates (not numbers, or not finite) are replaced by 0");
    obj_.uvs.push_back(good ? glm::vec2(v[0], v[1]) : glm::vec2(0.0f));
  }

  void normal(std::string_view rest) {
    std::array<double, 7> v{};
    bool good = true;
    const std::size_t count = numbers(rest, v, [&](std::string_view) { good = false; });
    const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    if (!good || count < 3 || largest == 0.0 || !is_finite({v[0], v[1], v[2]})) {
      warn_once("vn", "unusable normals (not finite numbers, or zero) are replaced by computed ones");
      obj_.normals.emplace_back(0.0f);
      return;
    }
    const glm::dvec3 n(v[0], v[1], v[2]);
    obj_.normals.push_back(unit_vector(largest >= 0.5 && largest <= 1.0 ? n : n / largest));
  }

  // Reads one index of a corner. Returns kNoIndex for an optional index that is missing or out of range.
  uint32_t index(std::string_view text, std::string_view corner, std::size_t count, LargestIndex& largest, bool optional) {
    if (text.empty() && optional) return kNoIndex;
    int64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, value);
    if (at != end || error == std::errc::invalid_argument) {
      fail(fmt::format("cannot read {} as the indices of a vertex; expected V, V/VT, V//VN or V/VT/VN", in_quotes(corner)));
    }
    const bool before_first = value == 0 || (value < 0 && value < -static_cast<int64_t>(count));
    if (error != std::errc() || before_first || value >= kNoIndex) {
      if (!optional) fail(fmt::format("vertex index {}; expected 1 to {} or -1 to -{}", in_quotes(text), count, count));
      largest = {kNoIndex, lines_.number()};
      return kNoIndex;
    }
    if (value < 0) return static_cast<uint32_t>(static_cast<int64_t>(count) + value);
    if (static_cast<uint64_t>(value) > largest.index) largest = {static_cast<uint64_t>(value), lines_.number()};
    return static_cast<uint32_t>(value - 1);
  }

  ObjCorner corner(std::string_view word) {
    std::array<std::string_view, 3> parts{};
    std::string_view rest = word;
    std::size_t count = 0;
    for (bool more = true; more; ++count) {
      if (count == 3) fail(fmt::format("cannot read {} as the indices of a vertex; expected V, V/VT, V//VN or V/VT/VN", in_quotes(word)));
      const std::size_t slash = rest.find('/');
      more = slash != std::string_view::npos;
      parts[count] = rest.substr(0, slash);
      if (more) rest.remove_prefix(slash + 1);
    }
    return {index(parts[0], word, obj_.positions.size(), largest_position_, false),
            index(parts[1], word, obj_.uvs.size(), largest_uv_, true), index(parts[2], word, obj_.normals.size(), largest_normal_, true)};
  }

  void element(MeshTopology topology, std::size_t min_corners, std::string_view rest) {
    const std::size_t first = obj_.corners.size();
    // Neighboring corners with the same position are one corner. The ends of a polyline may meet.
    const auto is_repeated = [&](std::size_t at) {
      return obj_.corners.size() - first > 1 && obj_.corners[at].position == obj_.corners.back().position;
    };
    for (std::string_view word = take_value(rest); !word.empty(); word = take_value(rest)) {
      obj_.corners.push_back(corner(word));
      if (topology != MeshTopology::points && is_repeated(obj_.corners.size() - 2)) obj_.corners.pop_back();
    }
    while (topology == MeshTopology::triangles && is_repeated(first)) obj_.corners.pop_back();
    if (obj_.corners.size() - first < min_corners) {
      obj_.corners.resize(first);
      return warn_once(
          "few", fmt::format("an element has too few different vertices (expected at least {}); such elements are skipped", min_corners));
    }
    add_element(topology, first);
  }

  void add_element(MeshTopology topology, std::size_t first_corner) {
    if (state_changed_ || obj_.states.back().topology != topology) {
      obj_.states.push_back({topology, material_, smoothing_, name_});
      state_changed_ = false;
    }
    obj_.elements.push_back({static_cast<uint32_t>(first_corner), static_cast<uint32_t>(obj_.states.size() - 1)});
  }

  void use_material(std::string_view name) {
    const auto [known, added] = material_numbers_.try_emplace(std::string(name), static_cast<int>(obj_.materials.size()));
    if (added) obj_.materials.emplace_back(name);
    state_changed_ = state_changed_ || material_ != known->second;
    material_ = known->second;
  }

  // Only the name of the first element of a mesh is used, so a new name does not start a new state.
  void set_name(std::string_view name) { name_ = name; }

  void set_smoothing(std::string_view value) {
    uint32_t group = value == "on" ? 1 : 0;  // other words, such as "off", are 0
    std::from_chars(value.data(), value.data() + value.size(), group);
    state_changed_ = state_changed_ || smoothing_ != group;
    smoothing_ = group;
    obj_.has_smoothing = true;
  }

  void add_library(std::string_view names) {
    if (std::ranges::find(obj_.libraries, names) != obj_.libraries.end()) return;
    if (obj_.libraries.size() == kMaxLibraries) return warn_once("libraries", "too many material libraries; the rest is ignored");
    obj_.libraries.emplace_back(names);
  }

  // Positive indices may refer to statements that follow, so they are checked at the end.
  void check_indices() {
    const std::size_t count = obj_.positions.size();
    if (largest_position_.index > count) {
      fail(fmt::format("vertex index {}; expected at most {}, the number of vertices", largest_position_.index, count),
           largest_position_.line);
    }
    if (largest_uv_.index > obj_.uvs.size()) warn_range("texture coordinates", largest_uv_.line, obj_.uvs.size());
    if (largest_normal_.index > obj_.normals.size()) warn_range("normals", largest_normal_.line, obj_.normals.size());
  }

  // Skips faces, line segments and points with coordinates that are not finite.
  void skip_infinite_elements() {
    const std::vector<ObjElement> elements = std::move(obj_.elements);
    const std::vector<ObjCorner> corners = std::move(obj_.corners);
    obj_.elements.clear();
    obj_.corners.clear();
    std::size_t skipped = 0;
    const auto finite = [&](const ObjCorner& c) { return is_finite(obj_.positions[c.position]); };
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const std::size_t first = elements[i].first_corner, end = i + 1 < elements.size() ? elements[i + 1].first_corner : corners.size();
      const std::span<const ObjCorner> all(corners.data() + first, end - first);
      if (std::ranges::all_of(all, finite)) {
        add_corners(elements[i].state, all);
        continue;
      }
      ++skipped;
      const MeshTopology topology = obj_.states[elements[i].state].topology;
      if (topology == MeshTopology::triangles) continue;
      // The finite parts of a polyline, or the finite points.
      const std::size_t min_corners = topology == MeshTopology::lines ? 2 : 1;
      for (std::size_t begin = 0, k = 0; k <= all.size(); ++k) {
        if (k < all.size() && finite(all[k])) continue;
        if (k - begin >= min_corners) add_corners(elements[i].state, all.subspan(begin, k - begin));
        begin = k + 1;
      }
    }
    if (skipped > 0) warnings_.push_back(fmt::format("{} faces, lines or points with coordinates that are not finite; skipped", skipped));
  }

  void add_corners(uint32_t state, std::span<const ObjCorner> corners) {
    obj_.elements.push_back({static_cast<uint32_t>(obj_.corners.size()), state});
    obj_.corners.insert(obj_.corners.end(), corners.begin(), corners.end());
  }

  void warn_range(std::string_view what, std::size_t line, std::size_t count) {
    warnings_.push_back(fmt::format("line {}: indices of {} that are out of range (1 to {}) are ignored", line, what, count));
  }

  static constexpr std::size_t kMaxLibraries = 256;
  static constexpr glm::vec3 kNoColor{-1.0f};

  const std::filesystem::path& file_;
  TextLines lines_;
  std::vector<std::string>& warnings_;
  std::set<std::string> warned_;
  ObjText obj_;
  LargestIndex largest_position_, largest_uv_, largest_normal_;
  std::unordered_map<std::string, int> material_numbers_;
  int material_ = -1;
  uint32_t smoothing_ = 0;
  std::string name_;
  bool state_changed_ = true, has_infinite_ = false;
};

}  // namespace

ObjText parse_obj(const std::filesystem::path& file, std::string_view text, std::vector<std::string>& warnings) {
  return ObjParser(file, text, warnings).parse();
}

}  // namespace halfspace::HS_LANES
