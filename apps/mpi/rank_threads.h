// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace halfspace {

/// The ranks of a node and the CPUs that they may use.
struct NodeRanks {
  int own = 1;    ///< CPUs of this rank
  int sum = 1;    ///< CPUs of each rank, added up
  int all = 1;    ///< CPUs that at least one rank may use
  int ranks = 1;  ///< on this node
};

/// Returns the number of threads for one rank. Ranks that are bound to CPUs of their own use them; ranks that may use the same CPUs share
/// them. quota: the CPUs that control groups allow, which all ranks of the node share, or 0 if there is no quota.
inline int threads_of_rank(const NodeRanks& node, int quota) {
  const auto share = static_cast<int>(int64_t{node.own} * node.all / std::max(node.sum, 1));
  const int allowed = quota > 0 ? std::min(share, quota / std::max(node.ranks, 1)) : share;
  return std::max(allowed, 1);
}

}  // namespace halfspace
