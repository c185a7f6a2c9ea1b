// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/detail/simplified_mesh.h"

#include <dlfcn.h>
#include <meshoptimizer.h>
#include <sys/stat.h>

#include <algorithm>
#include <limits>
#include <string_view>

namespace halfspace::HS_LANES {

namespace {

// Returns the size and time of the shared library of meshoptimizer, which may be newer than its header. Code that was linked into a program
// is as old as the header.
std::string library_state() {
  Dl_info library{};
  struct stat file = {};
  if (::dladdr(reinterpret_cast<const void*>(&meshopt_simplifyScale), &library) == 0) return "";
  const std::string_view path = library.dli_fname;  // of a program, what it was started as
  if (path.find("libmeshoptimizer") == path.npos || ::stat(library.dli_fname, &file) != 0) return "";
  return std::to_string(file.st_size) + " " + std::to_string(file.st_mtim.tv_sec);
}

}  // namespace

// Increase the first number if the results of simplified() change.
std::string detail_version() {
  static const std::string version = "1 meshoptimizer " + std::to_string(MESHOPTIMIZER_VERSION) + " " + library_state();
  return version;
}

// meshoptimizer estimates the error of a vertex by the root of a weighted mean of squared distances to planes, which is not a bound. Its
// computation is serial and uses only addition, multiplication, division and square roots of floats.
SimplifiedMesh simplified(const OriginalMesh& mesh, int step, const Workers& workers) {
  const auto& [positions, indices] = mesh.triangles;
  SimplifiedMesh out;
  out.indices.resize(indices.size());
  const auto relative = static_cast<float>(detail_tolerance(0.5, step));
  out.indices.resize(meshopt_simplify(out.indices.data(), indices.data(), indices.size(), &positions[0].x, positions.size(),
                                      sizeof(glm::vec3), 0, relative, meshopt_SimplifyLockBorder, nullptr));
  if (out.indices.empty()) {
    out.error = std::numeric_limits<double>::infinity();
    return out;
  }
  // The second distance need not be known better than the first, because only the larger one counts.
  const double resolution = detail_tolerance(mesh.tree.longest_side(), step);
  const TriangleList list{positions, out.indices};
  out.error = distance_bound(mesh.triangles, TriangleTree(positions, out.indices), resolution, workers);
  out.error = std::max(out.error, distance_bound(list, mesh.tree, out.error, workers));
  return out;
}

}  // namespace halfspace::HS_LANES
