// SPDX-License-Identifier: Apache-2.0
//
// Results of GLM functions as compiled in the including translation unit. The function is static so that every translation unit has its own
// copy.
#pragma once

#include <array>
#include <glm/glm.hpp>

inline constexpr int kGlmResults = 9;

static std::array<float, kGlmResults> glm_results(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 n = glm::normalize(a), r = glm::reflect(b, n);
  return {glm::dot(a, b), glm::length(a), glm::distance(a, b), n.x, n.y, n.z, r.x, r.y, r.z};
}

/// Results of a translation unit that includes only GLM.
std::array<float, kGlmResults> results_without_our_headers(const glm::vec3& a, const glm::vec3& b);
