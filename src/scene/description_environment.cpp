// SPDX-License-Identifier: Apache-2.0
//
// Key tables, continued from description_keys.cpp: particles, environments, background, reflections and post-processing.
#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

template <>
struct ChoiceNames<EnvironmentType> {
  static constexpr std::array<std::string_view, 6> names{"equirect", "globe", "cube", "day_sky", "night_sky", "studio"};
};
template <>
struct ChoiceNames<BackgroundType> {
  static constexpr std::array<std::string_view, 4> names{"color", "stars", "environment", "transparent"};
};
template <>
struct ChoiceNames<LightFormat> {
  static constexpr std::array<std::string_view, 2> names{"rgba16f", "rgba32f"};
};
template <>
struct ChoiceNames<ToneCurve> {
  static constexpr std::array<std::string_view, 5> names{"none", "reinhard", "reinhard_extended", "exponential", "aces"};
};
template <>
struct ChoiceNames<ToneOn> {
  static constexpr std::array<std::string_view, 2> names{"luminance", "channel"};
};
template <>
struct ChoiceNames<DisplayEncoding> {
  static constexpr std::array<std::string_view, 2> names{"srgb", "gamma"};
};

template <>
struct ChoiceNames<ParticleSprite> {
  static constexpr std::array<std::string_view, 2> names{"original", "exact"};
};
template <>
struct ChoiceNames<ParticleArrangement> {
  static constexpr std::array<std::string_view, 4> names{"helix", "grid", "ball", "galaxy"};
};

Section section_of(ParticlesDescription& p) {
  using T = ParticlesDescription;
  static const std::vector<Key> keys{
      key<&T::sprite>("sprite",
                      "How a sphere is drawn; original: a circle sized by the distance of its center; exact: its true projection"),
      key<&T::count>("count", "Number of generated spheres; 0: none", {.low = 0, .high = kMaxParticles}),
      key<&T::arrangement>("arrangement", "Arrangement of generated spheres"),
      key<&T::file>("file", ".csv file with rows x,y,z[,radius[,r,g,b]], which replace the generated spheres"),
      key<&T::radius>("radius", "Radius of the spheres; 0: a fifth of orbit_radius for 12 spheres, smaller for more",
                      {.unit = "units", .low = 0, .high = 1e6}),
      key<&T::orbit_radius>("orbit_radius", "Radius of the helix, ball or galaxy; half the edge length of the grid",
                            {.unit = "units", .low = 1e-6, .high = 1e6}),
      key<&T::height>("height", "Height of the helix from its lowest to its highest sphere", {.unit = "units", .low = 0, .high = 1e6}),
      key<&T::angle>("angle", "Rotation of generated spheres around the y axis, from x to z", {.unit = "radians"}),
      key<&T::point_scale>("point_scale", "Scale of the point size, which is proportional to radius / distance; 0: the image width",
                           {.unit = "px", .low = 0, .high = 1e6, .only = "original"}),
      key<&T::color>("color", "Multiplier for the spheres' colors", {.low = 0}),
      key<&T::ambient>("ambient", "Multiplier for the ambient light", {.low = 0}),
      key<&T::diffuse>("diffuse", "Diffuse reflection factor", {.low = 0}),
      key<&T::specular>("specular", "Specular highlight factor, from the reflected ray", {.low = 0}),
      key<&T::shininess>("shininess", "Specular exponent; larger values give smaller and sharper highlights", {.low = 0, .high = 1e5}),
      key<&T::casts_shadow>("casts_shadow", "Whether exact spheres cast shadows"),
      key<&T::receives_shadow>("receives_shadow", "Whether exact spheres receive shadows, including those of other spheres"),
  };
  return {{keys, &p}};
}

Section section_of(EnvironmentDescription& e) {
  using T = EnvironmentDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "Panorama, map of a globe seen from its center, six cube map faces, or a generated sky"),
      key<&T::map>("map", "Panorama or map of a globe; a color gives uniform light", {.low = 0, .only = "equirect globe"}),
      key<&T::folder>("folder", "Folder with files named right, left, top, bottom, front and back", {.only = "cube"}),
      key<&T::right>("right", "Face at +x; if empty, read from the folder", {.only = "cube"}),
      key<&T::left>("left", "Face at -x; if empty, read from the folder", {.only = "cube"}),
      key<&T::top>("top", "Face at +y; if empty, read from the folder", {.only = "cube"}),
      key<&T::bottom>("bottom", "Face at -y; if empty, read from the folder", {.only = "cube"}),
      key<&T::front>("front", "Face at -z; if empty, read from the folder", {.only = "cube"}),
      key<&T::back>("back", "Face at +z; if empty, read from the folder", {.only = "cube"}),
      key<&T::size>("size", "Width of a generated face; 0: chosen for the view",
                    {.unit = "texels", .low = 0, .high = 4096, .only = "day_sky night_sky studio"}),
      key<&T::sun>("sun", "Direction towards the sun, any length; near the horizon: dusk", {.only = "day_sky"}),
      key<&T::clouds>("clouds", "Fraction of the sky covered by clouds", {.low = 0, .high = 1, .only = "day_sky"}),
      key<&T::milky_way>("milky_way", "Brightness factor of the Milky Way", {.low = 0, .high = 1e3, .only = "night_sky"}),
      key<&T::stars>("stars", "Density of stars; 1: about 25,000 in the whole sky", {.low = 0, .high = 1, .only = "night_sky"}),
      key<&T::star_brightness>("star_brightness", "Brightness of the brightest star, linear", {.low = 0, .only = "night_sky"}),
      key<&T::rotation>("rotation", "Rotation around x, y and z; applied in the order z, x, y", {.unit = "degrees"}),
      key<&T::brightness>("brightness", "Multiplier for the environment's light", {.low = 0, .high = 1e6}),
  };
  return {{keys, &e}};
}

Section section_of(BackgroundDescription& b) {
  using T = BackgroundDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "Type of background"),
      key<&T::color>("color", "Background color; with stars, the color between them", {.low = 0}),
      key<&T::brightness>("brightness", "Brightness of the brightest star, linear", {.low = 0, .only = "stars"}),
      key<&T::density>("density", "Density of stars; 1: about 25,000 in the whole sky", {.low = 0, .high = 1, .only = "stars"}),
      key<&T::environment>("environment", "Name of an environment; empty: the first", {.only = "environment"}),
      key<&T::second>("second", "Name of the environment to blend with; empty: none", {.only = "environment"}),
      key<&T::weight>("weight", "Weight of the second environment", {.low = 0, .high = 1, .only = "environment"}),
  };
  return {{keys, &b}};
}

Section section_of(ReflectionsDescription& r) {
  using T = ReflectionsDescription;
  static const std::vector<Key> keys{
      key<&T::on>("on", "Whether reflections are rendered"),
      key<&T::environment>("environment",
                           "Name of the environment that surfaces reflect, whose mean light is also ambient light; empty: the background, "
                           "without ambient light"),
  };
  return {{keys, &r}};
}

Section section_of(PostDescription& p) {
  using T = PostDescription;
  static const std::vector<Key> keys{
      key<&T::hdr>("hdr", "Whether to keep light above 1 for exposure and tone mapping; if off, the other keys of post are ignored"),
      key<&T::format>("format", "Format in which light is stored; the largest half float is 65504"),
      key<&T::exposure>("exposure", "Multiplier for the light", {.low = 0, .high = 1e9}),
      key<&T::auto_exposure>("auto_exposure", "Whether to also multiply by key_value / log-average luminance of the image"),
      key<&T::key_value>("key_value", "Value to which auto_exposure maps the log-average luminance", {.low = 0, .high = 1e3}),
      key<&T::tone>("tone", "Tone curve that maps light to [0, 1]; none: clamp to 1"),
      key<&T::tone_on>("tone_on", "Whether the curve is applied to the luminance or to each channel"),
      key<&T::white>("white", "Light that reinhard_extended maps to 1", {.low = 1e-3, .high = 1e6}),
      key<&T::encode>("encode", "Encoding of linear values: exact sRGB, or a power"),
      key<&T::gamma>("gamma", "Display gamma of encode gamma; its exponent is 1/gamma", {.low = 0.1, .high = 10}),
      key<&T::dither>("dither", "Whether 8x8 ordered dithering hides banding"),
      key<&T::tone_unlit>("tone_unlit", "Whether exposure and tone curve also apply to surfaces without lighting"),
  };
  return {{keys, &p}};
}

}  // namespace halfspace::HS_LANES
