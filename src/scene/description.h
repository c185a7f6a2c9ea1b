// SPDX-License-Identifier: Apache-2.0
//
// A scene as described by its file: plain values with their defaults. The tables in description_keys.cpp and description_environment.cpp
// bind each value to a key.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "halfspace/scene/keys.h"
#include "halfspace/shading/texture/sampler.h"
#include "halfspace/shading/values/light_types.h"
#include "halfspace/shading/values/tone_types.h"

namespace halfspace::HS_LANES {

/// Named items, in file order.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

enum class Projection : uint8_t { perspective, orthographic };

/// A camera as a transform and a projection. The camera looks along −z, with y up.
struct CameraMatrices {
  glm::dmat4 world_from_camera{1.0};  ///< a rotation and a translation
  glm::dmat4 clip_from_camera{1.0};   ///< OpenGL's clip space: −w at the near plane, w at the far plane
};

struct CameraDescription {
  Projection type = Projection::perspective;
  glm::dvec3 position{0, 0, 5};  ///< world space
  glm::dvec3 target{0, 0, 0};    ///< world space
  glm::dvec3 up{0, 1, 0};
  double fov = 45.0;             ///< vertical, in degrees
  double height = 2.0;           ///< height of the view volume, in scene units
  double near = 0.0, far = 0.0;  ///< 0: chosen; see near_plane() and far_plane() in render/view.h
  /// Replaces all other members. No key sets it; see matrix_camera() in render/view.h.
  std::optional<CameraMatrices> matrices{};
};

enum class Falloff : uint8_t { attenuation, physical };

struct LightDescription {
  LightType type = LightType::directional;
  glm::dvec3 direction{0, 0, 1};  ///< towards the light, any length
  glm::dvec3 position{0, 0, 5};
  Color color{glm::dvec3(1.0)};
  double intensity = 1.0;
  double ambient = 0.0;  ///< ambient, diffuse and specular multiply color · intensity; ambient light is not attenuated
  double diffuse = 1.0, specular = 1.0;
  Falloff falloff = Falloff::attenuation;
  glm::dvec3 attenuation{1, 0, 0};
  double range = 0.0;                 ///< distance at which the light has faded to zero; 0: unlimited
  double inner = 20.0, outer = 30.0;  ///< degrees from the axis
  bool shadow = true;
  double size = 0.0;  ///< radius in scene units; for directional lights, half the angle subtended, in degrees
};

enum class TextureSource : uint8_t {
  file,
  earth_color,
  earth_height,
  earth_normal,
  moon_color,
  moon_height,
  checkerboard,
  grass_color,
  bark_color,
  bark_height,
  bricks_color,
  bricks_height,
  facade_color,
  facade_specular,
  facade_emissive,
  rock_color,
  rock_height,
  hills_height
};

/// Returns true for the tiling maps of procedural/patterns.h.
inline bool is_pattern(TextureSource source) { return source >= TextureSource::checkerboard; }

struct TextureDescription {
  TextureSource source = TextureSource::file;
  FilePath file;
  int width = 0;  ///< width of a generated map, even; 0: chosen for the view
  Filter filter = Filter::trilinear;
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  int anisotropy = 8;
};

/// Selects the normal detail of a surface. `automatic` uses the normal map if there is one, otherwise the bump map.
enum class DetailChoice : uint8_t { automatic, none, map, bump };
/// How the slope of a bump map is computed: as the gradient of the filtered heights, or from differences within 2x2 pixels.
enum class BumpMethod : uint8_t { gradient, difference };

/// Surface properties. Each factor is a constant multiplied by a map, and the map may also be a constant color.
struct SurfaceDescription {
  MapValue color = Color{glm::dvec3(1.0)};
  Color tint{glm::dvec3(1.0)};
  Color ambient{glm::dvec3(1.0)};
  MapValue ambient_map = Color{glm::dvec3(1.0)};
  Color diffuse{glm::dvec3(1.0)};
  MapValue diffuse_map = Color{glm::dvec3(1.0)};
  Color specular{glm::dvec3(0.0)};
  MapValue specular_map = Color{glm::dvec3(1.0)};
  double shininess = 32.0;
  MapValue shininess_map = Color{glm::dvec3(1.0)};
  Color emissive{glm::dvec3(0.0)};
  MapValue emissive_map = Color{glm::dvec3(1.0)};
  bool textured = true;  ///< false: color maps are replaced by 1
  Color reflection{glm::dvec3(0.0)};
  double opacity = 1.0;  ///< below 1: a transparent layer

  LightModel model = LightModel::blinn_phong;
  ShadingRate shading = ShadingRate::phong;
  bool two_sided = false;

  DetailChoice normal = DetailChoice::automatic;
  MapValue normal_map = Color{glm::dvec3(1.0)};  ///< a constant means no map
  double normal_strength = 1.0;
  bool normal_flip_green = false;
  MapValue bump_map = Color{glm::dvec3(1.0)};  ///< a constant means no map
  double bump_scale = 0.02;                    ///< height difference between map values 0 and 1, in world units
  BumpMethod bump_method = BumpMethod::gradient;
};

/// Returns the key of the first map of a surface, or an empty string if it has none.
std::string_view first_map(const SurfaceDescription& s);

/// `sphere` has no mesh: it is ray traced per pixel (shading/sphere/sphere_impostor.h), and its surface cannot have maps. `file` is a model
/// file, which has its own materials. Each shape has a row in the table in scene/shapes.cpp.
enum class Shape : uint8_t { uv_sphere, icosphere, sphere, plane, cube, cylinder, cone, torus, torus_knot, file };
inline constexpr std::size_t kShapes = 10;
/// The up axis of a model file. `automatic`: z for STL, otherwise y.
enum class ModelUp : uint8_t { automatic, y, z };
enum class NormalSource : uint8_t { pixel, vertex, undisplaced };

struct Placement {
  glm::dvec3 position{0.0};
  glm::dvec3 rotation{0.0};  ///< degrees around x, y, z; applied in the order z, x, y
  glm::dvec3 scale{1.0};
  std::optional<glm::dmat4> matrix{};  ///< affine; replaces all other members. No key sets it
};

struct ObjectDescription {
  Shape shape = Shape::uv_sphere;
  double radius = 1.0;
  double tube = 0.25;
  double length = 2.0;
  int latitudes = 64, longitudes = 128;
  double mesh_error = 0.0;  ///< allowed distance of an adaptive mesh from the surface, in pixels; 0: latitudes and longitudes
  int level = 5;
  double size = 2.0;
  int segments = 1;
  int tiles_u = 1, tiles_v = 1;
  FilePath file;
  bool allow_outside = false;  ///< open files outside of the folder of `file` that it refers to
  ModelUp up_axis = ModelUp::automatic;
  std::string model_scene;      ///< name or index in the file; empty: its default scene
  std::string model_animation;  ///< name or index in the file; empty: none
  std::string model_variant;    ///< name or index in the file; empty: the default materials
  std::string model_materials;  ///< materials of the scene that replace those of the file: "NAME=MATERIAL, NAME=MATERIAL"
  double model_time = 0.0;      ///< seconds
  double model_error = 0.0;     ///< allowed distance of the outlines of simplified meshes from the exact ones, in pixels; 0: not simplified
  bool shadow_only = false;
  bool visible = true;
  bool casts_shadow = true, receives_shadow = true;

  MapValue height = Color{glm::dvec3(0.0)};  ///< a constant means no map
  double height_scale = 0.02;                ///< height difference between map values 0 and 1, in scene units
  double height_zero = 0.5;                  ///< map value that leaves the surface undisplaced
  double height_smoothing = 1.0;             ///< standard deviation in texels
  NormalSource normals = NormalSource::pixel;
  double normal_lines = 0.0;  ///< length in scene units; 0: none

  std::string material;  ///< empty: none
  SurfaceDescription surface;
  std::string parent;  ///< object that `placement` is relative to; empty: the world
  Placement placement;
  std::vector<Placement> instances;  ///< copies placed relative to `placement`; empty: a single object at `placement`
};

enum class EnvironmentType : uint8_t { equirect, globe, cube, day_sky, night_sky, studio };

/// Light from infinitely far away, as a function of direction (see shading/environment/environment.h).
struct EnvironmentDescription {
  EnvironmentType type = EnvironmentType::equirect;
  MapValue map = Color{glm::dvec3(1.0)};  ///< if it is a texture, only its source is used
  FilePath folder;                        ///< contains files named right, left, top, bottom, front and back
  FilePath right, left, top, bottom, front, back;
  int size = 0;                    ///< face width of a generated sky; 0: chosen for the view
  glm::dvec3 sun{0.5, 0.6, -0.6};  ///< direction towards the sun, any length
  double clouds = 0.4;
  double milky_way = 1.0;
  double stars = 0.3;             ///< density, in the same unit as the background's
  double star_brightness = 0.05;  ///< linear
  glm::dvec3 rotation{0.0};       ///< degrees, like Placement::rotation
  double brightness = 1.0;
};

/// `transparent`: where nothing is drawn, alpha is 0.
enum class BackgroundType : uint8_t { color, stars, environment, transparent };

struct BackgroundDescription {
  BackgroundType type = BackgroundType::color;
  Color color{glm::dvec3(0.0)};
  double brightness = 1.0;
  double density = 0.3;
  std::string environment;  ///< empty: the first
  std::string second;       ///< empty: none
  double weight = 0.0;      ///< weight of `second`
};

/// The environment that is reflected by surfaces.
struct ReflectionsDescription {
  bool on = true;
  std::string environment;  ///< empty: the background, without its stars
};

enum class LightFormat : uint8_t { rgba16f, rgba32f };
enum class DisplayEncoding : uint8_t { srgb, gamma };

/// Conversion of light to pixel values.
struct PostDescription {
  bool hdr = false;  ///< false: light is clamped to [0, 1] and encoded as sRGB; all other members are ignored
  LightFormat format = LightFormat::rgba16f;
  double exposure = 1.0;
  bool auto_exposure = false;
  double key_value = 0.18;
  ToneCurve tone = ToneCurve::aces;
  ToneOn tone_on = ToneOn::channel;
  double white = 4.0;
  DisplayEncoding encode = DisplayEncoding::srgb;
  double gamma = 2.2;
  bool dither = false;
  bool tone_unlit = false;  ///< exposure and tone curve also apply to surfaces without lighting
};

/// `none`, followed by the values of ShadowFilter.
enum class ShadowMethod : uint8_t { none, hard, bilinear, pcf3, pcf5, pcf7, vogel, pcss, vsm, moments };
/// The faces of a closed surface that are drawn into shadow maps, as seen from the light.
enum class ShadowFaces : uint8_t { front, back, both };

/// Minimum and maximum shadow map width in texels. The minimum leaves room on all sides for the footprint of the widest filter.
inline constexpr int kMinShadowTexels = 256, kMaxShadowTexels = 8192;

struct ShadowDescription {
  ShadowMethod method = ShadowMethod::none;
  ShadowBias bias = ShadowBias::automatic;
  int resolution = 2048;   ///< width in texels; 0: chosen by `footprint`
  double footprint = 1.0;  ///< maximum size of a texel in pixels, on 95% of the image
  double constant = 1.0;   ///< texels
  double slope = 1.0;
  double max_slope = 16.0;
  double radius = 2.0;  ///< texels
  ShadowFaces faces = ShadowFaces::front;
  int cascades = 1;
  double cascade_growth = 0.75;  ///< 0: cascades of equal depth; 1: depths in geometric progression
};

enum class ParticleSprite : uint8_t { original, exact };
/// Maximum number of spheres in a particle system.
inline constexpr int kMaxParticles = 1000000;

enum class ParticleArrangement : uint8_t { helix, grid, ball, galaxy };

/// Spheres drawn as points (render/particles.h, shading/sphere/sphere_impostor.h).
struct ParticlesDescription {
  ParticleSprite sprite = ParticleSprite::original;
  int count = 0;  ///< number of generated spheres; 0: none
  ParticleArrangement arrangement = ParticleArrangement::helix;
  FilePath file;        ///< read instead of generating spheres
  double radius = 0.0;  ///< 0: chosen by the number of spheres
  double orbit_radius = 1.5;
  double height = 6.0;
  double angle = 0.0;        ///< radians
  double point_scale = 0.0;  ///< px; 0: the image width
  Color color{glm::dvec3(1.0)};
  Color ambient{glm::dvec3(1.0)};
  Color diffuse{glm::dvec3(1.0)};
  Color specular{glm::dvec3(0.0)};
  double shininess = 32.0;
  bool casts_shadow = true, receives_shadow = true;  ///< these two apply to exact sprites
};

enum class AnimationType : uint8_t { rate, orbit, wave, keyframes };
enum class Easing : uint8_t { linear, smooth, step };

/// The change in one key over time. `rate` is added to the key's value in the scene; the other types replace it.
struct AnimationDescription {
  AnimationType type = AnimationType::rate;
  std::string target;      ///< dotted path to a number or vector
  Numbers rate{0.0};       ///< per second
  glm::dvec3 center{0.0};  ///< orbit: center + a·cos φ + b·sin φ, φ = 2π(t / period + phase)
  glm::dvec3 a{1, 0, 0};
  glm::dvec3 b{0, 0, -1};
  Numbers mean{0.0};  ///< wave: mean + swing·cos φ, clamped to the key's range
  Numbers swing{1.0};
  double period = 10.0;  ///< seconds
  double phase = 0.0;    ///< turns
  Keyframes keys;
  Easing easing = Easing::linear;
  bool loop = true;
};

struct Playback {
  double speed = 1.0;
};

/// The time of day at which animations start: they are advanced by hours/24 of a day.
struct TimeOfDay {
  double hours = 0.0;
  double day = 24.0;  ///< seconds
};

/// The top-level keys of a scene file.
struct SceneHead {
  std::string title;
  std::string camera;  ///< empty: the first
  Color ambient{glm::dvec3(0.0)};
  int samples = 1;
};

struct SceneDescription {
  SceneHead head;
  Named<CameraDescription> cameras;
  Named<LightDescription> lights;
  Named<TextureDescription> textures;
  Named<EnvironmentDescription> environments;
  Named<SurfaceDescription> materials;
  Named<ObjectDescription> objects;
  Named<ParticlesDescription> particle_systems;  ///< in addition to `particles`
  Named<AnimationDescription> animations;
  BackgroundDescription background;
  ReflectionsDescription reflections;
  PostDescription post;
  ShadowDescription shadow;
  ParticlesDescription particles;
  Playback animation;
  TimeOfDay time;
};

// ---- sections --------------------------------------------------------------------------------------------------

Section section_of(SceneHead&);
Section section_of(CameraDescription&);
Section section_of(LightDescription&);
Section section_of(TextureDescription&);
Section section_of(EnvironmentDescription&);
Section section_of(SurfaceDescription&);
Section section_of(ObjectDescription&);
Section section_of(Placement&);
Section section_of(BackgroundDescription&);
Section section_of(ReflectionsDescription&);
Section section_of(PostDescription&);
Section section_of(ShadowDescription&);
Section section_of(ParticlesDescription&);
Section section_of(AnimationDescription&);
Section section_of(Playback&);
Section section_of(TimeOfDay&);

/// Calls visit(name, help, list) for each collection of named items.
template <class Scene, class F>
void for_each_collection(Scene& scene, F&& visit) {
  visit("cameras", "A camera", scene.cameras);
  visit("lights", "A light source", scene.lights);
  visit("textures", "An image file or a generated map, and how it is sampled", scene.textures);
  visit("environments", "Light from infinitely far away, as a function of direction", scene.environments);
  visit("materials", "Surface properties that objects can share", scene.materials);
  visit("objects", "A shape with its surface and placement", scene.objects);
  visit("particle_systems", "Additional particles, with keys of their own", scene.particle_systems);
  visit("animations", "How a key changes over time", scene.animations);
}

/// Calls visit(name, help, struct) for each section that occurs once.
template <class Scene, class F>
void for_each_single(Scene& scene, F&& visit) {
  visit("background", "The background behind all objects", scene.background);
  visit("reflections", "The environment that reflective surfaces mirror", scene.reflections);
  visit("post", "Conversion of light to pixel values; linear files (.exr, .hdr) are written without it", scene.post);
  visit("shadow", "How shadows are computed", scene.shadow);
  visit("particles", "Spheres drawn as points", scene.particles);
  visit("animation", "Settings for all animations", scene.animation);
  visit("time", "The time of day", scene.time);
}

}  // namespace halfspace::HS_LANES
