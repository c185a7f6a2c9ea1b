// SPDX-License-Identifier: Apache-2.0
//
// Functions that return the data of a page as JSON. This header is private to the page_*.cpp files.
#pragma once

#include <nlohmann/json.hpp>

#include "explain/pixel_history.h"
#include "explain/stage_example.h"
#include "explain/stage_geometry.h"
#include "explain/stage_pictures.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/scene/description.h"

namespace halfspace {

using PageJson = nlohmann::ordered_json;

/// The input of the functions below.
struct PageInput {
  const SceneDescription& description;
  const PreparedScene& scene;
  const PassContext& context;
  const StageGeometry& geometry;
  const FrameTrace& trace;
  const Image<glm::vec4>& light;  ///< straight alpha, linear, as the frame stores it before exposure and tone curve
  const ValuePictures& values;
  glm::ivec2 pixel;               ///< the example pixel, counted from the upper left
  const TracedFragment* visible;  ///< the visible fragment of the example pixel; null if no fragment was shaded
  uint32_t primitive;             ///< its primitive, or kNoPrimitive
  const Workers& workers;
};
inline constexpr uint32_t kNoPrimitive = 0xffffffffu;

PageJson json_of(const glm::dvec2& v);
PageJson json_of(const glm::dvec3& v);
PageJson json_of(const glm::dvec4& v);
PageJson json_of(const glm::dmat4& m);  ///< 16 numbers, column by column

// page_geometry.cpp
PageJson draws_json(const PageInput& in);
PageJson transforms_json(const PageInput& in);
PageJson example_json(const PageInput& in);
PageJson outcomes_json(const PageInput& in);
PageJson clip_json(const PageInput& in);
PageJson wireframe_json(const PageInput& in);
PageJson bins_json(const PageInput& in);
PageJson perspective_json(const PageInput& in);

// page_emission.cpp
PageJson emission_json(const PageInput& in);  ///< null if no draw has a geometry function

// page_light.cpp
PageJson terms_json(const PageInput& in);
PageJson shadow_json(const PageInput& in);
PageJson tone_json(const PageInput& in);
PageJson samples_json(const PageInput& in);
PageJson sample_block_json(const PageInput& in);

// page_pictures.cpp
PageJson pictures_json(const PageInput& in, const Image<glm::u8vec4>& picture);
PageJson surfaces_json(const PageInput& in);
PageJson depth_json(const PageInput& in);
PageJson mip_json(const PageInput& in);
PageJson overdraw_json(const PageInput& in, const FrameTrace& trace);
PageJson tile_times_json(const PageInput& in);

// page_tile.cpp
PageJson tile_json(const PageInput& in);

// page_visible.cpp
PageJson visible_json(const PageInput& in);
PageJson layers_json(const PageInput& in);

PageJson statistics_json(const PassStatistics& s);

}  // namespace halfspace
