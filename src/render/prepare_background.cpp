// SPDX-License-Identifier: Apache-2.0
//
// The background behind all objects.
#include "halfspace/render/preparation.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

// Sets the view direction of a background.
template <class Sky>
void set_view(Sky& sky, const View& view) {
  sky.forward_ws = glm::vec3(view.ray_ws);
  sky.right_ws = glm::vec3(view.ray_x_ws);
  sky.up_ws = glm::vec3(view.ray_y_ws);
}

}  // namespace

StarSky ScenePreparation::star_sky(double density, double brightness) const {
  StarSky sky;
  set_view(sky, view_);
  sky.brightness = static_cast<float>(brightness);
  sky.density = static_cast<float>(density);
  sky.pixel = static_cast<float>(2.0 * view_.tan_y / view_.height_px);
  return sky;
}

EnvironmentSky ScenePreparation::environment_sky() {
  const BackgroundDescription& b = scene_.background;
  EnvironmentSky sky;
  set_view(sky, view_);
  sky.environment = environments_.background();
  const auto stars_of = [&](const std::string& name) {
    const EnvironmentDescription& e = environments_.named(name).second;
    return e.type == EnvironmentType::night_sky ? star_sky(e.stars, e.star_brightness) : StarSky{.density = 0.0f};
  };
  sky.first_stars = stars_of(b.environment);
  sky.second_stars = stars_of(b.second);
  return sky;
}

// Draws one triangle behind everything.
void ScenePreparation::add_background() {
  DrawState state;
  state.depth.clip = ClipDepth::zero_to_one;
  state.depth.compare = CompareOp::greater_equal;  // passes where the depth buffer still has its clear value
  state.depth.write = false;
  static const std::vector<glm::vec2> corners(StarSky::kCorners.begin(), StarSky::kCorners.end());
  const auto add = [&](const auto& sky) {
    out_.draws.push_back({sky, make_vertex_view(stream(corners)), std::make_shared<const Indices>(Indices::sequential(3)), state});
  };
  switch (scene_.background.type) {
    case BackgroundType::color: break;  // the clear color
    case BackgroundType::stars: {
      StarSky sky = star_sky(scene_.background.density, scene_.background.brightness);
      sky.color = glm::vec3(scene_.background.color.linear);
      add(sky);
      break;
    }
    case BackgroundType::environment: add(environment_sky()); break;
    case BackgroundType::transparent:
      out_.transparent = true;
      out_.clear_color = glm::vec4(0.0f);
      break;
  }
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
