// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// What limits the number of CPUs that a process can use.
enum class CpuLimit { machine, affinity, quota };

struct AvailableCpus {
  int count = 1;
  CpuLimit limit = CpuLimit::machine;
};

/// Returns the smaller of `affinity`, the CPUs of the affinity mask, and `quota`. online: the CPUs of the machine.
AvailableCpus limited_cpus(int affinity, int online, std::optional<int> quota);

/// Returns the number of CPUs in the affinity mask of the calling thread or, if that is less, the CPU time that the control groups of the
/// process allow, in CPUs, rounded up. The quota is read once.
AvailableCpus available_cpus();

/// Returns "all of this machine", "affinity mask" or "cgroup quota".
std::string_view name_of(CpuLimit limit);

/// Returns the CPUs that the control groups of this process allow, rounded up, or nullopt if they set no quota. Reads proc/self/cgroup and
/// proc/self/mountinfo in `root`, and the files of cgroup versions 1 and 2 below the mount points named there (Linux documentation,
/// admin-guide/cgroup-v2, cpu.max; scheduler/sched-bwc, cpu.cfs_quota_us).
std::optional<int> cgroup_cpus(const std::filesystem::path& root = "/");

}  // namespace halfspace::HS_LANES
