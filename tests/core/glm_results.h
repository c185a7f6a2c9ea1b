// SPDX-License-Identifier: Apache-2.0
//
// What GLM's functions give where the header is included. Static functions: each translation unit keeps its own.
#pragma once

#include <array>
#include <glm/glm.hpp>

inline constexpr int kGlmResults = 9;

static std::array<float, kGlmResults> glm_results(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 n = glm::normalize(a), r = glm::reflect(b, n);
  return {glm::dot(a, b), glm::length(a), glm::distance(a, b), n.x, n.y, n.z, r.x, r.y, r.z};
}

/// The results of a translation unit that includes GLM alone.
std::array<float, kGlmResults> results_of_glm_alone(const glm::vec3& a, const glm::vec3& b);
