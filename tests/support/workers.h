// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/core/parallel.h"

namespace halfspace {

/// For tests in which the thread count does not matter. Results do not depend on it, which tests/property verifies.
inline const Workers& one_worker() {
  static const Workers workers(1);
  return workers;
}
inline const Workers& two_workers() {
  static const Workers workers(2);
  return workers;
}

}  // namespace halfspace
