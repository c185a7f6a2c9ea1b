// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/adaptive_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include "halfspace/core/check.h"
#include "halfspace/core/resource_limits.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kCells = MeasuredSquare::kCells, kHalf = kCells / 2;
constexpr GridVertex kCenter{kHalf, kHalf};
constexpr std::array<GridVertex, 4> kCorners{{{0, 0}, {kCells, 0}, {0, kCells}, {kCells, kCells}}};  // in the order of the quarters

// A side of a square: its middle, its ends and the quarters at it.
struct Side {
  GridVertex middle;
  std::array<std::size_t, 2> corners;
};
constexpr std::array<Side, 4> kSides{{{{kHalf, 0}, {0, 1}}, {{0, kHalf}, {0, 2}}, {{kCells, kHalf}, {1, 3}}, {{kHalf, kCells}, {2, 3}}}};

uint64_t key_of(const SquarePlace& p) {
  return (static_cast<uint64_t>(p.depth) << 32) | (static_cast<uint64_t>(p.y) << 16) | static_cast<uint64_t>(p.x);
}

}  // namespace

// Measures a patch as far as a view needs, and finds the vertices that bisect its triangles.
class AdaptiveSurface::SplitFinder {
 public:
  SplitFinder(const ParametricSurface& surface, const PatchGrid& grid, Squares& measured, const ViewedError& viewed, int patch)
      : surface_(surface), grid_(grid), measured_(measured), viewed_(viewed), root_{.place = {.patch = patch}, .quarters = nullptr} {
    measure(root_);
    leaves_ = {&root_};
  }

  // Marks the squares of the last division that are too coarse. Returns their number.
  std::size_t mark() {
    for (Square* s : leaves_) {
      const MeasuredSquare& m = *s->measured;
      const double finest = m.finest_error() + between(*s);
      s->is_coarse = viewed_.of(m.center(), m.radius() + finest, finest) > viewed_.allowed;
    }
    return static_cast<std::size_t>(std::ranges::count_if(leaves_, [](const Square* s) { return s->is_coarse; }));
  }

  // Divides the marked squares.
  void divide() {
    std::vector<Square*> quarters;
    for (Square* s : leaves_) {
      if (!s->is_coarse) continue;
      s->quarters = std::make_unique<std::array<Square, 4>>();
      for (int q = 0; q < 4; ++q) {
        Square& quarter = (*s->quarters)[static_cast<std::size_t>(q)];
        quarter.place = s->place.quarter(q);
        measure(quarter);
        quarters.push_back(&quarter);
      }
    }
    leaves_ = std::move(quarters);
  }

  // Finds the vertices. depth: of the deepest square of all patches.
  void find(int depth) {
    depth_ = depth;
    set_errors(root_);
    visit(root_);
  }

  const std::vector<GridVertex>& splits() const { return splits_; }
  double error() const { return error_; }  // the largest viewed error of the triangles that are not bisected

 private:
  struct Square {
    SquarePlace place;
    const MeasuredSquare* measured = nullptr;
    std::unique_ptr<std::array<Square, 4>> quarters;  // null if it is not divided
    bool is_coarse = false;
    double cells = 0.0;   // how far the surface may be from the triangles of the cells of the grid
    double halves = 0.0;  // error of the halves of the square, not less than that of their parts
  };

  void measure(Square& s) { s.measured = &measured_.try_emplace(key_of(s.place), surface_, grid_, s.place).first->second; }

  // Returns how far the surface may be from the grid of a square between its vertices.
  double between(const Square& s) const {
    return viewed_.between((grid_.columns * kCells) << s.place.depth, (grid_.rows * kCells) << s.place.depth);
  }

  // Sets the errors of a square and of its parts.
  void set_errors(Square& s) const {
    if (s.quarters == nullptr) {
      s.cells = between(s);
      s.halves = s.measured->error(kCenter) + s.cells;
      return;
    }
    for (Square& q : *s.quarters) {
      set_errors(q);
      s.cells = std::max(s.cells, q.measured->coarse_cell_error() + q.cells);
      s.halves = std::max(s.halves, q.halves);
    }
    s.halves = std::max(s.halves, s.measured->error(kCenter) + s.cells);
  }

  // Returns the error of the triangle between the center and a side of a square that is divided.
  double error_at(const Square& s, const Side& side) const {
    const auto& [a, b] = side.corners;
    return std::max({s.measured->error(side.middle) + s.cells, (*s.quarters)[a].halves, (*s.quarters)[b].halves});
  }

  // Returns true if the triangles that a vertex bisects must be bisected. outer: their other vertices.
  template <std::size_t n>
  bool must_split(const Square& s, GridVertex v, const std::array<GridVertex, n>& outer, double error, double& viewed) {
    const glm::dvec3 center(s.measured->position(v));
    double radius = 0.0;
    for (const GridVertex o : outer) radius = std::max(radius, glm::distance(center, glm::dvec3(s.measured->position(o))));
    viewed = viewed_.of(center, radius + error, error);
    if (!(viewed > viewed_.allowed)) {
      error_ = std::max(error_, viewed);
      return false;
    }
    const int shift = depth_ - s.place.depth;
    splits_.push_back({(s.place.x * kCells + v.i) << shift, (s.place.y * kCells + v.j) << shift});
    return true;
  }

  void visit(const Square& s) {
    if (s.quarters == nullptr) {
      for (const int half : {0, 1}) visit(s, square_half(half, kCells, s.place.is_falling()));
      return;
    }
    double viewed = 0.0;
    if (!must_split(s, kCenter, kCorners, s.halves, viewed)) return;
    std::array<bool, 4> is_split{};  // quarters
    for (const Side& side : kSides) {
      const auto& [a, b] = side.corners;
      if (must_split(s, side.middle, std::array{kCenter, kCorners[a], kCorners[b]}, error_at(s, side), viewed))
        is_split[a] = is_split[b] = true;
    }
    for (std::size_t q = 0; q < 4; ++q) {
      if (is_split[q]) visit((*s.quarters)[q]);
    }
  }

  void visit(const Square& s, const GridTriangle& t) {
    double viewed = 0.0;
    if (!must_split(s, t.split(), std::array{t.apex, t.b, t.c}, s.measured->error(t.split()) + s.cells, viewed)) return;
    if (!t.first().can_split()) {
      error_ = std::max(error_, 0.5 * viewed);
      return;
    }
    visit(s, t.first());
    visit(s, t.second());
  }

  const ParametricSurface& surface_;
  const PatchGrid& grid_;
  Squares& measured_;
  const ViewedError& viewed_;
  Square root_;
  std::vector<Square*> leaves_;  // of the last division
  int depth_ = 0;
  std::vector<GridVertex> splits_;
  double error_ = 0.0;
};

namespace {

// Makes the part of the mesh that belongs to a patch.
class PatchMesher {
 public:
  PatchMesher(const ParametricSurface& surface, const PatchGrid& grid, const GridVertices& vertices, int level)
      : surface_(surface), grid_(grid), vertices_(vertices), level_(level), numbers_(side() * side(), kNone) {}

  Mesh mesh_of(int patch) {
    mesh_ = {};
    used_.clear();
    patch_ = patch;
    for (const int half : {0, 1}) add(square_half(half, 1 << level_, true));
    for (const std::size_t v : used_) numbers_[v] = kNone;
    return std::move(mesh_);
  }

 private:
  static constexpr uint32_t kNone = ~uint32_t{0};
  std::size_t side() const { return (std::size_t{1} << level_) + 1; }

  void add(const GridTriangle& t) {
    if (t.can_split() && vertices_.contains(patch_, t.split())) {
      add(t.first());
      add(t.second());
      return;
    }
    const uint32_t a = number_of(t.apex), b = number_of(t.b), c = number_of(t.c);
    const glm::vec3 &p = mesh_.positions[a], &q = mesh_.positions[b], &r = mesh_.positions[c];
    if (p == q || q == r || r == p) return;  // an edge at a pole
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
  }

  uint32_t number_of(GridVertex v) {
    const std::size_t at = static_cast<std::size_t>(v.j) * side() + static_cast<std::size_t>(v.i);
    if (numbers_[at] != kNone) return numbers_[at];
    used_.push_back(at);
    const double u = grid_.u(patch_, v.i, level_), w = grid_.v(patch_, v.j, level_);
    const SurfaceVertex vertex = surface_.at(u, w);
    mesh_.positions.push_back(vertex.position);
    mesh_.normals.push_back(vertex.normal);
    mesh_.tangents.push_back(vertex.tangent);
    mesh_.uvs.emplace_back(glm::dvec2(u, w));
    return numbers_[at] = static_cast<uint32_t>(mesh_.positions.size() - 1);
  }

  const ParametricSurface& surface_;
  const PatchGrid& grid_;
  const GridVertices& vertices_;
  int level_, patch_ = 0;
  std::vector<uint32_t> numbers_;  // in the mesh, of the vertices of the patch
  std::vector<std::size_t> used_;
  Mesh mesh_;
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

// Releases the parts.
Mesh joined(std::vector<Mesh> parts) {
  Mesh out;
  std::size_t vertices = 0, indices = 0;
  for (const Mesh& part : parts) {
    vertices += part.positions.size();
    indices += part.indices.size();
  }
  out.positions.reserve(vertices);
  out.normals.reserve(vertices);
  out.tangents.reserve(vertices);
  out.uvs.reserve(vertices);
  out.indices.reserve(indices);
  for (Mesh& part : parts) {
    const auto first = static_cast<uint32_t>(out.positions.size());
    append(out.positions, part.positions);
    append(out.normals, part.normals);
    append(out.tangents, part.tangents);
    append(out.uvs, part.uvs);
    for (const uint32_t i : part.indices) out.indices.push_back(first + i);
    part = {};
  }
  return out;
}

std::size_t sum_of(const std::vector<std::size_t>& counts) { return std::accumulate(counts.begin(), counts.end(), std::size_t{0}); }

}  // namespace

AdaptiveSurface::AdaptiveSurface(const ParametricSurface& surface, const PatchGrid& grid)
    : surface_(surface), grid_(grid), squares_(static_cast<std::size_t>(grid.patches())) {
  HS_CHECK(grid.columns >= 1 && grid.rows >= 1, "AdaptiveSurface: the grid is empty; expected at least one column and one row");
}

AdaptiveMesh AdaptiveSurface::mesh(const ViewedError& viewed, const Workers& workers, const std::string& place) {
  const auto add_size = [](std::size_t n, const Squares& s) { return n + s.size(); };
  if (std::accumulate(squares_.begin(), squares_.end(), std::size_t{0}, add_size) > kMaxSquares) {
    for (Squares& s : squares_) s.clear();
  }
  const int patches = grid_.patches();
  std::vector<std::optional<SplitFinder>> finders(squares_.size());
  std::vector<std::size_t> coarse(squares_.size()), splits(squares_.size());
  const auto for_each_finder = [&](const auto& task) { workers.for_each(patches, [&](int p) { task(static_cast<std::size_t>(p)); }); };
  for_each_finder([&](std::size_t p) {
    finders[p].emplace(surface_, grid_, squares_[p], viewed, static_cast<int>(p));
    coarse[p] = finders[p]->mark();
  });
  int depth = 0;
  std::size_t needed = squares_.size();
  for (; depth < kMaxDepth; ++depth) {
    const std::size_t more = 4 * sum_of(coarse);
    if (more == 0 || needed + more > kMaxSquares) break;
    needed += more;
    const MemoryClaim claim(sizeof(MeasuredSquare) * more, place);
    for_each_finder([&](std::size_t p) {
      finders[p]->divide();
      coarse[p] = finders[p]->mark();
    });
  }
  for_each_finder([&](std::size_t p) {
    finders[p]->find(depth);
    splits[p] = finders[p]->splits().size();
  });

  const int level = depth + MeasuredSquare::kLevel;
  GridVertices vertices(grid_, level);
  AdaptiveMesh out{{}, 0.0, grid_.columns << level, grid_.rows << level};
  for (std::size_t p = 0; p < finders.size(); ++p) {
    for (const GridVertex v : finders[p]->splits()) vertices.add(static_cast<int>(p), v);
    out.error = std::max(out.error, finders[p]->error());
    finders[p].reset();
  }
  // A vertex bisects at most two triangles. The parts and the mesh exist at the same time.
  constexpr std::size_t kSplitBytes = 2 * (sizeof(SurfaceVertex) + sizeof(glm::vec2) + 2 * 3 * sizeof(uint32_t));
  const MemoryClaim claim(kSplitBytes * sum_of(splits), place);
  std::vector<Mesh> parts(squares_.size());
  const int tasks = std::min(patches, 4 * workers.threads());
  workers.for_each(tasks, [&](int task) {
    PatchMesher mesher(surface_, grid_, vertices, level);
    for (int p = task; p < patches; p += tasks) parts[static_cast<std::size_t>(p)] = mesher.mesh_of(p);
  });
  out.mesh = joined(std::move(parts));
  return out;
}

}  // namespace halfspace::HS_LANES
