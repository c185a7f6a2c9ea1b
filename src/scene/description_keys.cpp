// SPDX-License-Identifier: Apache-2.0
//
// Tables of all scene keys, continued in description_environment.cpp. They define scene files, --set, `halfspace list` and the JSON Schema.
#include "halfspace/scene/description.h"

#include "halfspace/scene/lights.h"
#include "halfspace/scene/shapes.h"

namespace halfspace::HS_LANES {

template <>
struct ChoiceNames<Projection> {
  static constexpr std::array<std::string_view, 2> names{"perspective", "orthographic"};
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
  static constexpr std::array<std::string_view, 6> names{
      "nearest", "bilinear", "trilinear", "nearest_mipmap_nearest", "bilinear_mipmap_nearest", "nearest_mipmap_linear"};
};
template <>
struct ChoiceNames<Wrap> {
  static constexpr std::array<std::string_view, 5> names{"repeat", "mirrored", "clamp", "border", "mirrored_clamp"};
};
template <>
struct ChoiceNames<ModelUp> {
  static constexpr std::array<std::string_view, 3> names{"auto", "y", "z"};
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
      key<&SceneHead::title>("title", "Title of the scene, in one line"),
      key<&SceneHead::camera>("camera", "Name of the camera to render from; empty: the first camera"),
      key<&SceneHead::ambient>("ambient", "Ambient light, linear", {.low = 0, .high = kMaxCount}),
      key<&SceneHead::samples>("samples", "Samples per pixel for antialiasing: 1, 2, 4 or 8", {.low = 1, .high = 8}),
  };
  return {{keys, &s}};
}

Section section_of(CameraDescription& c) {
  using T = CameraDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "Projection"),
      key<&T::position>("position", "Position of the camera", {.unit = "units"}),
      key<&T::target>("target", "Point at the center of the image", {.unit = "units"}),
      key<&T::up>("up", "Direction that points up in the image"),
      key<&T::fov>("fov", "Vertical field of view", {.unit = "degrees", .low = 0.01, .high = 179, .only = "perspective"}),
      key<&T::height>("height", "Height of the view volume", {.unit = "units", .low = kTiny, .high = kMaxCount, .only = "orthographic"}),
      key<&T::near>("near", "Distance of the near plane; 0: so near that it cuts off nothing",
                    {.unit = "units", .low = 0, .high = kMaxCount}),
      key<&T::far>("far", "Distance of the far plane; 0: beyond everything (perspective), or 1000 behind the near plane (orthographic)",
                   {.unit = "units", .low = 0, .high = kMaxCount}),
  };
  return {{keys, &c}};
}

Section section_of(LightDescription& l) {
  using T = LightDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "Type of light"),
      key<&T::direction>("direction", "Direction towards the light, any length; a spot light shines the opposite way",
                         {.only = lights_with("direction")}),
      key<&T::position>("position", "Position of the light", {.unit = "units", .only = lights_with("position")}),
      key<&T::color>("color", "Color, linear", {.low = 0}),
      key<&T::intensity>("intensity", "Multiplier for the color", {.low = 0}),
      key<&T::ambient>("ambient", "Multiplier for the light's ambient contribution, which is the same everywhere", {.low = 0}),
      key<&T::diffuse>("diffuse", "Multiplier for the light's diffuse contribution", {.low = 0}),
      key<&T::specular>("specular", "Multiplier for the light's specular contribution", {.low = 0}),
      key<&T::falloff>("falloff", "Falloff with distance: by attenuation, or physical (1 / d^2)", {.only = lights_with("falloff")}),
      key<&T::attenuation>("attenuation", "Coefficients c, l, q of 1 / (c + l d + q d^2) at distance d",
                           {.low = 0, .only = lights_with("attenuation")}),
      key<&T::range>("range", "Distance at which the light has faded to zero, by a factor of 1 - (d / range)^4; 0: unlimited",
                     {.unit = "units", .low = 0, .only = lights_with("range")}),
      key<&T::inner>("inner", "Angle from the axis up to which the light has full intensity",
                     {.unit = "degrees", .low = 0, .high = 180, .only = lights_with("inner")}),
      key<&T::outer>("outer", "Angle from the axis beyond which there is no light",
                     {.unit = "degrees", .low = 0.01, .high = 180, .only = lights_with("outer")}),
      key<&T::shadow>("shadow", "Whether the light casts shadows"),
      key<&T::size>("size", "Radius; for a directional light, half the angle it subtends, in degrees", {.low = 0, .high = 1e6}),
  };
  return {{keys, &l}};
}

Section section_of(TextureDescription& t) {
  using T = TextureDescription;
  static const std::vector<Key> keys{
      key<&T::source>("source", "Image file, or name of a generator"),
      key<&T::file>("file", "Image file", {.only = "file"}),
      key<&T::width>("width", "Width of the generated map, an even number; 0: chosen for the view",
                     {.unit = "texels", .low = 0, .high = 16384, .only = kGenerated}),
      key<&T::filter>("filter", "Texture filter"),
      key<&T::wrap_s>("wrap_s", "Wrap mode beyond the left and right edges"),
      key<&T::wrap_t>("wrap_t", "Wrap mode beyond the top and bottom edges"),
      key<&T::anisotropy>("anisotropy", "Maximum number of anisotropic samples", {.low = 1, .high = 16}),
  };
  return {{keys, &t}};
}

Section section_of(SurfaceDescription& s) {
  using T = SurfaceDescription;
  static const std::vector<Key> keys{
      key<&T::color>("color", "Color of the surface, or a color map", {.low = 0}),
      key<&T::tint>("tint", "Multiplier for the color", {.low = 0}),
      key<&T::ambient>("ambient", "Multiplier for the ambient light", {.low = 0}),
      key<&T::ambient_map>("ambient_map", "Map that multiplies the ambient factor", {.low = 0}),
      key<&T::diffuse>("diffuse", "Diffuse reflection factor", {.low = 0}),
      key<&T::diffuse_map>("diffuse_map", "Map that multiplies the diffuse factor", {.low = 0}),
      key<&T::specular>("specular", "Specular highlight factor", {.low = 0}),
      key<&T::specular_map>("specular_map", "Map that multiplies the specular factor", {.low = 0}),
      key<&T::shininess>("shininess", "Specular exponent; larger values give smaller and sharper highlights", {.low = 0, .high = 1e5}),
      key<&T::shininess_map>("shininess_map", "Map that multiplies the exponent, not decoded from sRGB", {.low = 0, .high = 1}),
      key<&T::emissive>("emissive", "Light emitted by the surface", {.low = 0}),
      key<&T::emissive_map>("emissive_map", "Map that multiplies the emitted light", {.low = 0}),
      key<&T::reflection>("reflection", "Strength of the reflections of the environment; requires Phong shading", {.low = 0, .high = 1e3}),
      key<&T::opacity>("opacity", "Opacity; below 1, the surface is blended over what is behind it", {.low = 0, .high = 1}),
      key<&T::textured>("textured", "Whether color maps are used"),
      key<&T::model>("model", "Reflection model: diffuse only, or with a highlight from the reflected ray or from the half vector"),
      key<&T::shading>("shading", "How often lighting is computed: never, per triangle, per vertex, per pixel"),
      key<&T::two_sided>("two_sided", "Whether both sides are visible; planes are always two-sided"),
      key<&T::normal>("normal", "Source of surface detail; auto: normal_map if given, otherwise bump_map"),
      key<&T::normal_map>("normal_map", "Tangent-space normal map, green up; a color instead of a map turns it off", {.low = 0}),
      key<&T::normal_strength>("normal_strength", "Scale of the slopes in the normal map", {.low = 0, .high = 1000}),
      key<&T::normal_flip_green>("normal_flip_green", "Whether green points down in the normal map"),
      key<&T::bump_map>("bump_map", "Height map for bump mapping; a color instead of a map turns it off", {.low = 0}),
      key<&T::bump_scale>("bump_scale", "Height difference between the map values 0 and 1", {.unit = "units", .low = -1e6, .high = 1e6}),
      key<&T::bump_method>("bump_method", "Bump slopes: from the gradient of the filtered heights, or from differences within 2x2 pixels"),
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
      key<&Placement::position>("position", "Position of the object's origin", {.unit = "units"}),
      key<&Placement::rotation>("rotation", "Rotation around x, y and z; applied in the order z, x, y", {.unit = "degrees"}),
      key<&Placement::scale>("scale", "Scale along x, y and z; must not be 0"),
  };
  return {{keys, &p}};
}

Section section_of(ObjectDescription& o) {
  using T = ObjectDescription;
  static const std::vector<Key> keys{
      key<&T::shape>("shape", "Shape of the mesh; sphere: exact, ray traced per pixel, without maps; file: a model file"),
      key<&T::radius>("radius", "Radius; for torus and torus_knot, up to the middle of the tube",
                      {.unit = "units", .low = kTiny, .high = 1e6, .only = shapes_with("radius")}),
      key<&T::tube>("tube", "Radius of the tube", {.unit = "units", .low = kTiny, .high = 1e6, .only = shapes_with("tube")}),
      key<&T::length>("length", "Length from bottom to top", {.unit = "units", .low = kTiny, .high = 1e6, .only = shapes_with("length")}),
      key<&T::latitudes>("latitudes", "Number of bands from top to bottom, or around a tube",
                         {.low = 2, .high = 8192, .only = shapes_with("latitudes")}),
      key<&T::longitudes>("longitudes", "Number of sectors around the axis", {.low = 3, .high = 16384, .only = shapes_with("longitudes")}),
      key<&T::mesh_error>(
          "mesh_error", "Distance by which the mesh may be off in the image; the mesh then adapts to the view. 0: a regular mesh",
          {.unit = "px", .low = 0, .high = 100, .only = shapes_with("mesh_error")}),
      key<&T::level>("level", "Number of times each triangle is split into four", {.low = 0, .high = 8, .only = shapes_with("level")}),
      key<&T::size>("size", "Edge length", {.unit = "units", .low = kTiny, .high = 1e6, .only = shapes_with("size")}),
      key<&T::segments>("segments", "Number of segments per edge", {.low = 1, .high = 1024, .only = shapes_with("segments")}),
      key<&T::tiles_u>("tiles_u", "Number of repetitions of color maps along u", {.low = 1, .high = 4096, .only = shapes_with("tiles_u")}),
      key<&T::tiles_v>("tiles_v", "Number of repetitions of color maps along v", {.low = 1, .high = 4096, .only = shapes_with("tiles_v")}),
      key<&T::file>("file", "Model file: OBJ, glTF, GLB, PLY or STL", {.only = shapes_with("file")}),
      key<&T::allow_outside>("allow_outside", "Whether to read files outside the folder of the model that the model refers to",
                             {.only = shapes_with("allow_outside")}),
      key<&T::up_axis>("up_axis", "Axis of the file that points up; auto: z for STL, y for all others", {.only = shapes_with("up_axis")}),
      key<&T::model_scene>("model_scene", "Name or index of the scene in the file; empty: its default scene",
                           {.only = shapes_with("model_scene")}),
      key<&T::model_animation>("model_animation", "Name or index of the animation in the file; empty: none",
                               {.only = shapes_with("model_animation")}),
      key<&T::model_time>("model_time", "Time of the animation", {.unit = "s", .only = shapes_with("model_time")}),
      key<&T::model_variant>("model_variant", "Name or index of the material variant in the file; empty: the default materials",
                             {.only = shapes_with("model_variant")}),
      key<&T::model_materials>("model_materials", "Materials that replace those of the file, as NAME=MATERIAL, NAME=MATERIAL",
                               {.only = shapes_with("model_materials")}),
      key<&T::model_error>("model_error", "Distance by which outlines may be off, so that meshes can be simplified; 0: exact",
                           {.unit = "px", .low = 0, .high = 100, .only = shapes_with("model_error")}),
      key<&T::shadow_only>("shadow_only", "Whether to draw only the shadows on the plane, over the background",
                           {.only = shapes_with("shadow_only")}),
      key<&T::visible>("visible", "Whether the object is drawn"),
      key<&T::casts_shadow>("casts_shadow", "Whether the object casts shadows"),
      key<&T::receives_shadow>("receives_shadow", "Whether the object receives shadows, including its own"),
      key<&T::height>("height", "Height map that displaces the surface; a color instead of a map turns displacement off", {.low = 0}),
      key<&T::height_scale>("height_scale", "Height difference between the map values 0 and 1",
                            {.unit = "units", .low = -1e6, .high = 1e6}),
      key<&T::height_zero>("height_zero", "Map value that leaves the surface undisplaced", {.low = 0, .high = 1}),
      key<&T::height_smoothing>("height_smoothing", "Standard deviation of the Gaussian that smooths the heights",
                                {.unit = "texels", .low = 0, .high = 64}),
      key<&T::normals>("normals", "Normals of a displaced surface: per pixel, per vertex, or those of the undisplaced surface",
                       {.only = shapes_with("normals")}),
      key<&T::normal_lines>("normal_lines", "Length of lines that show the vertex normals, drawn by a geometry stage; 0: none",
                            {.unit = "units", .low = 0, .high = 1e6}),
      key<&T::material>("material", "Name of a material; keys of the object override it; empty: model files keep their own materials"),
      key<&T::parent>("parent", "Name of the object that position, rotation and scale are relative to; empty: none"),
  };
  Section section{{keys, &o}};
  for (const Section& part : {section_of(o.surface), section_of(o.placement)}) section.insert(section.end(), part.begin(), part.end());
  return section;
}

Section section_of(ShadowDescription& s) {
  using T = ShadowDescription;
  static const std::vector<Key> keys{
      key<&T::method>("method", "Shadow map filter; none: no shadows"),
      key<&T::bias>("bias", "Bias method against self-shadowing"),
      key<&T::resolution>("resolution", "Width of a shadow map, at least 256; 0: chosen by footprint",
                          {.unit = "texels", .low = 0, .high = kMaxShadowTexels}),
      key<&T::footprint>("footprint", "With resolution 0: maximum size of a shadow texel on 95% of the image",
                         {.unit = "px", .low = 0.1, .high = 100}),
      key<&T::constant>("constant", "Constant part of the bias", {.unit = "texels", .low = 0, .high = 1000}),
      key<&T::slope>("slope", "Multiplier for the slope-dependent part of the bias", {.low = 0, .high = 1000}),
      key<&T::max_slope>("max_slope", "Upper limit for the tangent of the angle of incidence; not used by auto", {.low = 0, .high = 1e6}),
      key<&T::radius>("radius", "Filter radius of vogel, vsm and moments", {.unit = "texels", .low = 0, .high = 16}),
      key<&T::faces>("faces", "Mesh faces that cast shadows, as seen from the light; spheres always use the front"),
      key<&T::cascades>("cascades", "Number of cascades of a directional light", {.low = 1, .high = 4}),
      key<&T::cascade_growth>("cascade_growth", "0: cascades of equal depth; 1: depths in geometric progression", {.low = 0, .high = 1}),
  };
  return {{keys, &s}};
}

Section section_of(AnimationDescription& a) {
  using T = AnimationDescription;
  static const std::vector<Key> keys{
      key<&T::type>("type", "Type of animation"),
      key<&T::target>("target", "Dotted path of the number or vector to animate"),
      key<&T::rate>("rate", "Change per second", {.only = "rate"}),
      key<&T::center>("center", "Center of the ellipse", {.unit = "units", .only = "orbit"}),
      key<&T::a>("a", "Semi-axis of the ellipse, reached at phase 0", {.unit = "units", .only = "orbit"}),
      key<&T::b>("b", "Semi-axis of the ellipse, reached a quarter turn later", {.unit = "units", .only = "orbit"}),
      key<&T::mean>("mean", "Mean of the wave", {.only = "wave"}),
      key<&T::swing>("swing", "Amplitude of the wave, reached at phase 0; the result is clamped to the key's range", {.only = "wave"}),
      key<&T::period>("period", "Duration of one period", {.unit = "s", .low = kTiny, .only = "orbit wave"}),
      key<&T::phase>("phase", "Phase at time 0", {.unit = "turns", .only = "orbit wave"}),
      key<&T::keys>("keys", "Keyframes as rows [seconds, value]", {.only = "keyframes"}),
      key<&T::easing>("easing", "Interpolation between keyframes", {.only = "keyframes"}),
      key<&T::loop>("loop", "Whether to start over after the last keyframe", {.only = "keyframes"}),
  };
  return {{keys, &a}};
}

Section section_of(Playback& p) {
  static const std::vector<Key> keys{
      key<&Playback::speed>("speed", "Playback speed; 0 freezes all animations"),
  };
  return {{keys, &p}};
}

Section section_of(TimeOfDay& t) {
  static const std::vector<Key> keys{
      key<&TimeOfDay::hours>("hours", "Hour at which animations start; 12: noon", {.unit = "h", .low = 0, .high = 24}),
      key<&TimeOfDay::day>("day", "Length of a day", {.unit = "s", .low = kTiny}),
  };
  return {{keys, &t}};
}

}  // namespace halfspace::HS_LANES
