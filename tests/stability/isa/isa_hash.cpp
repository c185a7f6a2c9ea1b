// SPDX-License-Identifier: Apache-2.0
//
// Prints the hash of what this program's own instruction set and lane width compute; it is compiled once for each.
#include <cstdio>

#include "stability/lane_hash.h"

int main() {
  using namespace halfspace;
  std::printf("%016llx\n", static_cast<unsigned long long>(stability::lane_hash<Real>(stability::hash_inputs())));
}
