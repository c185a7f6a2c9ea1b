// SPDX-License-Identifier: Apache-2.0
#include "core/glm_results.h"

std::array<float, kGlmResults> results_without_our_headers(const glm::vec3& a, const glm::vec3& b) { return glm_results(a, b); }
