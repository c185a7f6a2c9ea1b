// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/amplify/run_tessellation.h"

namespace halfspace::HS_LANES {

EmittedPrimitives run_tessellation(const TessellationStage& stage, const void* shader, const PrimitiveRows& patches) {
  PatchRows controlled;
  stage.control(shader, patches, controlled);
  EmittedPrimitives out;
  out.topology = topology_of(stage.options);
  out.row = static_cast<std::size_t>(stage.row);
  std::vector<glm::vec3> coordinates;
  std::vector<uint32_t> patch_of_vertex;
  Tessellation tessellation;
  for (std::size_t patch = 0; patch < controlled.levels.size(); ++patch) {
    tessellate(stage.options, controlled.levels[patch], tessellation);
    const auto first = static_cast<uint32_t>(coordinates.size());
    for (const uint32_t i : tessellation.indices) out.indices.push_back(first + i);
    coordinates.insert(coordinates.end(), tessellation.coordinates.begin(), tessellation.coordinates.end());
    patch_of_vertex.resize(coordinates.size(), static_cast<uint32_t>(patch));
    out.numbers.resize(out.primitive_count(), patches.primitives[patch]);
    out.instances.resize(out.primitive_count(), patches.instances[patch]);
  }
  out.rows.resize(coordinates.size() * out.row);
  stage.evaluate(
      shader, patches,
      {controlled.values.data(), patch_of_vertex.data(), coordinates.data(), static_cast<int>(coordinates.size()), out.rows.data()});
  return out;
}

Topology topology_of(const TessellatorOptions& options) {
  if (options.point_mode) return Topology::points;
  return options.domain == TessellationDomain::isolines ? Topology::lines : Topology::triangles;
}

}  // namespace halfspace::HS_LANES
