// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "scenes/workshop_contents.h"
#include "workloads/workload_random.h"

namespace halfspace::workshop {

namespace {

// Small things on the benches.
void add_small_things(Scene& s, const WorkshopMaterials& m) {
  const std::size_t bench = add_mesh(s, workbench()), bolts = add_mesh(s, bolt()), nuts = add_mesh(s, nut()),
                    springs = add_mesh(s, spring());
  const std::array<std::size_t, 3> gears{add_mesh(s, gear(12)), add_mesh(s, gear(18)), add_mesh(s, gear(30))};
  const std::size_t jars = add_mesh(s, jar()), vises = add_mesh(s, vise());
  const std::array<std::size_t, 4> metals{m.steel, m.brass, m.dark, m.rust};
  WorkloadRandom random(121);
  for (const double middle : {-3.6, -0.6, 2.4}) {
    place(s, bench, m.bench, placed({middle, 0, -3.8}));
    place(s, vises, m.blue, placed({middle - 1.0, kBenchHeight, -3.5}));
    const auto somewhere = [&] {
      const double x = middle + random.between(-1.2, 1.2);
      return glm::dvec3{x, kBenchHeight, random.between(-4.1, -3.45)};
    };
    const auto metal = [&] { return metals[random.below(4)]; };
    for (int i = 0; i < 34; ++i) {
      const glm::dvec3 at = somewhere();
      const double turn = random.unit();
      const bool lies = random.below(3) > 0;
      place(s, bolts, metal(), lies ? placed(at + glm::dvec3(0, 0.016, 0), turn) * turned_z(-0.25) : placed(at, turn));
    }
    for (int i = 0; i < 26; ++i) {
      const glm::dvec3 at = somewhere();
      const double turn = random.unit();
      place(s, nuts, metal(), placed(at, turn));
    }
    for (int i = 0; i < 9; ++i) {
      const glm::dvec3 at = somewhere();
      const double size = random.between(0.035, 0.12), turn = random.unit();
      const bool leans = i % 4 == 3;
      const glm::dmat4 lying = placed(at, turn, glm::dvec3(size)),
                       leaning = placed({at.x, at.y + 0.95 * size, -4.2}, 0.0, glm::dvec3(size)) * turned_x(0.22);
      place(s, gears[static_cast<std::size_t>(i) % 3], metal(), leans ? leaning : lying);
    }
    for (int i = 0; i < 4; ++i) {
      const glm::dvec3 at = somewhere();
      place(s, springs, m.steel, placed(at));
    }
    for (int i = 0; i < 4; ++i) {
      const glm::dvec3 at{middle + 0.35 + 0.2 * i, kBenchHeight, -4.1};
      place(s, jars, m.glass, placed(at));
      for (int k = 0; k < 6; ++k) {
        const double x = random.between(-0.03, 0.03), z = random.between(-0.03, 0.03), turn = random.unit();
        place(s, k % 2 == 0 ? nuts : bolts, metal(), placed(at + glm::dvec3(x, 0.008 + 0.016 * k, z), turn, glm::dvec3(0.8)));
      }
    }
  }
}

// Larger things on the benches.
void add_bench_things(Scene& s, const WorkshopMaterials& m) {
  const std::size_t cans = add_mesh(s, can()), bottles = add_mesh(s, bottle()), boxes = add_mesh(s, cardboard_box()),
                    coils = add_mesh(s, coil());
  const std::array<std::size_t, 4> colors{m.red, m.blue, m.label, m.yellow};
  for (int i = 0; i < 3; ++i) {
    const double x = -3.6 + 3.0 * i;
    const auto at = [&](double dx, double z) { return glm::dvec3(x + dx, kBenchHeight, z); };
    for (int k = 0; k < 3; ++k) {
      place(s, cans, colors[static_cast<std::size_t>(i + k) % 4],
            placed(at(-0.75 + 0.19 * k, -4.08), 0.2 * k, glm::dvec3(0.9 + 0.1 * (k % 2))));
      place(s, bottles, k == 1 ? m.emerald : m.amber, placed(at(0.02 + 0.11 * k, -4.12)));
    }
    place(s, boxes, m.cardboard, placed(at(1.1, -4.05), 0.02, {0.24, 0.15, 0.2}));
    place(s, boxes, i == 1 ? m.red : m.green, placed(at(-0.45, -3.6), 0.04 * i, {0.34, 0.14, 0.18}));
    place(s, coils, m.dark, placed(at(0.95, -3.6), 0.1 * i, glm::dvec3(0.6)));
  }
}

}  // namespace

void add_benches(Scene& s, const WorkshopMaterials& m) {
  add_small_things(s, m);
  add_bench_things(s, m);
}

void add_tools(Scene& s, const WorkshopMaterials& m) {
  place(s, pegboard(), m.pegs, placed({-0.6, 1.3, -4.32}));
  const std::array<Tool, 4> tools{wrench(), hammer(), saw(), screwdriver()};
  std::array<std::array<std::size_t, 2>, 4> meshes{};
  for (std::size_t i = 0; i < tools.size(); ++i) meshes[i] = {add_mesh(s, tools[i].head), add_mesh(s, tools[i].handle)};
  const std::array<std::size_t, 4> handles{m.bench, m.red, m.yellow, m.blue};
  WorkloadRandom random(131);
  const auto hang = [&](std::size_t kind, double x, double y, double scale) {
    const glm::dmat4 at = placed({x, y, -4.3}, 0.0, glm::dvec3(scale)) * turned_z(random.between(-0.012, 0.012));
    place(s, meshes[kind][0], kind == 2 ? m.steel : m.dark, at);
    place(s, meshes[kind][1], kind == 3 ? handles[1 + random.below(3)] : m.bench, at);
  };
  for (int i = 0; i < 16; ++i) hang(0, -4.6 + 0.13 * i, 1.85 + 0.012 * i, 0.7 + 0.055 * i);
  for (int i = 0; i < 7; ++i) hang(1, -2.2 + 0.3 * i, 1.95, 1.0 + 0.08 * i);
  for (int i = 0; i < 5; ++i) hang(2, 0.45 + 0.72 * i, 2.35, 1.0 + 0.06 * i);
  for (int i = 0; i < 18; ++i) hang(3, -2.25 + 0.12 * i, 1.5, 0.9 + 0.04 * (i % 5));
  for (int i = 0; i < 9; ++i) hang(0, 0.4 + 0.16 * i, 1.75, 1.4 - 0.06 * i);
  for (int i = 0; i < 8; ++i) hang(3, 2.1 + 0.16 * i, 1.75, 1.5 - 0.07 * i);
  for (int i = 0; i < 3; ++i) {  // left on the benches
    for (std::size_t k = 0; k < 4; ++k) {
      const double turns = 0.31 * static_cast<double>(k) + 0.13 * i, scale = 1.1;
      const glm::dmat4 at =
          placed({-3.9 + 3.0 * i + 0.36 * static_cast<double>(k), kBenchHeight, -3.62}, turns, glm::dvec3(scale)) * turned_x(-0.25);
      place(s, meshes[k][0], k == 2 ? m.steel : m.dark, at);
      place(s, meshes[k][1], k == 3 ? m.red : m.bench, at);
    }
  }
}

}  // namespace halfspace::workshop
