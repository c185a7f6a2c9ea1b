// SPDX-License-Identifier: Apache-2.0
//
// draws_10k: ten thousand draws of two triangles, each with its own vertices and colour; what a draw costs.
#include <array>

#include "families.h"
#include "workload_canvas.h"
#include "workload_constant.h"

namespace halfspace {

namespace {

constexpr int kColumns = 100;

class Draws final : public Workload {
 public:
  explicit Draws(WorkloadSize size) : canvas_(size) {
    for (int i = 0; i < kColumns * kColumns; ++i) add_quad(i % kColumns, i / kColumns);
  }

  void frame(const Workers& workers) override {
    Pass pass = canvas_.pass();
    for (const Quad& q : quads_) pass.draw(q.shader, vertices(stream(std::span<const glm::vec3>(q.corners))), indices_, workload_state());
    pass.run(workers);
  }
  WorkloadPicture picture() const override { return canvas_.picture(); }
  WorkloadTruth truth() const override {
    WorkloadTruth target = canvas_.truth();
    for (const Quad& q : quads_)
      draw_naive(target, q.shader, vertices(stream(std::span<const glm::vec3>(q.corners))), indices_, workload_state());
    return target;
  }

 private:
  struct Quad {
    ConstantShader shader;
    std::array<glm::vec3, 4> corners;
  };

  // Four fifths of a cell of the picture, coloured by its place.
  void add_quad(int column, int row) {
    const auto place = [](double cell) { return 2.0 * cell / kColumns - 1.0; };
    const double x0 = place(column), x1 = place(column + 0.8), y0 = place(row), y1 = place(row + 0.8);
    const auto corner = [](double x, double y) { return glm::vec3(glm::dvec3(x, y, 0.0)); };
    const auto share = [](int i) { return static_cast<float>(i) / kColumns; };
    quads_.push_back({{{share(column), share(row), 0.5f, 1.0f}}, {corner(x0, y0), corner(x1, y0), corner(x0, y1), corner(x1, y1)}});
  }

  static constexpr std::array<uint32_t, 6> kTriangles{0, 1, 2, 2, 1, 3};
  Canvas canvas_;
  std::vector<Quad> quads_;
  Indices indices_{std::span<const uint32_t>(kTriangles), 4};
};

}  // namespace

std::unique_ptr<Workload> prepare_draws_10k(WorkloadSize size, WorkloadAssets&) { return std::make_unique<Draws>(size); }

}  // namespace halfspace
