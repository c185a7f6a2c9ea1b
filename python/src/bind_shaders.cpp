// SPDX-License-Identifier: Apache-2.0
//
// The shaders of the library, for passes that draw arrays. They are the variants that scenes use, which are already compiled.
#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "bindings.h"
#include "draw_shader.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/render/assets/texture_image.h"
#include "images.h"
#include "matrices.h"

namespace halfspace::python {

namespace {

using Vector = std::array<float, 3>;

glm::vec3 vec_of(const Vector& v) { return {v[0], v[1], v[2]}; }
glm::dvec3 dvec_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Shader colored(const Array<double>& clip_from_object, const std::array<float, 4>& color) {
  return {ColoredPrimitives{glm::mat4(matrix_of(clip_from_object)), {color[0], color[1], color[2], color[3]}}, {"positions", "colors"}};
}

// Sets the transforms of a surface. The positions of lights are relative to the eye.
void place(SurfaceUniforms& s, const glm::dmat4& clip_from_world, glm::dmat4 world, const glm::dvec3& eye) {
  s.clip_from_object = glm::mat4(clip_from_world * world);
  world[3] -= glm::dvec4(eye, 0.0);
  s.world_from_object = glm::mat4(world);
  s.normal_from_object = normal_matrix(world);
  s.handedness = glm::determinant(glm::dmat3(world)) < 0 ? -1.0f : 1.0f;
}

/// Uniforms that all lit shaders share.
struct Placing {
  Array<double> clip_from_world, world_from_object;
  std::array<double, 3> eye;
  std::vector<Light> lights;
  bool two_sided;
};

// Returns the lights with positions relative to the eye.
std::shared_ptr<const std::vector<Light>> seen_lights(const std::vector<Light>& lights, const glm::dvec3& eye) {
  auto moved = std::make_shared<std::vector<Light>>(lights);
  for (Light& light : *moved) {
    if (light.type != LightType::directional) light.position_rws = glm::vec3(glm::dvec3(light.position_rws) - eye);
  }
  return moved;
}

void place(SurfaceUniforms& s, const Placing& p, Shader& out) {
  const glm::dvec3 eye = dvec_of(p.eye);
  place(s, matrix_of(p.clip_from_world), matrix_of(p.world_from_object), eye);
  const auto lights = seen_lights(p.lights, eye);
  s.lights = *lights;
  s.two_sided = p.two_sided;
  out.data.push_back(lights);
}

/// Texels of shape (H, W, 4), or None, and how they are sampled.
struct Map {
  std::optional<py::array> texels;
  Sampler sampler;
};

// Adds a texture to the data of a shader. Returns null if the map has no texels.
const Texture2D* add_texture(Shader& out, const Map& map, TextureRole role) {
  if (!map.texels) return nullptr;
  auto texture = std::make_shared<const Texture2D>(texture_of(texels_of(pixels_of(*map.texels), role, "texture"), role, "texture"));
  out.data.push_back(texture);
  return texture.get();
}

template <ShadingRate rate>
void set_lit_shader(Shader& out, const LitSurface& surface, bool mapped) {
  out.attributes = {"positions", "normals"};
  if (mapped) out.attributes.emplace_back("uvs");
  out.shader = mapped ? SceneShader(SurfaceShader<rate, true>{surface}) : SceneShader(SurfaceShader<rate, false>{surface});
}

Shader phong(const Placing& placing, const std::vector<Vector>& factors, float shininess, LightModel model, bool per_vertex,
             const Map& color, const Map& normal, float normal_scale) {
  LitSurface s;
  Shader out;
  place(s, placing, out);
  for (std::size_t i = 0; i < factors.size() && i < kShininess; ++i) s.factors[i].constant = vec_of(factors[i]);
  s.factors[kShininess].constant = glm::vec3(shininess);
  s.model = model;
  s.factors[kColor].map = add_texture(out, color, TextureRole::colors);
  s.factors[kColor].sampler = color.sampler;
  if (normal.texels) {
    s.detail = {.map = add_texture(out, normal, TextureRole::normals), .sampler = normal.sampler, .strength = normal_scale};
    out.shader = SceneShader(SurfaceShader<ShadingRate::phong, true, NormalDetail::map>{s});
    out.attributes = {"positions", "normals", "tangents", "uvs"};
  } else if (per_vertex) {
    set_lit_shader<ShadingRate::gouraud>(out, s, color.texels.has_value());
  } else {
    set_lit_shader<ShadingRate::phong>(out, s, color.texels.has_value());
  }
  return out;
}

Shader metallic(const Placing& placing, const std::array<float, 4>& base_color, float metallic, float roughness, const Vector& emissive,
                const Vector& ambient, bool colored, const Map& map) {
  MetallicMaterial m;
  Shader out;
  place(m, placing, out);
  m.base_color = {base_color[0], base_color[1], base_color[2], base_color[3]};
  m.metallic = metallic;
  m.roughness = roughness;
  m.emissive = vec_of(emissive);
  m.ambient = vec_of(ambient);
  m.blends = base_color[3] < 1.0f;
  out.attributes = {"positions", "normals"};
  if (map.texels) {
    m.maps[kBaseColorMap].map = add_texture(out, map, TextureRole::colors);
    m.maps[kBaseColorMap].sampler = map.sampler;
    out.shader = SceneShader(MetallicSurface<MetallicStreams::mapped>{m});
    out.attributes.emplace_back("uvs");
  } else if (colored) {
    out.shader = SceneShader(MetallicSurface<MetallicStreams::colored>{m});
    out.attributes.emplace_back("colors");
  } else {
    out.shader = SceneShader(MetallicSurface<MetallicStreams::basic>{m});
  }
  return out;
}

Shader depth_only(const Array<double>& clip_from_object, const Map& map, float opacity, float cutoff) {
  const glm::mat4 clip(matrix_of(clip_from_object));
  if (!map.texels) return {DepthOnly{clip}, {"positions"}};
  Shader out;
  MaterialMap alpha{.map = add_texture(out, map, TextureRole::data), .sampler = map.sampler, .channel = {0, 0, 0, 1}};
  out.shader = MaskedDepth<false>{clip, OpacityTest{{alpha, {}}, opacity, cutoff}};
  out.attributes = {"positions", "uvs"};
  return out;
}

/// A camera of spheres and skies: its pose with OpenGL's axes, and half the extent of its view at distance 1 or, if it is orthographic, in
/// scene units.
struct Lens {
  Array<double> world_from_camera;
  std::array<double, 2> half;
  double near, far;
  bool perspective;
};

Shader spheres(const Lens& lens, int width, int height, const std::vector<Light>& lights, const std::vector<Vector>& factors,
               float shininess, LightModel model) {
  const glm::dmat4 world = matrix_of(lens.world_from_camera);
  SphereImpostors s;
  s.lens = {lens.perspective, glm::dvec2(lens.half[0], lens.half[1]), lens.near, lens.far, {width, height}};
  s.world_from_camera = glm::mat3(glm::dmat3(glm::dvec3(world[0]), glm::dvec3(world[1]), -glm::dvec3(world[2])));
  if (!lens.perspective) s.to_eye_ws = glm::vec3(glm::dvec3(world[2]));
  const auto seen = seen_lights(lights, glm::dvec3(world[3]));
  s.lights = *seen;
  s.ambient = vec_of(factors.at(0));
  s.diffuse = vec_of(factors.at(1));
  s.specular = vec_of(factors.at(2));
  s.emissive = vec_of(factors.at(3));
  s.shininess = shininess;
  s.model = model;
  return {SceneShader(SphereImpostor<true>{s}), {"centers", "radii", "colors"}, {seen}};
}

Shader sky(const Lens& lens, const py::array& panorama, float brightness) {
  const glm::dmat4 world = matrix_of(lens.world_from_camera);
  const auto width = static_cast<int>(panorama.shape(1)), height = static_cast<int>(panorama.shape(0));
  const auto map_of = [&]<class Texel>(Image<Texel> image, TexelFormat format) {
    std::memcpy(image.data(), panorama.data(), image.texels().size_bytes());
    return std::make_shared<const EnvironmentMap>(image, format);
  };
  const bool linear = panorama.itemsize() == 4;
  const auto map = linear ? map_of(Image<glm::vec4>(width, height), TexelFormat::rgba32f)
                          : map_of(Image<glm::u8vec4>(width, height), TexelFormat::srgb8a8);
  EnvironmentSky s;
  s.forward_ws = -glm::vec3(glm::dvec3(world[2]));
  s.right_ws = glm::vec3(glm::dvec3(world[0]) * lens.half[0]);
  s.up_ws = glm::vec3(glm::dvec3(world[1]) * lens.half[1]);
  s.environment.first = {.map = map.get(), .brightness = brightness};
  return {SceneShader(s), {"corners"}, {map}};
}

Light make_light(LightType type, const Vector& place, const Vector& diffuse, const Vector& specular, const Vector& attenuation,
                 const Vector& axis, float cos_inner, float cos_outer, float inverse_range) {
  Light light;
  light.type = type;
  light.position_rws = vec_of(place);
  light.diffuse = vec_of(diffuse);
  light.specular = vec_of(specular);
  light.attenuation = vec_of(attenuation);
  light.axis_ws = vec_of(axis);
  light.cos_outer = cos_outer;
  light.cone_scale = 1.0f / std::max(cos_inner - cos_outer, 1e-6f);
  light.inverse_range = inverse_range;
  return light;
}

}  // namespace

void bind_shaders(py::module_& m) {
  py::enum_<LightType>(m, "LightType")
      .value("directional", LightType::directional)
      .value("point", LightType::point)
      .value("spot", LightType::spot);
  py::enum_<LightModel>(m, "LightModel")
      .value("lambert", LightModel::lambert)
      .value("phong", LightModel::phong)
      .value("blinn_phong", LightModel::blinn_phong);
  py::class_<Light>(m, "Light").def(py::init(&make_light));
  py::class_<Placing>(m, "Placing")
      .def(py::init([](const Array<double>& clip_from_world, const Array<double>& world_from_object, const std::array<double, 3>& eye,
                       const std::vector<Light>& lights, bool two_sided) {
        return Placing{clip_from_world, world_from_object, eye, lights, two_sided};
      }));
  py::class_<Map>(m, "Map").def(py::init([](const std::optional<py::array>& texels, const Sampler& sampler) {
    return Map{texels, sampler};
  }));
  py::class_<Lens>(m, "Lens").def(
      py::init([](const Array<double>& world_from_camera, const std::array<double, 2>& half, double near, double far, bool perspective) {
        return Lens{world_from_camera, half, near, far, perspective};
      }));
  py::class_<Shader>(m, "Shader").def_readonly("attributes", &Shader::attributes);
  m.def("colored", &colored);
  m.def("phong", &phong);
  m.def("metallic", &metallic);
  m.def("depth_only", &depth_only);
  m.def("spheres", &spheres);
  m.def("sky", &sky);
}

}  // namespace halfspace::python
