// SPDX-License-Identifier: Apache-2.0
//
// A scene as its file describes it: plain values with their defaults. The tables in description.cpp name each of them
// as a key. What they mean for drawing is told in render/prepared_scene.h.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "halfspace/scene/keys.h"
#include "halfspace/shading/light_types.h"
#include "halfspace/shading/sampler.h"
#include "halfspace/shading/tone_types.h"

namespace halfspace {

/// Named things, in the order of the file.
template <class T>
using Named = std::vector<std::pair<std::string, T>>;

enum class Projection : uint8_t { perspective, orthographic };

struct CameraDescription {
  Projection type = Projection::perspective;
  glm::dvec3 position{0, 0, 5};  ///< world
  glm::dvec3 target{0, 0, 0};    ///< world
  glm::dvec3 up{0, 1, 0};
  double fov = 45.0;    ///< degrees, vertical
  double height = 2.0;  ///< units
  double near = 0.1, far = 1000.0;
};

enum class Falloff : uint8_t { attenuation, physical };

struct LightDescription {
  LightType type = LightType::directional;
  glm::dvec3 direction{0, 0, 1};  ///< towards the light, any length
  glm::dvec3 position{0, 0, 5};
  Color color{glm::dvec3(1.0)};
  double intensity = 1.0;
  double ambient = 0.0;  ///< factors of color and intensity; ambient light is not attenuated
  double diffuse = 1.0, specular = 1.0;
  Falloff falloff = Falloff::attenuation;
  glm::dvec3 attenuation{1, 0, 0};
  double inner = 20.0, outer = 30.0;  ///< degrees from the axis
  bool shadow = true;
  double size = 0.0;  ///< radius in units; directional: half the angle that it spans, degrees
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

/// Is it a map of procedural/patterns.h, which tiles?
inline bool is_pattern(TextureSource source) { return source >= TextureSource::checkerboard; }

struct TextureDescription {
  TextureSource source = TextureSource::file;
  FilePath file;
  int width = 0;  ///< of a generated map, even; 0: as fine as the view needs
  Filter filter = Filter::trilinear;
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  int anisotropy = 8;
};

/// Which normal map of a surface is used: the one that there is (the normal map before the bump map), or by name.
enum class DetailChoice : uint8_t { automatic, none, map, bump };
/// How the slope of a bump map is found: by the gradient of its filtered heights, or by differences within 2x2 pixels.
enum class BumpMethod : uint8_t { gradient, difference };

/// Each factor is a constant times a map; a map that is a colour is a constant too.
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
  bool textured = true;  ///< false: colour maps count as 1
  Color reflection{glm::dvec3(0.0)};

  LightModel model = LightModel::blinn_phong;
  ShadingRate shading = ShadingRate::phong;
  bool two_sided = false;

  DetailChoice normal = DetailChoice::automatic;
  MapValue normal_map = Color{glm::dvec3(1.0)};  ///< a constant means none
  double normal_strength = 1.0;
  bool normal_flip_green = false;
  MapValue bump_map = Color{glm::dvec3(1.0)};  ///< a constant means none
  double bump_scale = 0.02;                    ///< units of the world between the map's 0 and 1
  BumpMethod bump_method = BumpMethod::gradient;
};

/// The key of a surface's first map; empty where it has none.
std::string_view first_map(const SurfaceDescription& s);

/// sphere: no mesh but a ray by pixel (shading/sphere_impostor.h); of surfaces without maps.
enum class Shape : uint8_t { uv_sphere, icosphere, sphere, plane, cube, cylinder, cone, torus, torus_knot };
enum class NormalSource : uint8_t { pixel, vertex, undisplaced };

struct Placement {
  glm::dvec3 position{0.0};
  glm::dvec3 rotation{0.0};  ///< degrees about x, y, z; applied in the order z, x, y
  glm::dvec3 scale{1.0};
};

struct ObjectDescription {
  Shape shape = Shape::uv_sphere;
  double radius = 1.0;
  double tube = 0.25;
  double length = 2.0;
  int latitudes = 64, longitudes = 128;
  int level = 5;
  double size = 2.0;
  int segments = 1;
  int tiles_u = 1, tiles_v = 1;
  bool visible = true;
  bool casts_shadow = true, receives_shadow = true;

  MapValue height = Color{glm::dvec3(0.0)};  ///< a constant means none
  double height_scale = 0.02;                ///< units between the map's 0 and 1
  double height_zero = 0.5;                  ///< the map's value that leaves the surface where it is
  double height_smoothing = 1.0;             ///< texels
  NormalSource normals = NormalSource::pixel;

  std::string material;  ///< empty: none
  SurfaceDescription surface;
  Placement placement;
  std::vector<Placement> instances;  ///< copies, relative to placement; empty: one, at placement
};

enum class EnvironmentType : uint8_t { equirect, globe, cube, day_sky, night_sky };

/// Light from far away, by its direction (see shading/environment.h).
struct EnvironmentDescription {
  EnvironmentType type = EnvironmentType::equirect;
  MapValue map = Color{glm::dvec3(1.0)};  ///< of a texture its source alone counts
  FilePath folder;                        ///< of files named right, left, top, bottom, front and back
  FilePath right, left, top, bottom, front, back;
  int size = 0;                    ///< of a generated sky's faces; 0: as fine as the view needs
  glm::dvec3 sun{0.5, 0.6, -0.6};  ///< towards it, any length
  double clouds = 0.4;
  double milky_way = 1.0;
  double stars = 0.3;             ///< density, as the background's
  double star_brightness = 0.05;  ///< linear
  glm::dvec3 rotation{0.0};       ///< degrees, as Placement's
  double brightness = 1.0;
};

enum class BackgroundType : uint8_t { color, stars, environment };

struct BackgroundDescription {
  BackgroundType type = BackgroundType::color;
  Color color{glm::dvec3(0.0)};
  double brightness = 1.0;
  double density = 0.3;
  std::string environment;  ///< empty: the first
  std::string second;       ///< empty: none
  double weight = 0.0;      ///< of the second
};

/// What surfaces mirror.
struct ReflectionsDescription {
  bool on = true;
  std::string environment;  ///< empty: what the background shows, without its stars
};

enum class LightFormat : uint8_t { rgba16f, rgba32f };
enum class DisplayEncoding : uint8_t { srgb, gamma };

/// How light becomes codes.
struct PostDescription {
  bool hdr = false;  ///< off: light is held to [0, 1] and encoded to sRGB, and no other key of these counts
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
};

/// ShadowFilter, and none before it.
enum class ShadowMethod : uint8_t { none, hard, bilinear, pcf3, pcf5, pcf7, vogel, pcss, vsm, moments };
/// Which faces of a closed surface are drawn into shadow maps, as the light sees them.
enum class ShadowFaces : uint8_t { front, back, both };

/// The narrowest and widest shadow map, texels. Narrower ones have no room for what the widest filter looks at on all sides.
inline constexpr int kMinShadowTexels = 256, kMaxShadowTexels = 8192;

struct ShadowDescription {
  ShadowMethod method = ShadowMethod::none;
  ShadowBias bias = ShadowBias::automatic;
  int resolution = 2048;   ///< texels a side; 0: as footprint asks
  double footprint = 1.0;  ///< pixels that a texel spans at most on 95 % of the picture
  double constant = 1.0;   ///< texels
  double slope = 1.0;
  double max_slope = 16.0;
  double radius = 2.0;  ///< texels
  ShadowFaces faces = ShadowFaces::front;
  int cascades = 1;
  double cascade_growth = 0.75;  ///< 0: cascades of even depth, 1: each a constant times the one before
};

enum class ParticleSprite : uint8_t { original, exact };
/// The largest number of spheres that a particle system may have.
inline constexpr int kMaxParticles = 1000000;

enum class ParticleArrangement : uint8_t { helix, grid, ball, galaxy };

/// Spheres drawn as points (render/particles.h, shading/sphere_impostor.h).
struct ParticlesDescription {
  ParticleSprite sprite = ParticleSprite::original;
  int count = 0;  ///< of generated ones; 0: none
  ParticleArrangement arrangement = ParticleArrangement::helix;
  FilePath file;        ///< instead of generated ones
  double radius = 0.0;  ///< 0: by their number
  double orbit_radius = 1.5;
  double height = 6.0;
  double angle = 0.0;        ///< radians
  double point_scale = 0.0;  ///< px; 0: the picture's width
  Color color{glm::dvec3(1.0)};
  Color ambient{glm::dvec3(1.0)};
  Color diffuse{glm::dvec3(1.0)};
  Color specular{glm::dvec3(0.0)};
  double shininess = 32.0;
  bool casts_shadow = true, receives_shadow = true;  ///< exact ones
};

enum class AnimationType : uint8_t { rate, orbit, wave, keyframes };
enum class Easing : uint8_t { linear, smooth, step };

/// What changes one key in time; it begins with the scene's own value of the key at 0 s.
struct AnimationDescription {
  AnimationType type = AnimationType::rate;
  std::string target;      ///< dotted path of a number or a vector
  Numbers rate{0.0};       ///< per second
  glm::dvec3 center{0.0};  ///< orbit: center + a·cos φ + b·sin φ, φ = 2π(t / period + phase)
  glm::dvec3 a{1, 0, 0};
  glm::dvec3 b{0, 0, -1};
  Numbers mean{0.0};  ///< wave: mean + swing·cos φ, held to the key's range
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

/// The time of day at which the animations begin: hours/24 of a day after their own 0 s.
struct TimeOfDay {
  double hours = 0.0;
  double day = 24.0;  ///< seconds
};

/// The keys at the top of a scene file.
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

/// Calls visit(name, help, named) for each collection of named things.
template <class Scene, class F>
void for_each_collection(Scene& scene, F&& visit) {
  visit("cameras", "A point of view", scene.cameras);
  visit("lights", "A source of light", scene.lights);
  visit("textures", "An image, or a generated one, and how it is read", scene.textures);
  visit("environments", "Light from far away, by its direction", scene.environments);
  visit("materials", "What a surface looks like, for objects that share it", scene.materials);
  visit("objects", "A shape, its surface and its place", scene.objects);
  visit("animations", "How a key changes in time", scene.animations);
}

/// Calls visit(name, help, struct) for each section that there is once.
template <class Scene, class F>
void for_each_single(Scene& scene, F&& visit) {
  visit("background", "What is seen where nothing is", scene.background);
  visit("reflections", "What surfaces with a reflection mirror", scene.reflections);
  visit("post", "How light becomes codes; linear files (.exr, .hdr) are written before it", scene.post);
  visit("shadow", "How lights' shadows are found", scene.shadow);
  visit("particles", "Spheres drawn as points", scene.particles);
  visit("animation", "All animations together", scene.animation);
  visit("time", "The time of day", scene.time);
}

}  // namespace halfspace
