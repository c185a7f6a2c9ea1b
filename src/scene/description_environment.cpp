// SPDX-License-Identifier: Apache-2.0
//
// The tables of keys, continued from description.cpp: particles, what surrounds a scene, and how it is shown.
#include "halfspace/scene/description.h"

namespace halfspace {

template <>
struct ChoiceNames<EnvironmentType> {
  static constexpr std::array<std::string_view, 5> names{"equirect", "globe", "cube", "day_sky", "night_sky"};
};
template <>
struct ChoiceNames<BackgroundType> {
  static constexpr std::array<std::string_view, 3> names{"color", "stars", "environment"};
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
      key<&T::sprite>("sprite", "A circle sized by the centre alone, or the sphere as it projects"),
      key<&T::count>("count", "How many spheres are generated; 0: none", {.low = 0, .high = kMaxParticles}),
      key<&T::arrangement>("arrangement", "Where generated spheres are"),
      key<&T::file>("file", "File of rows x,y,z[,radius[,r,g,b]] (.csv), instead of generated spheres"),
      key<&T::radius>("radius", "Radius of the spheres; 0: a fifth of orbit_radius for 12, smaller for more",
                      {.unit = "units", .low = 0, .high = 1e6}),
      key<&T::orbit_radius>("orbit_radius", "Radius of the helix, the ball or the galaxy; half the edge of the grid",
                            {.unit = "units", .low = 1e-6, .high = 1e6}),
      key<&T::height>("height", "From the helix's lowest sphere to its highest", {.unit = "units", .low = 0, .high = 1e6}),
      key<&T::angle>("angle", "Turn of what is generated about the y axis, from x to z", {.unit = "radians"}),
      key<&T::point_scale>("point_scale", "What radius / distance is multiplied by for a point's size; 0: the picture's width",
                           {.unit = "px", .low = 0, .high = 1e6, .only = "original"}),
      key<&T::color>("color", "Factor of the spheres' own colours", {.low = 0}),
      key<&T::ambient>("ambient", "Factor of the ambient light", {.low = 0}),
      key<&T::diffuse>("diffuse", "Factor of the light that is sent back every way", {.low = 0}),
      key<&T::specular>("specular", "Factor of the highlight, by the reflected ray", {.low = 0}),
      key<&T::shininess>("shininess", "Exponent of the highlight: larger is smaller and sharper", {.low = 0, .high = 1e5}),
      key<&T::casts_shadow>("casts_shadow", "Whether exact spheres shade others"),
      key<&T::receives_shadow>("receives_shadow", "Whether others, or each other, shade exact spheres"),
  };
  return {{keys, &p}};
}

Section section_of(EnvironmentDescription& e) {
  using T = EnvironmentDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "A panorama seen from within, the map of a globe round the eye, six faces, or a generated sky"),
      key<&T::map>("map", "Panorama or map of a globe; a colour: the same light from everywhere", {.low = 0, .only = "equirect globe"}),
      key<&T::folder>("folder", "Folder of files named right, left, top, bottom, front, back", {.only = "cube"}),
      key<&T::right>("right", "Face at +x; empty: from the folder", {.only = "cube"}),
      key<&T::left>("left", "Face at -x; empty: from the folder", {.only = "cube"}),
      key<&T::top>("top", "Face at +y; empty: from the folder", {.only = "cube"}),
      key<&T::bottom>("bottom", "Face at -y; empty: from the folder", {.only = "cube"}),
      key<&T::front>("front", "Face at -z; empty: from the folder", {.only = "cube"}),
      key<&T::back>("back", "Face at +z; empty: from the folder", {.only = "cube"}),
      key<&T::size>("size", "Edge of a generated face; 0: what the view needs",
                    {.unit = "texels", .low = 0, .high = 4096, .only = "day_sky night_sky"}),
      key<&T::sun>("sun", "Where the sun is seen, any length; low: dusk", {.only = "day_sky"}),
      key<&T::clouds>("clouds", "How much of the sky clouds cover", {.low = 0, .high = 1, .only = "day_sky"}),
      key<&T::milky_way>("milky_way", "Factor of the Milky Way's light", {.low = 0, .high = 1e3, .only = "night_sky"}),
      key<&T::stars>("stars", "How many stars; 1: some 25,000 in all the sky", {.low = 0, .high = 1, .only = "night_sky"}),
      key<&T::star_brightness>("star_brightness", "Of the brightest star, linear", {.low = 0, .only = "night_sky"}),
      key<&T::rotation>("rotation", "Turns about x, y and z; z first, then x, then y", {.unit = "degrees"}),
      key<&T::brightness>("brightness", "Factor of its light", {.low = 0, .high = 1e6}),
  };
  return {{keys, &e}};
}

Section section_of(BackgroundDescription& b) {
  using T = BackgroundDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "Kind of background"),
      key<&T::color>("color", "Colour, or that between the stars", {.low = 0}),
      key<&T::brightness>("brightness", "Of the brightest star, linear", {.low = 0, .only = "stars"}),
      key<&T::density>("density", "How many stars; 1: some 25,000 in all the sky", {.low = 0, .high = 1, .only = "stars"}),
      key<&T::environment>("environment", "Name of an environment; empty: the first", {.only = "environment"}),
      key<&T::second>("second", "Name of the environment to fade into; empty: none", {.only = "environment"}),
      key<&T::weight>("weight", "Weight of the second environment", {.low = 0, .high = 1, .only = "environment"}),
  };
  return {{keys, &b}};
}

Section section_of(ReflectionsDescription& r) {
  using T = ReflectionsDescription;
  static const std::vector<Key> keys{
      key<&T::on>("on", "Whether anything is mirrored"),
      key<&T::environment>("environment", "Name of the environment that is mirrored; empty: what the background shows"),
  };
  return {{keys, &r}};
}

Section section_of(PostDescription& p) {
  using T = PostDescription;
  static const std::vector<Key> keys{
      key<&T::hdr>("hdr", "Keep light beyond 1 until it is exposed and bent by the tone curve; off: the keys below do not count"),
      key<&T::format>("format", "Numbers that hold light; halfs end at 65504"),
      key<&T::exposure>("exposure", "Factor of the light", {.low = 0, .high = 1e9}),
      key<&T::auto_exposure>("auto_exposure", "Multiply by key_value over the picture's log-average luminance too"),
      key<&T::key_value>("key_value", "What auto_exposure makes of the average", {.low = 0, .high = 1e3}),
      key<&T::tone>("tone", "Curve from light to [0, 1]; none: what is above 1 becomes 1"),
      key<&T::tone_on>("tone_on", "What the curve bends: all channels by their luminance, or each"),
      key<&T::white>("white", "Light that reinhard_extended makes 1", {.low = 1e-3, .high = 1e6}),
      key<&T::encode>("encode", "From linear to codes: exactly sRGB, or a power"),
      key<&T::gamma>("gamma", "The power is 1 over this; for encode gamma", {.low = 0.1, .high = 10}),
      key<&T::dither>("dither", "Break up bands by an ordered pattern of 8x8 pixels"),
  };
  return {{keys, &p}};
}

}  // namespace halfspace
