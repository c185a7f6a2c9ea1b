// SPDX-License-Identifier: Apache-2.0
//
// Prints the hash of results computed with the instruction set and SIMD width that this program is compiled for. It is compiled once per
// instruction set.
#include <cstdio>

#include "stability/lane_hash.h"

int main() {
  using namespace halfspace;
  std::printf("%016llx\n", static_cast<unsigned long long>(stability::lane_hash<Real>(stability::hash_inputs())));
}
