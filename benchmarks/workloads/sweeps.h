// SPDX-License-Identifier: Apache-2.0
//
// Series of workloads that differ in one number, such as the triangle count. The charts show how the cost grows with that number.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "workloads/sphere_camera.h"
#include "workloads/workload.h"

namespace halfspace {

/// A series of workloads, which are named SERIES=NUMBER.
struct Sweep {
  std::string name;
  std::vector<WorkloadKind> kinds;
};

/// triangle_size   area in px² of adjacent single-color right triangles; about 4 million px² in total, at most a million triangles
/// triangle_count  number of triangles in sphere_phong
/// overdraw        number of quads that cover the whole image, with Phong shading per pixel, drawn back to front
/// varyings        number of float varyings, on the sphere with 20,000 triangles
std::span<const Sweep> sweeps();

// The numbers of each series, shared by all renderers.
inline constexpr std::array<double, 12> kTriangleSizes{0.25, 1, 4, 16, 64, 256, 1024, 4096, 16384, 65536, 262144, 1e6};
int triangles_of_size(double area);
inline constexpr std::array<SphereDetail, 9> kTriangleCounts{
    {{11, 50}, {21, 80}, {41, 125}, {81, 200}, {126, 400}, {201, 800}, {401, 1250}, {801, 2000}, {1251, 4000}}};
inline constexpr std::array<int, 7> kOverdraws{1, 2, 4, 8, 16, 32, 64};
inline constexpr std::array<int, 5> kVaryings{0, 4, 8, 16, 32};

/// Returns SERIES=NUMBER, with as few digits as possible.
std::string sweep_point(std::string_view series, double number);

}  // namespace halfspace
