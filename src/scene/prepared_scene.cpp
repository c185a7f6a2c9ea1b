// SPDX-License-Identifier: Apache-2.0
#include "scene/prepared_scene.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/check.h"
#include "core/trig_double.h"
#include "scene/camera.h"
#include "scene/displaced_sphere.h"
#include "scene/image_io.h"
#include "scene/procedural_earth.h"
#include "scene/procedural_moon.h"
#include "scene/shapes.h"

namespace halfspace {

namespace {

constexpr double kDegrees = std::numbers::pi / 180.0;

// What a camera sees, in matrices and vectors.
struct View {
  glm::dmat4 clip_from_world;
  glm::dvec3 eye_ws;
  glm::dvec3 to_eye_ws;                    // orthographic: towards the eye from everywhere; else 0
  glm::dvec3 forward_ws, right_ws, up_ws;  // unit vectors
  double tan_x, tan_y;                     // of half the field of view
  double near;
  int height_px;
};

View make_view(const CameraDescription& c, int width, int height) {
  const double aspect = static_cast<double>(width) / height;
  const glm::dmat4 view = look_at(c.position, c.target, c.up);
  const glm::dvec3 right(view[0][0], view[1][0], view[2][0]), up(view[0][1], view[1][1], view[2][1]),
      back(view[0][2], view[1][2], view[2][2]);
  const SinCosDouble half = sincos_radians(0.5 * c.fov * kDegrees);
  View v{{}, c.position, glm::dvec3(0.0), -back, right, up, 0.0, half.sin / half.cos, c.near, height};
  if (c.type == Projection::perspective) {
    v.clip_from_world = perspective_reversed(c.fov * kDegrees, aspect, c.near, c.far) * view;
  } else {
    v.clip_from_world = orthographic_reversed(c.height, aspect, c.near, c.far) * view;
    v.to_eye_ws = back;
  }
  v.tan_x = v.tan_y * aspect;
  return v;
}

glm::dmat3 rotation_about(int axis, double degrees) {
  const double turns = degrees / 360.0;
  const SinCosDouble a = sincos_turns(turns - std::floor(turns));
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  glm::dmat3 m(1.0);
  m[i][i] = m[j][j] = a.cos;
  m[i][j] = a.sin;
  m[j][i] = -a.sin;
  return m;
}

glm::dmat4 world_from_object(const Placement& p) {
  const glm::dmat3 turn = rotation_about(1, p.rotation.y) * rotation_about(0, p.rotation.x) * rotation_about(2, p.rotation.z);
  glm::dmat4 m(1.0);
  for (int k = 0; k < 3; ++k) m[k] = glm::dvec4(turn[k] * p.scale[k], 0.0);
  m[3] = glm::dvec4(p.position, 1.0);
  return m;
}

std::vector<Light> make_lights(const Named<LightDescription>& descriptions, const glm::dvec3& eye_ws) {
  std::vector<Light> lights;
  for (const auto& [name, d] : descriptions) {
    const bool point = d.type == LightType::point;
    const glm::dvec3 place = point ? d.position - eye_ws : unit_or_zero(d.direction);
    lights.push_back({point, glm::vec3(place), glm::vec3(d.color.linear * d.intensity), glm::vec3(d.attenuation)});
  }
  return lights;
}

Sampler make_sampler(const TextureDescription& t) {
  Sampler s;
  s.mag = t.filter == Filter::nearest ? Filter::nearest : Filter::bilinear;
  s.min = t.filter;
  s.wrap_s = t.wrap_s;
  s.wrap_t = t.wrap_t;
  s.anisotropy = t.anisotropy;
  return s;
}

// A mesh with its indices checked once.
struct MeshAsset {
  explicit MeshAsset(Mesh m) : mesh(std::move(m)), indices(mesh.indices, mesh.positions.size()) {}
  Mesh mesh;
  Indices indices;
};

// What an asset is made from, in words: the key it is kept by.
template <class... T>
std::string recipe(const T&... parts) {
  std::string text;
  const auto add = [&](const auto& part) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(part)>>) {
      text += number_text(static_cast<double>(part)) + " ";
    } else {
      text += std::string(part) + " ";
    }
  };
  (add(parts), ...);
  return text;
}

// A map as one object needs it.
struct MapUse {
  TextureDescription texture;
  int width;  // of a generated map, else 0
};

}  // namespace

class ScenePreparation {
 public:
  ScenePreparation(SceneAssets& assets, const SceneDescription& scene, int width, int height)
      : assets_(assets),
        scene_(scene),
        view_(make_view(camera(), width, height)),
        lights_(std::make_shared<const std::vector<Light>>(make_lights(scene.lights, view_.eye_ws))) {
    out_.assets.push_back(lights_);
  }

  PreparedScene prepare() {
    out_.clear_color = glm::vec4(glm::vec3(scene_.background.color.linear), 1.0f);
    for (const auto& [name, object] : scene_.objects) {
      if (object.visible) add_object("objects." + name, object);
    }
    if (scene_.background.type == BackgroundType::stars) add_stars();
    return std::move(out_);
  }

 private:
  const CameraDescription& camera() const {
    for (const auto& [name, camera] : scene_.cameras) {
      if (name == scene_.head.camera) return camera;
    }
    return scene_.cameras.front().second;
  }

  // The asset made from `recipe`, made now if it is not there.
  template <class T, class F>
  std::shared_ptr<const T> asset(const std::string& recipe, F make) {
    auto found = assets_.entries_.find(recipe);
    if (found == assets_.entries_.end())
      found = assets_.entries_.emplace(recipe, SceneAssets::Entry{std::make_shared<const T>(make()), true}).first;
    found->second.wanted = true;
    out_.assets.push_back(found->second.asset);
    return std::static_pointer_cast<const T>(found->second.asset);
  }

  // ---- maps

  // How many texels round the object are worth having: at its middle one spans two pixels.
  int width_for(const ObjectDescription& o) const {
    double circumference_px = 0.0;
    for (const glm::dmat4& world : places_of(o)) {
      const double scale = std::max({glm::length(world[0]), glm::length(world[1]), glm::length(world[2])});
      const double radius = (o.shape == Shape::uv_sphere ? o.radius : o.size) * scale;
      const double distance = std::max(glm::distance(glm::dvec3(world[3]), view_.eye_ws) - radius, view_.near);
      const double height = camera().type == Projection::orthographic ? camera().height : 2.0 * view_.tan_y * distance;
      circumference_px = std::max(circumference_px, 2.0 * std::numbers::pi * radius / height * view_.height_px);
    }
    int width = 256;
    while (width < 4096 && 2 * width < circumference_px) width *= 2;
    return width;
  }

  MapUse use_of(const MapValue& map, const ObjectDescription& o) const {
    TextureDescription t;
    if (const auto* file = std::get_if<FilePath>(&map)) {
      t.file = *file;
      if (o.shape == Shape::uv_sphere) t.wrap_t = Wrap::clamp;  // nothing lies beyond the poles
    } else {
      const std::string& name = std::get<TextureName>(map).name;
      t = std::ranges::find_if(scene_.textures, [&](const auto& entry) { return entry.first == name; })->second;
      if (t.source == TextureSource::file && t.file.path.empty())
        throw InputError("textures." + name + ".file: missing; expected an image file");
    }
    if (t.source == TextureSource::file) return {t, 0};
    return {t, t.width != 0 ? t.width : width_for(o)};
  }

  std::shared_ptr<const MoonMaps> moon_maps(int width) {
    return asset<MoonMaps>(recipe("moon", width), [&] { return procedural_moon(width, assets_.workers_); });
  }

  std::shared_ptr<const Texture2D> color_texture(const MapUse& use, const std::string& path) {
    switch (use.texture.source) {
      case TextureSource::file:
        return asset<Texture2D>(recipe("color", use.texture.file.path.string()),
                                [&] { return Texture2D(read_image(use.texture.file.path), TexelFormat::srgb8a8); });
      case TextureSource::earth_color:
        return asset<Texture2D>(recipe("earth_color", use.width), [&] {
          return Texture2D(procedural_earth(use.width, use.width / 2, assets_.workers_), TexelFormat::srgb8a8);
        });
      case TextureSource::moon_color:
        return asset<Texture2D>(recipe("moon_color", use.width),
                                [&] { return Texture2D(moon_maps(use.width)->color, TexelFormat::srgb8a8); });
      case TextureSource::moon_height: break;
    }
    throw InputError(path + ".color: moon_height is a map of heights; expected a map of colours");
  }

  // The map of heights, smoothed, as a function on the sphere.
  std::shared_ptr<const HeightField> height_field(const MapUse& use, const ObjectDescription& o, const std::string& path) {
    const std::string words = recipe("heights", use.texture.file.path.string(), use.width, o.height_smoothing);
    switch (use.texture.source) {
      case TextureSource::file:
        return asset<HeightField>(words, [&] {
          const Image<float> map = read_gray(use.texture.file.path);
          if (map.width() < 2)
            throw InputError(use.texture.file.path.string() + ": is one texel wide; expected a map of heights round a sphere");
          return HeightField(map, o.height_smoothing, assets_.workers_);
        });
      case TextureSource::moon_height:
        return asset<HeightField>(words, [&] {
          const Image<uint16_t>& codes = moon_maps(use.width)->height;
          Image<float> map(codes.width(), codes.height());
          std::ranges::transform(codes.texels(), map.data(), [](uint16_t code) { return static_cast<float>(code) / 65535.0f; });
          return HeightField(map, o.height_smoothing, assets_.workers_);
        });
      default: throw InputError(path + ".height: is a map of colours; expected a map of heights");
    }
  }

  // ---- objects

  // World from object, for each copy.
  static std::vector<glm::dmat4> places_of(const ObjectDescription& o) {
    const glm::dmat4 whole = world_from_object(o.placement);
    if (o.instances.empty()) return {whole};
    std::vector<glm::dmat4> places;
    for (const Placement& p : o.instances) places.push_back(whole * world_from_object(p));
    return places;
  }

  static bool is_displaced(const ObjectDescription& o) { return o.shape == Shape::uv_sphere && !std::holds_alternative<Color>(o.height); }

  // What displaces a sphere.
  struct Relief {
    std::shared_ptr<const HeightField> field;  // null: nothing does
    std::string recipe;
    std::shared_ptr<const Texture2D> slopes;  // null: normals come with the mesh
    Sampler sampler;
  };

  std::shared_ptr<const MeshAsset> mesh_of(const ObjectDescription& o, const Relief& relief) {
    const auto radius = static_cast<float>(o.radius), size = static_cast<float>(o.size);
    switch (o.shape) {
      case Shape::plane: return asset<MeshAsset>(recipe("plane", o.size), [&] { return MeshAsset(plane(size)); });
      case Shape::cube: return asset<MeshAsset>(recipe("cube", o.size), [&] { return MeshAsset(cube(size)); });
      case Shape::uv_sphere: break;
    }
    const std::string sphere = recipe("sphere", o.radius, o.latitudes, o.longitudes);
    if (relief.field == nullptr) return asset<MeshAsset>(sphere, [&] { return MeshAsset(uv_sphere(o.latitudes, o.longitudes, radius)); });
    const ReliefNormals normals = o.normals == NormalSource::undisplaced ? ReliefNormals::undisplaced : ReliefNormals::displaced;
    return asset<MeshAsset>(recipe(sphere, relief.recipe, static_cast<int>(normals)), [&] {
      const HeightField filtered = relief.field->filtered(o.longitudes, assets_.workers_);
      return MeshAsset(
          displaced_uv_sphere(o.latitudes, o.longitudes, radius, filtered, o.height_scale, o.height_zero, assets_.workers_, normals));
    });
  }

  // What all copies of an object share.
  LitSurface surface_of(const ObjectDescription& o, const std::string& path) {
    LitSurface s;
    s.to_eye_ws = glm::vec3(view_.to_eye_ws);
    s.lights = *lights_;
    s.two_sided = o.shape == Shape::plane;
    s.surface = {glm::vec3(o.surface.ambient.linear * scene_.head.ambient.linear), glm::vec3(o.surface.diffuse.linear),
                 glm::vec3(o.surface.specular.linear), static_cast<float>(o.surface.shininess)};
    if (const auto* color = std::get_if<Color>(&o.surface.color)) {
      s.color = glm::vec3(color->linear);
    } else {
      const MapUse use = use_of(o.surface.color, o);
      s.map = color_texture(use, path).get();
      s.sampler = make_sampler(use.texture);
    }
    return s;
  }

  void place(LitSurface& s, glm::dmat4 world) const {
    s.clip_from_object = glm::mat4(view_.clip_from_world * world);
    world[3] -= glm::dvec4(view_.eye_ws, 0.0);
    s.world_from_object = glm::mat4(world);
    s.normal_from_object = glm::mat3(glm::transpose(glm::inverse(glm::dmat3(world))));
  }

  static DrawState state_of(const ObjectDescription& o, const glm::dmat4& world) {
    DrawState state;
    state.cull = o.shape == Shape::plane ? CullMode::none : CullMode::back;
    if (glm::determinant(glm::dmat3(world)) < 0) state.front = Winding::clockwise;  // mirrored
    state.depth.clip = ClipDepth::zero_to_one;
    state.depth.compare = CompareOp::greater;
    return state;
  }

  Relief relief_of(const ObjectDescription& o, const std::string& path) {
    if (!is_displaced(o)) return {};
    const MapUse use = use_of(o.height, o);
    Relief r;
    r.field = height_field(use, o, path);
    r.recipe = recipe(use.texture.file.path.string(), use.width, o.height_smoothing, o.height_scale, o.height_zero);
    if (o.normals != NormalSource::pixel) return r;
    const int width = std::min(width_for(o), r.field->width());
    r.slopes = asset<Texture2D>(recipe("slopes", r.recipe, width, o.radius), [&] {
      const HeightField filtered = r.field->filtered(width, assets_.workers_);
      return Texture2D(slope_map(filtered, width, std::max(1, width / 2), o.radius, o.height_scale, o.height_zero, assets_.workers_),
                       TexelFormat::rgba16f);
    });
    r.sampler = make_sampler(use.texture);
    r.sampler.wrap_t = Wrap::clamp;
    return r;
  }

  void add_object(const std::string& path, const ObjectDescription& o) {
    const Relief relief = relief_of(o, path);
    const std::shared_ptr<const MeshAsset> asset = mesh_of(o, relief);
    const Mesh& mesh = asset->mesh;
    const std::shared_ptr<const Indices> indices(asset, &asset->indices);
    LitSurface surface = surface_of(o, path);
    for (const glm::dmat4& world : places_of(o)) {
      place(surface, world);
      if (relief.slopes != nullptr) {
        const DisplacedSphere shader{surface, relief.slopes.get(), relief.sampler};
        out_.draws.push_back({shader, vertices(stream(mesh.positions), stream(mesh.uvs)), indices, state_of(o, world)});
      } else {
        const BlinnPhong shader{surface};
        out_.draws.push_back(
            {shader, vertices(stream(mesh.positions), stream(mesh.normals), stream(mesh.uvs)), indices, state_of(o, world)});
      }
    }
  }

  void add_stars() {
    StarSky sky;
    sky.forward_ws = glm::vec3(view_.forward_ws);
    sky.right_ws = glm::vec3(view_.right_ws * view_.tan_x);
    sky.up_ws = glm::vec3(view_.up_ws * view_.tan_y);
    sky.color = glm::vec3(scene_.background.color.linear);
    sky.brightness = static_cast<float>(scene_.background.brightness);
    sky.density = static_cast<float>(scene_.background.density);
    sky.pixel = static_cast<float>(2.0 * view_.tan_y / view_.height_px);
    DrawState state;
    state.depth.clip = ClipDepth::zero_to_one;
    state.depth.compare = CompareOp::greater_equal;  // where nothing is nearer than the farthest
    state.depth.write = false;
    static const std::vector<glm::vec2> corners(StarSky::kCorners.begin(), StarSky::kCorners.end());
    out_.draws.push_back({sky, vertices(stream(corners)), std::make_shared<const Indices>(Indices::sequential(3)), state});
  }

  SceneAssets& assets_;
  const SceneDescription& scene_;
  View view_;
  std::shared_ptr<const std::vector<Light>> lights_;
  PreparedScene out_;
};

PreparedScene SceneAssets::prepare(const SceneDescription& scene, int width, int height) {
  for (auto& [recipe, entry] : entries_) entry.wanted = false;
  PreparedScene prepared = ScenePreparation(*this, scene, width, height).prepare();
  std::erase_if(entries_, [](const auto& entry) { return !entry.second.wanted; });
  return prepared;
}

namespace {

PassStatistics draw_all(const PreparedScene& scene, Pass& pass, const Workers& workers) {
  for (const PreparedDraw& draw : scene.draws) {
    std::visit([&](const auto& shader) { pass.draw(shader, draw.vertices, *draw.indices, draw.state); }, draw.shader);
  }
  return pass.run(workers);
}

constexpr DepthTarget kDepth{.format = DepthFormat::d32f, .clear_value = 0.0f};

}  // namespace

PassStatistics render(const PreparedScene& scene, Image<glm::u8vec4>& picture, const Workers& workers) {
  ColorTarget color = srgb8a8_target(picture);
  color.clear_value = scene.clear_color;
  Pass pass(picture.width(), picture.height(), color, kDepth);
  return draw_all(scene, pass, workers);
}

PassStatistics render(const PreparedScene& scene, Image<glm::vec4>& picture, const Workers& workers) {
  ColorTarget color = rgba32f_target(picture);
  color.clear_value = scene.clear_color;
  Pass pass(picture.width(), picture.height(), color, kDepth);
  return draw_all(scene, pass, workers);
}

}  // namespace halfspace
