// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/scene_background.h"

namespace halfspace::HS_LANES {

namespace {

// Sets the view direction of a background.
template <class Sky>
void set_view(Sky& sky, const View& view) {
  sky.forward_ws = glm::vec3(view.ray_ws);
  sky.right_ws = glm::vec3(view.ray_x_ws);
  sky.up_ws = glm::vec3(view.ray_y_ws);
}

StarSky star_sky(const View& view, double density, double brightness) {
  StarSky sky;
  set_view(sky, view);
  sky.brightness = static_cast<float>(brightness);
  sky.density = static_cast<float>(density);
  sky.pixel = static_cast<float>(2.0 * view.tan_y / view.height_px);
  return sky;
}

EnvironmentSky environment_sky(const BackgroundDescription& b, const View& view, SceneEnvironments& environments) {
  EnvironmentSky sky;
  set_view(sky, view);
  sky.environment = environments.background();
  const auto stars_of = [&](const std::string& name) {
    const EnvironmentDescription& e = environments.named(name).second;
    return e.type == EnvironmentType::night_sky ? star_sky(view, e.stars, e.star_brightness) : StarSky{.density = 0.0f};
  };
  sky.first_stars = stars_of(b.environment);
  sky.second_stars = stars_of(b.second);
  return sky;
}

}  // namespace

glm::vec4 background_color(const BackgroundDescription& background) { return {glm::vec3(background.color.linear), 1.0f}; }

std::optional<PreparedDraw> background_draw(const BackgroundDescription& background, const View& view, SceneEnvironments& environments) {
  DrawState state;
  state.depth.clip = ClipDepth::zero_to_one;
  state.depth.compare = CompareOp::greater_equal;  // passes where the depth buffer still has its clear value
  state.depth.write = false;
  static const std::vector<glm::vec2> corners(StarSky::kCorners.begin(), StarSky::kCorners.end());
  const auto draw_of = [&](const auto& sky) {
    return PreparedDraw{sky, make_vertex_view(stream(corners)), std::make_shared<const Indices>(Indices::sequential(3)), state};
  };
  switch (background.type) {
    case BackgroundType::color:
    case BackgroundType::transparent: break;
    case BackgroundType::stars: {
      StarSky sky = star_sky(view, background.density, background.brightness);
      sky.color = glm::vec3(background.color.linear);
      return draw_of(sky);
    }
    case BackgroundType::environment: return draw_of(environment_sky(background, view, environments));
  }
  return std::nullopt;
}

}  // namespace halfspace::HS_LANES
