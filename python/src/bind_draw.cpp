// SPDX-License-Identifier: Apache-2.0
//
// Passes that draw arrays with the shaders of the library. They use the shader variants of scenes, which are already compiled.
#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

#include "bindings.h"
#include "halfspace/core/parallel.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/render/prepared_scene.h"
#include "matrices.h"

namespace halfspace::python {

namespace {

using Vector = std::array<float, 3>;

glm::vec3 vec_of(const Vector& v) { return {v[0], v[1], v[2]}; }

/// A shader with its uniforms and the data that they point to.
struct Shader {
  SceneShader shader;
  std::vector<std::string> attributes;  ///< names of the arrays that a draw needs
  std::shared_ptr<const std::vector<Light>> lights;
  std::shared_ptr<const Texture2D> texture;
};

Shader colored(const Array<double>& clip_from_object, const std::array<float, 4>& color) {
  return {
      ColoredPrimitives{glm::mat4(matrix_of(clip_from_object)), {color[0], color[1], color[2], color[3]}}, {"positions", "colors"}, {}, {}};
}

// Sets the transforms of a surface. The positions of lights are relative to the eye.
void place(PlacedSurface& s, const glm::dmat4& clip_from_world, glm::dmat4 world, const glm::dvec3& eye) {
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

void place(PlacedSurface& s, const Placing& p, Shader& out) {
  const glm::dvec3 eye(p.eye[0], p.eye[1], p.eye[2]);
  place(s, matrix_of(p.clip_from_world), matrix_of(p.world_from_object), eye);
  auto lights = std::make_shared<std::vector<Light>>(p.lights);
  for (Light& light : *lights) {
    if (light.type != LightType::directional) light.position_rws = glm::vec3(glm::dvec3(light.position_rws) - eye);
  }
  s.lights = *lights;
  s.two_sided = p.two_sided;
  out.lights = std::move(lights);
}

std::shared_ptr<const Texture2D> texture_of(const Array<uint8_t>& texels) {
  Image<glm::u8vec4> image(static_cast<int>(texels.shape(1)), static_cast<int>(texels.shape(0)));
  std::memcpy(image.data(), texels.data(), static_cast<std::size_t>(texels.nbytes()));
  return std::make_shared<const Texture2D>(image, TexelFormat::srgb8a8);
}

template <ShadingRate rate>
Shader lit_shader(const LitSurface& surface, bool mapped) {
  if (mapped) return {SurfaceShader<rate, true>{surface}, {"positions", "normals", "uvs"}, {}, {}};
  return {SurfaceShader<rate, false>{surface}, {"positions", "normals"}, {}, {}};
}

Shader phong(const Placing& placing, const std::vector<Vector>& factors, float shininess, LightModel model, bool per_vertex,
             const std::optional<Array<uint8_t>>& texels, const Sampler& sampler) {
  LitSurface s;
  Shader rest;
  place(s, placing, rest);
  for (std::size_t i = 0; i < factors.size() && i < kShininess; ++i) s.factors[i].constant = vec_of(factors[i]);
  s.factors[kShininess].constant = glm::vec3(shininess);
  s.model = model;
  if (texels) {
    rest.texture = texture_of(*texels);
    s.factors[kColor].map = rest.texture.get();
    s.factors[kColor].sampler = sampler;
  }
  Shader out = per_vertex ? lit_shader<ShadingRate::gouraud>(s, texels.has_value()) : lit_shader<ShadingRate::phong>(s, texels.has_value());
  out.lights = rest.lights;
  out.texture = rest.texture;
  return out;
}

Shader metallic(const Placing& placing, const std::array<float, 4>& base_color, float metallic, float roughness, const Vector& emissive,
                const Vector& ambient, bool colored, const std::optional<Array<uint8_t>>& texels, const Sampler& sampler) {
  MetallicMaterial m;
  Shader rest;
  place(m, placing, rest);
  m.base_color = {base_color[0], base_color[1], base_color[2], base_color[3]};
  m.metallic = metallic;
  m.roughness = roughness;
  m.emissive = vec_of(emissive);
  m.ambient = vec_of(ambient);
  m.blends = base_color[3] < 1.0f;
  if (texels) {
    rest.texture = texture_of(*texels);
    m.maps[kBaseColorMap].map = rest.texture.get();
    m.maps[kBaseColorMap].sampler = sampler;
    return {MetallicSurface<MetallicStreams::mapped>{m}, {"positions", "normals", "uvs"}, rest.lights, rest.texture};
  }
  if (colored) return {MetallicSurface<MetallicStreams::colored>{m}, {"positions", "normals", "colors"}, rest.lights, {}};
  return {MetallicSurface<MetallicStreams::basic>{m}, {"positions", "normals"}, rest.lights, {}};
}

/// A draw, and the objects that keep its arrays alive.
struct Draw {
  PreparedDraw draw;
  Shader shader;
  std::vector<py::object> arrays;
};

class ArrayPass {
 public:
  /// color and depth: arrays of width x height pixels in the format, or None.
  ArrayPass(int width, int height, ColorFormat color_format, py::object color, DepthFormat depth_format, py::object depth, int samples)
      : width_(width), height_(height), samples_(samples), color_(std::move(color)), depth_(std::move(depth)) {
    color_target_.format = color_format;
    color_target_.data = data_of(color_);
    color_target_.store = color_.is_none() ? StoreOp::dont_care : StoreOp::store;
    depth_target_.format = depth_format;
    depth_target_.data = data_of(depth_);
    depth_target_.store = depth_.is_none() ? StoreOp::dont_care : StoreOp::store;
  }

  void set_load(bool load, const std::array<float, 4>& clear_color, float clear_depth, uint8_t clear_stencil) {
    color_target_.load = load ? LoadOp::load : LoadOp::clear;
    depth_target_.load = load && depth_target_.data != nullptr ? LoadOp::load : LoadOp::clear;
    color_target_.clear_value = {clear_color[0], clear_color[1], clear_color[2], clear_color[3]};
    depth_target_.clear_value = clear_depth;
    depth_target_.stencil_clear_value = clear_stencil;
  }

  void draw(const Shader& shader, const std::vector<Array<float>>& streams, const std::optional<Array<uint32_t>>& indices,
            const DrawState& state) {
    std::array<VertexStream, kMaxStreams> list;
    std::vector<py::object> kept;
    for (std::size_t i = 0; i < streams.size(); ++i) {
      const auto n = static_cast<int32_t>(streams[i].shape(1));
      list.at(i) = {streams[i].data(), n, n, static_cast<std::size_t>(streams[i].shape(0)), 0};
      kept.push_back(streams[i]);
    }
    const VertexView view = detail::bind_streams(std::span(list).first(streams.size()));
    std::shared_ptr<const Indices> order;
    if (indices) {
      order = std::make_shared<const Indices>(std::span(indices->data(), static_cast<std::size_t>(indices->size())), view.vertex_count);
      kept.push_back(*indices);
    } else {
      order = std::make_shared<const Indices>(Indices::sequential(view.vertex_count));
    }
    Draw& added = draws_.emplace_back();
    added.draw.shader = shader.shader;
    added.draw.vertices = view;
    added.draw.indices = std::move(order);
    added.draw.state = state;
    added.shader = shader;
    added.arrays = std::move(kept);
  }

  /// Returns the number of draws.
  std::size_t run(int threads) {
    const std::vector<Draw> draws = std::exchange(draws_, {});
    try {
      const py::gil_scoped_release release;
      Pass pass(width_, height_, color_target_, depth_target_, {.samples = samples_});
      for (const Draw& d : draws) add_draw(pass, d.draw, d.draw.state);
      pass.run(Workers(threads));
    } catch (const std::logic_error& e) {  // a failed check
      throw InputError(std::string("pass: the draws are invalid (") + e.what() + ")");
    }
    return draws.size();
  }

 private:
  static std::byte* data_of(const py::object& array) {
    return array.is_none() ? nullptr : static_cast<std::byte*>(array.cast<py::array>().mutable_data());
  }

  int width_, height_, samples_;
  py::object color_, depth_;
  ColorTarget color_target_;
  DepthTarget depth_target_;
  std::vector<Draw> draws_;
};

Light light_of(LightType type, const Vector& place, const Vector& diffuse, const Vector& specular, const Vector& attenuation,
               const Vector& axis, float cos_inner, float cos_outer) {
  Light light;
  light.type = type;
  light.position_rws = vec_of(place);
  light.diffuse = vec_of(diffuse);
  light.specular = vec_of(specular);
  light.attenuation = vec_of(attenuation);
  light.axis_ws = vec_of(axis);
  light.cos_outer = cos_outer;
  light.cone_scale = 1.0f / std::max(cos_inner - cos_outer, 1e-6f);
  return light;
}

}  // namespace

void bind_draw(py::module_& m) {
  py::enum_<LightType>(m, "LightType")
      .value("directional", LightType::directional)
      .value("point", LightType::point)
      .value("spot", LightType::spot);
  py::enum_<LightModel>(m, "LightModel")
      .value("lambert", LightModel::lambert)
      .value("phong", LightModel::phong)
      .value("blinn_phong", LightModel::blinn_phong);
  py::class_<Light>(m, "Light").def(py::init(&light_of));
  py::class_<Placing>(m, "Placing")
      .def(py::init([](const Array<double>& clip_from_world, const Array<double>& world_from_object, const std::array<double, 3>& eye,
                       const std::vector<Light>& lights, bool two_sided) {
        return Placing{clip_from_world, world_from_object, eye, lights, two_sided};
      }));
  py::class_<Shader>(m, "Shader").def_readonly("attributes", &Shader::attributes);
  m.def("colored", &colored);
  m.def("phong", &phong);
  m.def("metallic", &metallic);
  py::class_<ArrayPass>(m, "Pass")
      .def(py::init<int, int, ColorFormat, py::object, DepthFormat, py::object, int>())
      .def("set_load", &ArrayPass::set_load)
      .def("draw", &ArrayPass::draw)
      .def("run", &ArrayPass::run);
}

}  // namespace halfspace::python
