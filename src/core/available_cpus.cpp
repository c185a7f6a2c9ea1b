// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/available_cpus.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace halfspace::HS_LANES {

namespace {

// One of the two hierarchies that can limit CPU time.
struct Hierarchy {
  std::filesystem::path mounted_group;  // the group whose files are at the mount point
  std::filesystem::path mount_point;
  bool is_v2;
};

bool contains_word(const std::string& list, std::string_view word) {
  std::istringstream words(list);
  for (std::string w; std::getline(words, w, ',');) {
    if (w == word) return true;
  }
  return false;
}

// Each line of mountinfo: id, parent, device, root, mount point, options, optional fields, "-", type, source, options of the file system.
std::vector<Hierarchy> hierarchies(const std::filesystem::path& mountinfo) {
  std::vector<Hierarchy> found;
  std::ifstream file(mountinfo);
  for (std::string line; std::getline(file, line);) {
    std::istringstream before(line);
    std::string skipped, group, mount_point;
    before >> skipped >> skipped >> skipped >> group >> mount_point;
    const std::size_t dash = line.find(" - ");
    if (dash == std::string::npos) continue;
    std::istringstream after(line.substr(dash + 3));
    std::string type, source, options;
    after >> type >> source >> options;
    const bool is_v2 = type == "cgroup2";
    if (is_v2 || (type == "cgroup" && contains_word(options, "cpu"))) found.push_back({group, mount_point, is_v2});
  }
  return found;
}

// Returns the group of this process in a hierarchy. Each line of proc/self/cgroup: number, controllers, group; version 2 has the number 0
// and no controllers.
std::optional<std::filesystem::path> own_group(const std::filesystem::path& groups, bool is_v2) {
  std::ifstream file(groups);
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (is_v2 ? line.starts_with("0::") : contains_word(controllers, "cpu")) return line.substr(second + 1);
  }
  return std::nullopt;
}

// Returns the quota of one group in CPUs, or infinity.
double quota_of(const std::filesystem::path& folder, bool is_v2) {
  double quota = 0.0, period = 0.0;
  if (is_v2) {
    std::ifstream(folder / "cpu.max") >> quota >> period;  // "max 100000" is not a number
  } else {
    std::ifstream(folder / "cpu.cfs_quota_us") >> quota;  // −1: unlimited
    std::ifstream(folder / "cpu.cfs_period_us") >> period;
  }
  return quota > 0.0 && period > 0.0 ? quota / period : INFINITY;
}

// Returns the number of CPUs in the affinity mask of the calling thread. std::thread::hardware_concurrency() does not always respect it.
std::optional<int> affinity_cpus() {
  constexpr int kMaxCpus = 1 << 20;
  for (int cpus = CPU_SETSIZE; cpus <= kMaxCpus; cpus *= 2) {  // the call fails if the mask is smaller than that of the kernel
    std::vector<cpu_set_t> mask(CPU_ALLOC_SIZE(cpus) / sizeof(cpu_set_t));
    const std::size_t bytes = mask.size() * sizeof(cpu_set_t);
    if (::sched_getaffinity(0, bytes, mask.data()) == 0) return std::max(1, CPU_COUNT_S(bytes, mask.data()));
  }
  return std::nullopt;
}

}  // namespace

std::optional<int> cgroup_cpus(const std::filesystem::path& root) {
  double cpus = INFINITY;
  for (const Hierarchy& h : hierarchies(root / "proc/self/mountinfo")) {
    const std::optional<std::filesystem::path> group = own_group(root / "proc/self/cgroup", h.is_v2);
    if (!group) continue;
    const std::filesystem::path below = group->lexically_relative(h.mounted_group);
    if (below.empty() || *below.begin() == "..") continue;  // the files of this group are not mounted
    std::filesystem::path folder = root / h.mount_point.relative_path();
    cpus = std::min(cpus, quota_of(folder, h.is_v2));
    // A group is limited by the groups that contain it as well.
    for (const std::filesystem::path& name : below) {
      folder /= name;
      cpus = std::min(cpus, quota_of(folder, h.is_v2));
    }
  }
  if (cpus == INFINITY) return std::nullopt;
  return static_cast<int>(std::clamp(std::ceil(cpus), 1.0, 1e6));
}

AvailableCpus limited_cpus(int affinity, int online, std::optional<int> quota) {
  if (quota && *quota < affinity) return {*quota, CpuLimit::quota};
  return {affinity, affinity < online ? CpuLimit::affinity : CpuLimit::machine};
}

AvailableCpus available_cpus() {
  static const std::optional<int> quota = cgroup_cpus();
  const int online = std::max(1, static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN)));
  return limited_cpus(affinity_cpus().value_or(online), online, quota);
}

std::string_view name_of(CpuLimit limit) {
  switch (limit) {
    case CpuLimit::machine: return "all of this machine";
    case CpuLimit::affinity: return "affinity mask";
    case CpuLimit::quota: return "cgroup quota";
  }
  return {};
}

}  // namespace halfspace::HS_LANES
