// SPDX-License-Identifier: Apache-2.0
//
// What the geometry functions of the frame receive and emit.
#include "explain/page_data.h"
#include "explain/stage_emission.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace {

namespace {

PageJson vertices_json(const EmittedPrimitives& p, std::size_t primitive, glm::ivec2 size) {
  PageJson json = PageJson::array();
  const std::size_t n = p.vertices_per_primitive();
  for (std::size_t v = primitive * n; v < (primitive + 1) * n; ++v)
    json.push_back({{"clip", json_of(glm::dvec4(clip_position(p, v)))}, {"window", json_of(window_position(p, v, size))}});
  return json;
}

PageJson example_json(const PageInput& in, const StageEmission& e, std::size_t primitive) {
  const glm::ivec2 size(in.trace.width, in.trace.height);
  PageJson json{{"object", object_name(in.description, in.scene.draws[e.draw].source.object)},
                {"primitive", primitive},
                {"length", std::get<NormalLines>(in.scene.draws[e.draw].shader).length},
                {"received", vertices_json(e.received, primitive, size)},
                {"emitted", PageJson::array()}};
  for (std::size_t k = 0; k < 3; ++k) {
    const float* const normal = e.received.rows.data() + e.received.indices[3 * primitive + k] * e.received.row + 4;
    json["received"][k]["normal"] = {normal[0], normal[1], normal[2]};
  }
  for (const std::size_t i : emitted_for(e, primitive)) json["emitted"].push_back(vertices_json(e.emitted, i, size));
  return json;
}

}  // namespace

PageJson emission_json(const PageInput& in) {
  const std::vector<StageEmission> emissions = stage_emissions(in.scene, in.workers);
  if (emissions.empty()) return nullptr;
  PageJson json{{"calls", in.trace.statistics.geometry_invocations}, {"max_vertices", NormalLines::geometry_layout.max_vertices}};
  for (const StageEmission& e : emissions) {
    json["draws"].push_back({{"draw", e.draw},
                             {"received", e.received.primitive_count()},
                             {"emitted", e.emitted.primitive_count()},
                             {"vertices", e.emitted.vertex_count()}});
    const bool mirrored = glm::determinant(glm::dmat3(in.scene.draws[e.draw].source.world_from_object)) < 0.0;
    const std::optional<std::size_t> example = emission_example(e, mirrored, {in.trace.width, in.trace.height});
    if (example && !json.contains("example")) json["example"] = example_json(in, e, *example);
  }
  return json;
}

}  // namespace halfspace
