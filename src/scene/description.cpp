// SPDX-License-Identifier: Apache-2.0
//
// The tables of all keys. A scene file, --set, `halfspace list` and the JSON Schema know no others.
#include "halfspace/scene/description.h"

namespace halfspace {

template <>
struct ChoiceNames<Projection> {
  static constexpr std::array<std::string_view, 2> names{"perspective", "orthographic"};
};
template <>
struct ChoiceNames<LightType> {
  static constexpr std::array<std::string_view, 3> names{"directional", "point", "spot"};
};
template <>
struct ChoiceNames<Falloff> {
  static constexpr std::array<std::string_view, 2> names{"attenuation", "physical"};
};
template <>
struct ChoiceNames<LightModel> {
  static constexpr std::array<std::string_view, 3> names{"lambert", "phong", "blinn_phong"};
};
template <>
struct ChoiceNames<ShadingRate> {
  static constexpr std::array<std::string_view, 5> names{"none", "flat", "provoking", "gouraud", "phong"};
};
template <>
struct ChoiceNames<DetailChoice> {
  static constexpr std::array<std::string_view, 4> names{"auto", "none", "map", "bump"};
};
template <>
struct ChoiceNames<BumpMethod> {
  static constexpr std::array<std::string_view, 2> names{"gradient", "difference"};
};
template <>
struct ChoiceNames<TextureSource> {
  static constexpr std::array<std::string_view, 18> names{
      "file",         "earth_color",     "earth_height",    "earth_normal", "moon_color",   "moon_height",
      "checkerboard", "grass_color",     "bark_color",      "bark_height",  "bricks_color", "bricks_height",
      "facade_color", "facade_specular", "facade_emissive", "rock_color",   "rock_height",  "hills_height"};
};
template <>
struct ChoiceNames<Filter> {
  static constexpr std::array<std::string_view, 3> names{"nearest", "bilinear", "trilinear"};
};
template <>
struct ChoiceNames<Wrap> {
  static constexpr std::array<std::string_view, 4> names{"repeat", "mirrored", "clamp", "border"};
};
template <>
struct ChoiceNames<Shape> {
  static constexpr std::array<std::string_view, 9> names{"uv_sphere", "icosphere", "sphere", "plane",     "cube",
                                                         "cylinder",  "cone",      "torus",  "torus_knot"};
};
template <>
struct ChoiceNames<NormalSource> {
  static constexpr std::array<std::string_view, 3> names{"pixel", "vertex", "undisplaced"};
};
template <>
struct ChoiceNames<ShadowMethod> {
  static constexpr std::array<std::string_view, 10> names{"none", "hard",  "bilinear", "pcf3", "pcf5",
                                                          "pcf7", "vogel", "pcss",     "vsm",  "moments"};
};
template <>
struct ChoiceNames<ShadowBias> {
  static constexpr std::array<std::string_view, 9> names{"none",           "constant", "slope", "angle",   "normal_offset",
                                                         "receiver_plane", "adaptive", "auto",  "original"};
};
template <>
struct ChoiceNames<ShadowFaces> {
  static constexpr std::array<std::string_view, 3> names{"front", "back", "both"};
};
template <>
struct ChoiceNames<AnimationType> {
  static constexpr std::array<std::string_view, 4> names{"rate", "orbit", "wave", "keyframes"};
};
template <>
struct ChoiceNames<Easing> {
  static constexpr std::array<std::string_view, 3> names{"linear", "smooth", "step"};
};

namespace {

constexpr double kTiny = 1e-6;

constexpr const char* kGenerated =
    "earth_color earth_height earth_normal moon_color moon_height checkerboard grass_color bark_color bark_height bricks_color "
    "bricks_height facade_color "
    "facade_specular facade_emissive rock_color rock_height hills_height";

}  // namespace

Section section_of(SceneHead& s) {
  static const std::vector<Key> keys{
      key<&SceneHead::title>("title", "What the scene shows, in one line"),
      key<&SceneHead::camera>("camera", "Name of the camera to render by; empty: the first"),
      key<&SceneHead::ambient>("ambient", "Light that comes from everywhere, linear", {.low = 0, .high = kMaxCount}),
      key<&SceneHead::samples>("samples", "Samples of a pixel that find edges: 1, 2, 4 or 8", {.low = 1, .high = 8}),
  };
  return {{keys, &s}};
}

Section section_of(CameraDescription& c) {
  using T = CameraDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "Projection"),
      key<&T::position>("position", "Where the eye is", {.unit = "units"}),
      key<&T::target>("target", "The point in the picture's middle", {.unit = "units"}),
      key<&T::up>("up", "Direction that points upwards in the picture"),
      key<&T::fov>("fov", "Vertical angle of view", {.unit = "degrees", .low = 0.01, .high = 179, .only = "perspective"}),
      key<&T::height>("height", "What the picture's height spans",
                      {.unit = "units", .low = kTiny, .high = kMaxCount, .only = "orthographic"}),
      key<&T::near>("near", "Nearest distance that is drawn", {.unit = "units", .low = kTiny, .high = kMaxCount}),
      key<&T::far>("far", "Farthest distance that is drawn", {.unit = "units", .low = kTiny, .high = kMaxCount}),
  };
  return {{keys, &c}};
}

Section section_of(LightDescription& l) {
  using T = LightDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "Kind of light"),
      key<&T::direction>("direction", "Where the light comes from, any length; a spot shines the other way", {.only = "directional spot"}),
      key<&T::position>("position", "Where the light is", {.unit = "units", .only = "point spot"}),
      key<&T::color>("color", "Colour, linear", {.low = 0}),
      key<&T::intensity>("intensity", "Factor of the colour", {.low = 0}),
      key<&T::ambient>("ambient", "Factor of its ambient light, which is the same everywhere", {.low = 0}),
      key<&T::diffuse>("diffuse", "Factor of its diffuse light", {.low = 0}),
      key<&T::specular>("specular", "Factor of its highlights", {.low = 0}),
      key<&T::falloff>("falloff", "How light fades: by attenuation, or physically as 1 / d^2", {.only = "point spot"}),
      key<&T::attenuation>("attenuation", "Terms c, l, q of 1 / (c + l d + q d^2) at distance d", {.low = 0, .only = "point spot"}),
      key<&T::inner>("inner", "Angle to the axis up to which it shines in full",
                     {.unit = "degrees", .low = 0, .high = 180, .only = "spot"}),
      key<&T::outer>("outer", "Angle to the axis from which on it is dark", {.unit = "degrees", .low = 0.01, .high = 180, .only = "spot"}),
      key<&T::shadow>("shadow", "Whether the light casts shadows"),
      key<&T::size>("size", "Radius, or of a directional light half the angle it spans, in degrees", {.low = 0, .high = 1e6}),
  };
  return {{keys, &l}};
}

Section section_of(TextureDescription& t) {
  using T = TextureDescription;
  static const std::vector<Key> keys{
      key<&T::source>("source", "A file, or the generator that makes the map"),
      key<&T::file>("file", "Image file", {.only = "file"}),
      key<&T::width>("width", "Width of the generated map, an even number; 0: what the view needs",
                     {.unit = "texels", .low = 0, .high = 16384, .only = kGenerated}),
      key<&T::filter>("filter", "How texels are mixed"),
      key<&T::wrap_s>("wrap_s", "What lies beyond the left and right edge"),
      key<&T::wrap_t>("wrap_t", "What lies beyond the upper and lower edge"),
      key<&T::anisotropy>("anisotropy", "Most samples along a stretched footprint", {.low = 1, .high = 16}),
  };
  return {{keys, &t}};
}

Section section_of(SurfaceDescription& s) {
  using T = SurfaceDescription;
  static const std::vector<Key> keys{
      key<&T::color>("color", "Colour of the surface, or its map", {.low = 0}),
      key<&T::tint>("tint", "Factor of the colour", {.low = 0}),
      key<&T::ambient>("ambient", "Factor of the ambient light", {.low = 0}),
      key<&T::ambient_map>("ambient_map", "Map of that factor", {.low = 0}),
      key<&T::diffuse>("diffuse", "Factor of the light that is sent back every way", {.low = 0}),
      key<&T::diffuse_map>("diffuse_map", "Map of that factor", {.low = 0}),
      key<&T::specular>("specular", "Factor of the highlight", {.low = 0}),
      key<&T::specular_map>("specular_map", "Map of that factor", {.low = 0}),
      key<&T::shininess>("shininess", "Exponent of the highlight: larger is smaller and sharper", {.low = 0, .high = 1e5}),
      key<&T::shininess_map>("shininess_map", "Map of a factor of the exponent, not decoded from sRGB", {.low = 0, .high = 1}),
      key<&T::emissive>("emissive", "Light of the surface's own", {.low = 0}),
      key<&T::emissive_map>("emissive_map", "Map of its factor", {.low = 0}),
      key<&T::reflection>("reflection", "Factor of the light of the surroundings that is mirrored; for shading phong",
                          {.low = 0, .high = 1e3}),
      key<&T::textured>("textured", "Whether maps of colour count"),
      key<&T::model>("model", "Highlight: none, by the reflected ray, by the half vector"),
      key<&T::shading>("shading", "How often light is computed: never, by triangle, by vertex, by pixel"),
      key<&T::two_sided>("two_sided", "Whether both sides are seen; a plane's always are"),
      key<&T::normal>("normal", "What gives pixels' normals their detail; auto: the map that there is"),
      key<&T::normal_map>("normal_map", "Normal map in tangent space, green up; a colour: none", {.low = 0}),
      key<&T::normal_strength>("normal_strength", "Factor of the normal map's tilt", {.low = 0, .high = 1000}),
      key<&T::normal_flip_green>("normal_flip_green", "Whether the normal map has green down"),
      key<&T::bump_map>("bump_map", "Map of heights for bumps; a colour: none", {.low = 0}),
      key<&T::bump_scale>("bump_scale", "Height of bumps between the map's 0 and 1", {.unit = "units", .low = -1e6, .high = 1e6}),
      key<&T::bump_method>("bump_method", "Slope of bumps: of the filtered heights, or by differences in 2x2 pixels"),
  };
  return {{keys, &s}};
}

std::string_view first_map(const SurfaceDescription& s) {
  const std::pair<std::string_view, const MapValue&> maps[] = {{"color", s.color},
                                                               {"ambient_map", s.ambient_map},
                                                               {"diffuse_map", s.diffuse_map},
                                                               {"specular_map", s.specular_map},
                                                               {"shininess_map", s.shininess_map},
                                                               {"emissive_map", s.emissive_map},
                                                               {"normal_map", s.normal_map},
                                                               {"bump_map", s.bump_map}};
  for (const auto& [key, map] : maps) {
    if (is_map(map)) return key;
  }
  return {};
}

Section section_of(Placement& p) {
  static const std::vector<Key> keys{
      key<&Placement::position>("position", "Where the object's origin is", {.unit = "units"}),
      key<&Placement::rotation>("rotation", "Turns about x, y and z; z first, then x, then y", {.unit = "degrees"}),
      key<&Placement::scale>("scale", "Factor along x, y and z; not 0"),
  };
  return {{keys, &p}};
}

Section section_of(ObjectDescription& o) {
  using T = ObjectDescription;
  static const std::vector<Key> keys{
      key<&T::shape>("shape", "Generator of the mesh; sphere: exact, by a ray a pixel, without maps"),
      key<&T::radius>("radius", "Radius; of a torus, to its tube's middle",
                      {.unit = "units", .low = kTiny, .high = 1e6, .only = "uv_sphere icosphere sphere cylinder cone torus torus_knot"}),
      key<&T::tube>("tube", "Radius of the tube", {.unit = "units", .low = kTiny, .high = 1e6, .only = "torus torus_knot"}),
      key<&T::length>("length", "From the bottom to the top", {.unit = "units", .low = kTiny, .high = 1e6, .only = "cylinder cone"}),
      key<&T::latitudes>("latitudes", "Bands from the top to the bottom, or round a tube",
                         {.low = 2, .high = 8192, .only = "uv_sphere cylinder cone torus torus_knot"}),
      key<&T::longitudes>("longitudes", "Sectors round the axis",
                          {.low = 3, .high = 16384, .only = "uv_sphere cylinder cone torus torus_knot"}),
      key<&T::level>("level", "How often each triangle is divided into four", {.low = 0, .high = 8, .only = "icosphere"}),
      key<&T::size>("size", "Length of an edge", {.unit = "units", .low = kTiny, .high = 1e6, .only = "plane cube"}),
      key<&T::segments>("segments", "Parts that an edge is divided into", {.low = 1, .high = 1024, .only = "plane cube"}),
      key<&T::tiles_u>("tiles_u", "How often a map of colours repeats along u",
                       {.low = 1, .high = 4096, .only = "icosphere plane cube cylinder cone torus torus_knot"}),
      key<&T::tiles_v>("tiles_v", "How often a map of colours repeats along v",
                       {.low = 1, .high = 4096, .only = "icosphere plane cube cylinder cone torus torus_knot"}),
      key<&T::visible>("visible", "Whether the object is drawn"),
      key<&T::casts_shadow>("casts_shadow", "Whether it shades others"),
      key<&T::receives_shadow>("receives_shadow", "Whether others, or itself, shade it"),
      key<&T::height>("height", "Map of heights that displaces the surface; a colour: none", {.low = 0}),
      key<&T::height_scale>("height_scale", "Height between the map's 0 and 1", {.unit = "units", .low = -1e6, .high = 1e6}),
      key<&T::height_zero>("height_zero", "The map's value that displaces nothing", {.low = 0, .high = 1}),
      key<&T::height_smoothing>("height_smoothing", "Radius over which heights are averaged", {.unit = "texels", .low = 0, .high = 64}),
      key<&T::normals>("normals", "Normals of a displaced surface: by pixel, by vertex, or as before", {.only = "uv_sphere"}),
      key<&T::material>("material", "Name of a material; keys of the object's own override it"),
  };
  Section section{{keys, &o}};
  for (const Section& part : {section_of(o.surface), section_of(o.placement)}) section.insert(section.end(), part.begin(), part.end());
  return section;
}

Section section_of(ShadowDescription& s) {
  using T = ShadowDescription;
  static const std::vector<Key> keys{
      key<&T::method>("method", "How the map is filtered; none: no shadows, and no cost"),
      key<&T::bias>("bias", "How a surface is kept out of its own shadow"),
      key<&T::resolution>("resolution", "Width of a map, from 256 on; 0: as footprint asks",
                          {.unit = "texels", .low = 0, .high = kMaxShadowTexels}),
      key<&T::footprint>("footprint", "With resolution 0: what a texel spans at most on 95 % of the picture",
                         {.unit = "px", .low = 0.1, .high = 100}),
      key<&T::constant>("constant", "Constant part of the bias", {.unit = "texels", .low = 0, .high = 1000}),
      key<&T::slope>("slope", "Factor of the bias that grows with the light's angle", {.low = 0, .high = 1000}),
      key<&T::max_slope>("max_slope", "Largest tangent of the light's angle that a bias other than auto follows", {.low = 0, .high = 1e6}),
      key<&T::radius>("radius", "Of vogel's disk and of the moments' filter", {.unit = "texels", .low = 0, .high = 16}),
      key<&T::faces>("faces", "Faces of meshes that cast, as the light sees them; of spheres it is the front"),
      key<&T::cascades>("cascades", "Maps of a directional light, by distance", {.low = 1, .high = 4}),
      key<&T::cascade_growth>("cascade_growth", "0: even distances, 1: each cascade a constant times the one before",
                              {.low = 0, .high = 1}),
  };
  return {{keys, &s}};
}

Section section_of(AnimationDescription& a) {
  using T = AnimationDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "Kind of motion"),
      key<&T::target>("target", "Dotted path of the number or vector that changes"),
      key<&T::rate>("rate", "Change per second", {.only = "rate"}),
      key<&T::center>("center", "Middle of the ellipse", {.unit = "units", .only = "orbit"}),
      key<&T::a>("a", "Half axis of the ellipse, reached at phase 0", {.unit = "units", .only = "orbit"}),
      key<&T::b>("b", "Half axis of the ellipse, reached a quarter later", {.unit = "units", .only = "orbit"}),
      key<&T::mean>("mean", "Middle of the wave", {.only = "wave"}),
      key<&T::swing>("swing", "What the wave adds to it at phase 0; the key's range holds it", {.only = "wave"}),
      key<&T::period>("period", "Time of one turn", {.unit = "s", .low = kTiny, .only = "orbit wave"}),
      key<&T::phase>("phase", "Where the turn begins", {.unit = "turns", .only = "orbit wave"}),
      key<&T::keys>("keys", "Rows of seconds and value", {.only = "keyframes"}),
      key<&T::easing>("easing", "How it goes from row to row", {.only = "keyframes"}),
      key<&T::loop>("loop", "Begin again after the last row", {.only = "keyframes"}),
  };
  return {{keys, &a}};
}

Section section_of(Playback& p) {
  static const std::vector<Key> keys{
      key<&Playback::speed>("speed", "Factor of the time; 0 stands still"),
  };
  return {{keys, &p}};
}

Section section_of(TimeOfDay& t) {
  static const std::vector<Key> keys{
      key<&TimeOfDay::hours>("hours", "The hour at which animations begin; 12: noon", {.unit = "h", .low = 0, .high = 24}),
      key<&TimeOfDay::day>("day", "How long a day takes", {.unit = "s", .low = kTiny}),
  };
  return {{keys, &t}};
}

}  // namespace halfspace
