// SPDX-License-Identifier: Apache-2.0
//
// Series of workloads that differ in one number, from which charts are drawn: what does it cost when that number grows?
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sphere_camera.h"
#include "workload.h"

namespace halfspace {

/// A series. Its workloads are named SERIES=NUMBER.
struct Sweep {
  std::string name;
  std::vector<WorkloadKind> kinds;
};

/// triangle_size   area in px² of right triangles of one colour side by side, some 4 million px² in all, at most a million triangles
/// triangle_count  triangles of sphere_phong
/// overdraw        quads over the whole picture, Phong by pixel, back to front
/// varyings        floats from vertex to fragment, on the sphere of 20,000 triangles
std::span<const Sweep> sweeps();

// The numbers of each series, for all who draw it.
inline constexpr std::array<double, 12> kTriangleSizes{0.25, 1, 4, 16, 64, 256, 1024, 4096, 16384, 65536, 262144, 1e6};
int triangles_of_size(double area);
inline constexpr std::array<SphereDetail, 9> kTriangleCounts{
    {{11, 50}, {21, 80}, {41, 125}, {81, 200}, {126, 400}, {201, 800}, {401, 1250}, {801, 2000}, {1251, 4000}}};
inline constexpr std::array<int, 7> kOverdraws{1, 2, 4, 8, 16, 32, 64};
inline constexpr std::array<int, 5> kVaryings{0, 4, 8, 16, 32};

/// SERIES=NUMBER, with no more digits than the number needs.
std::string sweep_point(std::string_view series, double number);

}  // namespace halfspace
