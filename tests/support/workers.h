// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/core/parallel.h"

namespace halfspace {

/// For tests where the number of threads does not matter: results do not depend on it (tests/property shows it).
inline const Workers& one_worker() {
  static const Workers workers(1);
  return workers;
}
inline const Workers& two_workers() {
  static const Workers workers(2);
  return workers;
}

}  // namespace halfspace
