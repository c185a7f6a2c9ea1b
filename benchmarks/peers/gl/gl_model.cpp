// SPDX-License-Identifier: Apache-2.0
#include "peers/gl/gl_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <variant>

#include "halfspace/core/check.h"
#include "halfspace/core/cube_map.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/shading/environment/environment_light.h"
#include "peers/gl/gl_model_glsl.h"
#include "peers/gl/gl_workload.h"
#include "workloads/model_workload.h"

namespace halfspace {

namespace {

using Surface = MetallicSurface<MetallicStreams::basic>;

[[noreturn]] void refuse(const std::string& file, const std::string& problem) {
  throw InputError(file + ": " + problem +
                   "; expected opaque materials without textures, vertex colors, clearcoat or sheen, and only directional lights");
}

const Surface& surface_of(const PreparedDraw& draw, const std::string& file) {
  const auto* surface = std::get_if<Surface>(&draw.shader);
  if (surface == nullptr) refuse(file, "has a material with textures or vertex colors, or is not a triangle mesh");
  if (surface->clearcoat > 0.0f || surface->sheen > 0.0f || surface->blends || surface->unlit)
    refuse(file, "has a material that is blended, unlit or coated, or has sheen");
  if (surface->environment == nullptr || surface->environment->weight != 0.0f) refuse(file, "has no environment, or more than one");
  for (const Light& light : surface->lights) {
    if (light.type != LightType::directional) refuse(file, "has a point or spot light");
  }
  return *surface;
}

// A float texture with bilinear filtering, clamped at its edges.
class FloatTexture {
 public:
  explicit FloatTexture(GLenum target) : target_(target) {
    glGenTextures(1, &id_);
    bind();
    set(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    set(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    set(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    set(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  ~FloatTexture() { glDeleteTextures(1, &id_); }
  FloatTexture(const FloatTexture&) = delete;
  FloatTexture& operator=(const FloatTexture&) = delete;
  void bind() const { glBindTexture(target_, id_); }
  void set(GLenum name, GLenum value) const { glTexParameteri(target_, name, static_cast<GLint>(value)); }

 private:
  GLenum target_;
  GLuint id_ = 0;
};

// Copies the mip levels of a prefiltered environment. A lookup at the center of a texel returns the texel.
class RadianceTexture : public FloatTexture {
 public:
  explicit RadianceTexture(const EnvironmentMap& map) : FloatTexture(GL_TEXTURE_CUBE_MAP) {
    set(GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    set(GL_TEXTURE_MAX_LEVEL, static_cast<GLenum>(map.levels() - 1));
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    for (int level = 0; level < map.levels(); ++level) {
      for (int face = 0; face < 6; ++face) upload(map, level, face);
    }
  }

 private:
  static void upload(const EnvironmentMap& map, int level, int face) {
    const int size = map.width(level);
    Image<glm::vec4> texels(size, size);
    const auto along = [size](int i) { return (2.0 * i + 1.0) / size - 1.0; };
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const glm::vec3 direction(cube_direction(face, along(x), along(y)));
        const vec3<float> light = map.sample_level<float>(direction, static_cast<float>(level));
        texels.at(x, y) = {light.x, light.y, light.z, 1.0f};
      }
    }
    glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), level, GL_RGBA32F, size, size, 0, GL_RGBA, GL_FLOAT,
                 texels.data());
  }
};

// Copies the lookup table behind directional_reflectance.
class ReflectanceTexture : public FloatTexture {
 public:
  ReflectanceTexture() : FloatTexture(GL_TEXTURE_2D) {
    constexpr int kSize = 32;  // width and height of the table
    Image<glm::vec2> texels(kSize, kSize);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const auto r = directional_reflectance<float>((static_cast<float>(y) + 0.5f) / kSize, (static_cast<float>(x) + 0.5f) / kSize);
        texels.at(x, y) = {r.f0, r.f90};
      }
    }
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, kSize, kSize, 0, GL_RG, GL_FLOAT, texels.data());
  }
};

struct ModelVertex {
  glm::vec3 position, normal;
};

// The meshes of all draws in one buffer.
struct Geometry {
  std::vector<ModelVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<std::size_t> first{0};  // index of each draw, and the end

  explicit Geometry(const PreparedScene& scene) {
    for (const PreparedDraw& draw : scene.draws) {
      const MeshStreams& mesh = draw.source.streams;
      const auto base = static_cast<uint32_t>(vertices.size());
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) vertices.push_back({mesh.positions[i], mesh.normals[i]});
      for (std::size_t i = 0; i < draw.indices->size(); ++i) indices.push_back(base + (*draw.indices)[i]);
      first.push_back(indices.size());
    }
  }
};

// The uniforms that differ between draws.
class SurfaceUniforms {
 public:
  explicit SurfaceUniforms(const GlProgram& program) {
    for (std::size_t i = 0; i < kNames.size(); ++i) locations_[i] = program.location(kNames[i]);
  }
  void set(const Surface& s) const {
    // OpenGL's depth range; the draws have reversed Z from 1 to 0.
    glm::mat4 forward(1.0f);
    forward[2][2] = -2.0f;
    forward[3][2] = 1.0f;
    const glm::mat4 clip_from_object = forward * s.clip_from_object;
    glUniformMatrix4fv(locations_[0], 1, GL_FALSE, &clip_from_object[0][0]);
    glUniformMatrix4fv(locations_[1], 1, GL_FALSE, &s.world_from_object[0][0]);
    glUniformMatrix3fv(locations_[2], 1, GL_FALSE, &s.normal_from_object[0][0]);
    glUniform3fv(locations_[3], 1, &s.base_color[0]);
    glUniform3fv(locations_[4], 1, &s.specular_color[0]);
    glUniform3fv(locations_[5], 1, &s.emissive[0]);
    glUniform1f(locations_[6], std::clamp(s.metallic, 0.0f, 1.0f));
    glUniform1f(locations_[7], s.roughness);
    glUniform1f(locations_[8], s.specular);
    glUniform1f(locations_[9], s.normal_reflectance);
    glUniform1f(locations_[10], s.two_sided ? 1.0f : 0.0f);
  }

 private:
  static constexpr std::array<const char*, 11> kNames{
      "clip_from_object",  "world_from_object", "normal_from_object", "base",     "specular_color", "emissive", "metal",
      "surface_roughness", "strength",          "normal_reflectance", "two_sided"};
  std::array<GLint, 11> locations_{};
};

std::string shared_glsl(const Surface& surface) {
  return fmt::format("#define LIGHTS {}\n#define MIN_ROUGHNESS {:.9f}\n#define LAST_LEVEL {}.0\n{}", surface.lights.size(), kMinRoughness,
                     FilteredEnvironment::kLevels - 1, kModelShared);
}

class GlModel final : public GlWorkload {
 public:
  GlModel(const GlInput& in, const std::string& file, int samples)
      : GlWorkload(in, false),
        scene_(prepared_model(file, in.size, samples)),
        light_(in.size, GL_RGBA16F, samples == 1),
        program_(shared_glsl(front(file)), kModelVertex, kModelFragment),
        uniforms_(program_),
        radiance_(front(file).environment->first.map->radiance) {
    if (samples > 1) samples_ = std::make_unique<GlTarget>(in.size, GLenum{GL_RGBA16F}, true, samples);
    for (const PreparedDraw& draw : scene_.draws) surface_of(draw, file);  // throws if it is not supported
    const Geometry geometry(scene_);
    first_ = geometry.first;
    mesh_ = std::make_unique<GlMesh>(floats_of(std::span<const ModelVertex>(geometry.vertices)), std::initializer_list<int>{3, 3},
                                     geometry.indices);
    set_lights(front(file));
    tone_.set("light", 0);
    tone_.set("exposure", static_cast<float>(scene_.post.exposure));
  }

  bool has_truth() const override { return false; }  // the picture is compared with Halfspace's
  std::unique_ptr<Workload> twin() const override { return make_twin(); }

 private:
  const Surface& front(const std::string& file) const {
    if (scene_.draws.empty()) refuse(file, "has nothing to draw");
    return surface_of(scene_.draws.front(), file);
  }

  // Lights and environment are the same for all draws.
  void set_lights(const Surface& s) {
    for (std::size_t i = 0; i < s.lights.size(); ++i) {
      const Light& light = s.lights[i];
      program_.set(fmt::format("light_towards[{}]", i).c_str(), light.position_rws);
      program_.set(fmt::format("light_diffuse[{}]", i).c_str(), light.diffuse);
      program_.set(fmt::format("light_specular[{}]", i).c_str(), light.specular);
    }
    const EnvironmentLight& around = s.environment->first;
    for (std::size_t i = 0; i < around.map->harmonics.size(); ++i)
      program_.set(fmt::format("harmonics[{}]", i).c_str(), around.map->harmonics[i]);
    program_.set("ambient", s.ambient);
    program_.set("brightness", around.brightness);
    glUniformMatrix3fv(program_.location("map_from_world"), 1, GL_FALSE, &around.map_from_world[0][0]);
    program_.set("reflectance", 0);
    program_.set("radiance", 1);
  }

  void draw() override {
    const GlTarget& drawn = samples_ ? *samples_ : light_;
    drawn.bind();
    drawn.clear(scene_.clear_color);
    glActiveTexture(GL_TEXTURE1);
    radiance_.bind();
    glActiveTexture(GL_TEXTURE0);
    reflectance_.bind();
    program_.use();
    for (std::size_t i = 0; i < scene_.draws.size(); ++i) {
      const DrawState& state = scene_.draws[i].state;
      uniforms_.set(std::get<Surface>(scene_.draws[i].shader));
      (state.cull == CullMode::none ? glDisable : glEnable)(GL_CULL_FACE);
      glFrontFace(state.front == Winding::clockwise ? GL_CW : GL_CCW);
      mesh_->draw_part(GL_TRIANGLES, first_[i], first_[i + 1] - first_[i], 1);
    }
    glFrontFace(GL_CCW);
    if (samples_) samples_->resolve_into(light_);
    target().bind();
    light_.bind_color();
    tone_.use();
    empty_.draw(GL_TRIANGLES);
  }

  PreparedScene scene_;
  GlTarget light_;
  std::unique_ptr<GlTarget> samples_;  // null with one sample
  GlProgram program_;
  SurfaceUniforms uniforms_;
  RadianceTexture radiance_;
  ReflectanceTexture reflectance_;
  std::unique_ptr<GlMesh> mesh_;
  std::vector<std::size_t> first_;
  GlProgram tone_{"", kModelToneVertex, kModelToneFragment};
  GlMesh empty_{std::array<float, 3>{}, {1}};  // three vertices; the shader only reads gl_VertexID
};

}  // namespace

std::vector<WorkloadKind> gl_model_workloads(const std::string& file) {
  std::vector<WorkloadKind> kinds = model_workloads(file);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    kinds[i].prepare = [twin = kinds[i], file, samples = model_rows()[i].samples](WorkloadSize size, WorkloadAssets& assets) {
      return std::make_unique<GlModel>(GlInput{twin, size, assets}, file, samples);
    };
  }
  return kinds;
}

}  // namespace halfspace
