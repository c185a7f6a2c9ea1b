// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/available_cpus.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include "support/temporary_folder.h"

namespace halfspace {
namespace {

// A copy of the files in which the kernel describes the control groups of a process.
class Cgroups : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    const std::filesystem::path path = folder_.path() / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  void v2(const std::string& group, const std::string& mounted = "/") const {
    write("proc/self/mountinfo", "22 1 0:5 / /proc rw - proc proc rw\n30 22 0:27 " + mounted +
                                     " /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n");
    write("proc/self/cgroup", "0::" + group + "\n");
  }
  void v1(const std::string& group, const std::string& mounted = "/") const {
    write("proc/self/mountinfo", "40 30 0:29 " + mounted + " /sys/fs/cgroup/cpuacct,cpu rw - cgroup cgroup rw,cpuacct,cpu\n" +
                                     "41 30 0:30 / /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n");
    write("proc/self/cgroup", "4:cpuset:/\n3:cpuacct,cpu:" + group + "\n");
  }
  std::optional<int> cpus() const { return cgroup_cpus(folder_.path()); }

 private:
  TemporaryFolder folder_;
};

TEST_F(Cgroups, WithoutQuota) {
  EXPECT_EQ(cpus(), std::nullopt) << "no files";
  v2("/user/job");
  EXPECT_EQ(cpus(), std::nullopt) << "no quota files";
  write("sys/fs/cgroup/user/job/cpu.max", "max 100000\n");
  EXPECT_EQ(cpus(), std::nullopt);
  v1("/docker/abc");
  write("sys/fs/cgroup/cpuacct,cpu/docker/abc/cpu.cfs_quota_us", "-1\n");
  write("sys/fs/cgroup/cpuacct,cpu/docker/abc/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(cpus(), std::nullopt);
}

TEST_F(Cgroups, QuotasAreRoundedUp) {
  v2("/job");
  for (const auto& [text, expected] : {std::pair{"100000 100000", 1}, {"150000 100000", 2}, {"20000 100000", 1}, {"800000 50000", 16}}) {
    write("sys/fs/cgroup/job/cpu.max", text);
    EXPECT_EQ(cpus(), expected) << text;
  }
  for (const char* text : {"", "0 100000", "-5 100000", "5", "nonsense", "5 0"}) {
    write("sys/fs/cgroup/job/cpu.max", text);
    EXPECT_EQ(cpus(), std::nullopt) << text;
  }
}

TEST_F(Cgroups, TheSmallestQuotaOfAllParentsApplies) {
  v2("/slice/job/step");
  write("sys/fs/cgroup/slice/job/step/cpu.max", "400000 100000");
  write("sys/fs/cgroup/slice/job/cpu.max", "max 100000");
  EXPECT_EQ(cpus(), 4);
  write("sys/fs/cgroup/slice/cpu.max", "300000 100000");
  EXPECT_EQ(cpus(), 3);
  write("sys/fs/cgroup/cpu.max", "200000 100000");  // in a container, the mount point is a group with a quota
  EXPECT_EQ(cpus(), 2);
  write("sys/fs/cgroup/slice/other/cpu.max", "100000 100000");
  EXPECT_EQ(cpus(), 2);
}

TEST_F(Cgroups, VersionOneAndMountedGroups) {
  v1("/docker/abc", "/docker/abc");
  write("sys/fs/cgroup/cpuacct,cpu/cpu.cfs_quota_us", "250000\n");
  write("sys/fs/cgroup/cpuacct,cpu/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(cpus(), 3);
  v1("/docker/abc/job", "/docker/abc");
  write("sys/fs/cgroup/cpuacct,cpu/job/cpu.cfs_quota_us", "150000\n");
  write("sys/fs/cgroup/cpuacct,cpu/job/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(cpus(), 2);
  v1("/elsewhere", "/docker/abc");  // the group of another container is mounted
  EXPECT_EQ(cpus(), std::nullopt);
}

TEST(AvailableCpus, AreLimitedByMaskAndQuota) {
  const auto expect = [](int affinity, int online, std::optional<int> quota, int count, CpuLimit limit) {
    const AvailableCpus cpus = limited_cpus(affinity, online, quota);
    EXPECT_EQ(cpus.count, count);
    EXPECT_EQ(cpus.limit, limit) << name_of(cpus.limit);
  };
  expect(8, 8, std::nullopt, 8, CpuLimit::machine);
  expect(8, 8, 8, 8, CpuLimit::machine);
  expect(8, 8, 64, 8, CpuLimit::machine);
  expect(3, 8, std::nullopt, 3, CpuLimit::affinity);
  expect(3, 8, 3, 3, CpuLimit::affinity);
  expect(3, 8, 2, 2, CpuLimit::quota);
  expect(8, 8, 1, 1, CpuLimit::quota);
}

// Sets the affinity mask of the calling thread for the time of a test.
class AffinityMask {
 public:
  explicit AffinityMask(const cpu_set_t& mask) {
    ::sched_getaffinity(0, sizeof before_, &before_);
    works_ = ::sched_setaffinity(0, sizeof mask, &mask) == 0;
  }
  ~AffinityMask() { ::sched_setaffinity(0, sizeof before_, &before_); }
  bool works() const { return works_; }

 private:
  cpu_set_t before_;
  bool works_;
};

TEST(AvailableCpus, FollowTheAffinityMask) {
  cpu_set_t all;
  ASSERT_EQ(::sched_getaffinity(0, sizeof all, &all), 0);
  EXPECT_EQ(available_cpus().count, std::min(CPU_COUNT(&all), cgroup_cpus().value_or(CPU_COUNT(&all))));
  int first = 0;
  while (!CPU_ISSET(first, &all)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  const AffinityMask mask(one);
  ASSERT_TRUE(mask.works());
  EXPECT_EQ(available_cpus().count, 1);
}

}  // namespace
}  // namespace halfspace
