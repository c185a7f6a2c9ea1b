// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/export/scene_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "halfspace/core/float_mode.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/core/units.h"
#include "halfspace/model/geometry/normals.h"
#include "halfspace/render/assets/model_asset.h"
#include "halfspace/render/export/append_model.h"
#include "halfspace/render/export/scene_materials.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/render/view.h"
#include "halfspace/scene/lights.h"

namespace halfspace::HS_LANES {

namespace {

// Generated maps get the resolution that an image of this size needs.
constexpr int kExportWidth = 1920, kExportHeight = 1080;
constexpr int kSphereLevel = 5;

glm::dquat turn_about(int axis, double degrees) {
  const auto [s, c] = sincos_turns(degrees / 720.0);  // half the angle
  glm::dvec3 v(0.0);
  v[axis] = s;
  return {c, v.x, v.y, v.z};
}

NodeTransform transform_of(const Placement& p) {
  const glm::dquat turn = turn_about(1, p.rotation.y) * turn_about(0, p.rotation.x) * turn_about(2, p.rotation.z);
  return {p.position, turn, p.scale};
}

// Returns a matrix whose −z axis points along `ahead` and whose y axis is as close to `up` as possible.
glm::dmat4 looking_along(const glm::dvec3& position, const glm::dvec3& ahead, const glm::dvec3& up) {
  const glm::dvec3 z = unit_or_zero(-ahead);
  glm::dvec3 x = unit_or_zero(glm::cross(up, z));
  if (x == glm::dvec3(0.0)) x = unit_or_zero(glm::cross(std::fabs(z.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), z));
  return {glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), glm::dvec4(position, 1.0)};
}

DrawnMesh drawn_mesh(const PreparedDraw& draw) {
  return std::visit(
      [&]<class S>(const S& shader) -> DrawnMesh {
        if constexpr (requires { S::kTangents; } && std::is_base_of_v<LitSurface, S>) {
          DrawnMesh mesh;
          mesh.surface = &shader;
          std::size_t next = S::kNormals ? 2 : 1;
          if constexpr (S::kTangents) mesh.tangents = draw.vertices.streams[next++];
          if constexpr (S::kMapped) mesh.uvs = draw.vertices.streams[next];
          mesh.flat = requires { typename S::template Primitive<float>; };
          mesh.unlit = !S::kByVertex && !S::kByPixel && !mesh.flat;
          mesh.has_normal_map = S::kTangents;
          mesh.has_other_detail = shader.detail.map != nullptr && !S::kTangents;
          return mesh;
        }
        return {};
      },
      draw.shader);
}

template <class V>
std::vector<V> stream_rows(const VertexStream& stream) {
  std::vector<V> rows(stream.data == nullptr ? 0 : stream.count);
  for (std::size_t i = 0; i < rows.size(); ++i) read_row(stream, i, &rows[i].x);
  return rows;
}

class SceneExporter {
 public:
  SceneExporter(const SceneDescription& scene, const PreparedScene& prepared) : scene_(scene), prepared_(prepared) {
    model_.format = "scene";
    model_.scenes.push_back({scene.head.title, {}});
    add_object_nodes();
  }

  Model model(bool with_lights) {
    add_meshes();
    for (const auto& [name, camera] : scene_.cameras) add_camera(name, camera);
    if (with_lights) {
      for (const auto& [name, light] : scene_.lights) add_light(name, light);
    }
    warn_about_omissions();
    return std::move(model_);
  }

  void add_file(const std::string& name, const ObjectDescription& o, const Model& file) {
    const PoseOptions options = pose_options(file, o, pose_places("objects." + name));
    const std::size_t copies = std::max<std::size_t>(o.instances.size(), 1);
    const auto roots = append_model(model_, file, options.scene < 0 ? file.scene : options.scene, options.variant, copies);
    const bool turned = o.up_axis == ModelUp::automatic ? file.up == UpAxis::z : o.up_axis == ModelUp::z;
    std::vector<int> children;
    for (std::size_t i = 0; i < copies; ++i) {
      ModelNode copy;
      if (!o.instances.empty()) place(copy, o.instances[i]);
      copy.children = roots[i];
      if (turned) {
        ModelNode turn;
        turn.transform.rotation = turn_about(0, -90.0);
        turn.children = roots[i];
        copy.children = {add_node(std::move(turn))};
      }
      children.push_back(add_node(std::move(copy)));
    }
    std::vector<int>& siblings = model_.nodes[node_of(name)].children;
    siblings.insert(siblings.end(), children.begin(), children.end());
    if (!o.model_animation.empty()) warn("animations of models are written, but the pose at model_time is not");
    if (!o.material.empty() || !o.model_materials.empty()) warn("materials that replace those of model files are omitted");
    for (const std::string& warning : file.warnings) warn(o.file.path.string() + ": " + warning);
  }

 private:
  void warn(const std::string& text) { warn_once(model_, text); }

  int add_node(ModelNode node) {
    model_.nodes.push_back(std::move(node));
    return static_cast<int>(model_.nodes.size()) - 1;
  }
  static void place(ModelNode& node, const Placement& p) {
    node.transform = transform_of(p);
    node.matrix = p.matrix;
  }

  // Returns the node of an object. Nodes have the same indices as objects.
  std::size_t node_of(const std::string& name) const {
    const auto is_this = [&](const auto& object) { return object.first == name; };
    return static_cast<std::size_t>(std::ranges::find_if(scene_.objects, is_this) - scene_.objects.begin());
  }

  // Adds a node for every object, including hidden ones, because they can be parents.
  void add_object_nodes() {
    for (const auto& [name, o] : scene_.objects) {
      ModelNode node;
      node.name = name;
      place(node, o.placement);
      add_node(std::move(node));
    }
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      const std::string& parent = scene_.objects[i].second.parent;
      (parent.empty() ? model_.scenes[0].roots : model_.nodes[node_of(parent)].children).push_back(static_cast<int>(i));
    }
  }

  void add_root(ModelNode node) { model_.scenes[0].roots.push_back(add_node(std::move(node))); }

  // The draws and the placed meshes of objects are in the same order. All copies of an object have the same mesh and material.
  void add_meshes() {
    std::size_t next = 0;
    int last_object = -1;
    for (const PreparedDraw& draw : prepared_.draws) {
      const DrawnMesh drawn = drawn_mesh(draw);
      if (drawn.surface == nullptr) continue;
      while (!is_surface(prepared_.meshes[next].object)) ++next;
      const PlacedMesh& placed = prepared_.meshes[next++];
      if (placed.object == last_object) continue;
      last_object = placed.object;
      add_object(placed, drawn);
    }
  }

  bool is_surface(int object) const {
    const ObjectDescription& o = scene_.objects[static_cast<std::size_t>(object)].second;
    return o.shape != Shape::file && !o.shadow_only;
  }

  void add_object(const PlacedMesh& placed, const DrawnMesh& drawn) {
    const auto& [name, o] = scene_.objects[static_cast<std::size_t>(placed.object)];
    const int mesh = add_mesh(name, placed, drawn, materials_.add(name, drawn));
    ModelNode& node = model_.nodes[static_cast<std::size_t>(placed.object)];
    for (const Placement& p : o.instances) node.instances.push_back(transform_of(p));
    node.meshes = {mesh};
  }

  int add_mesh(const std::string& name, const PlacedMesh& placed, const DrawnMesh& drawn, int material) {
    ModelMesh mesh;
    mesh.name = name;
    mesh.material = material;
    mesh.positions.assign(placed.positions.begin(), placed.positions.end());
    mesh.normals.assign(placed.normals.begin(), placed.normals.end());
    mesh.tangents = stream_rows<glm::vec4>(drawn.tangents);
    mesh.uvs[0] = stream_rows<glm::vec2>(drawn.uvs);
    for (std::size_t i = 0; i < placed.indices->size(); ++i) mesh.indices.push_back((*placed.indices)[i]);
    if (drawn.flat) add_flat_normals(mesh);
    model_.meshes.push_back(std::move(mesh));
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  void add_camera(const std::string& name, const CameraDescription& c) {
    ModelCamera camera;
    camera.name = name;
    camera.perspective = c.type == Projection::perspective;
    camera.fovy = c.fov * kRadiansPerDegree;
    camera.height = c.height;
    // Other viewers often have integer depth, which needs a near plane that is not extremely near.
    camera.far = c.far == 0.0 && camera.perspective ? std::numeric_limits<double>::infinity() : far_plane(c);
    camera.near = c.near == 0.0 && camera.perspective ? 1e-5 * (c.far == 0.0 ? 1000.0 : c.far) : c.near;
    ModelNode node;
    node.name = name;
    node.camera = static_cast<int>(model_.cameras.size());
    node.matrix = looking_along(c.position, c.target - c.position, c.up);
    model_.cameras.push_back(camera);
    add_root(std::move(node));
  }

  void add_light(const std::string& name, const LightDescription& d) {
    ModelLight light;
    light.name = name;
    light.color = glm::vec3(d.color.linear * d.diffuse);
    light.intensity = d.intensity * std::numbers::pi;
    if (light.intensity <= 0.0 || light.color == glm::vec3(0.0f)) return;
    const LightKind& kind = kind_of(d.type);
    light.type = kind.is_distant ? ModelLightType::directional : kind.has_cone ? ModelLightType::spot : ModelLightType::point;
    const float largest = std::max({light.color.x, light.color.y, light.color.z});
    if (largest > 1.0f) {
      light.color /= largest;
      light.intensity *= static_cast<double>(largest);
    }
    constexpr double kMinCone = 1e-4;
    light.outer = std::clamp(d.outer * kRadiansPerDegree, kMinCone, std::numbers::pi / 2.0);
    if (!kind.is_distant) light.range = d.range;
    light.inner = std::clamp(d.inner * kRadiansPerDegree, 0.0, light.outer - 0.5 * kMinCone);
    if (!kind.is_distant && d.falloff != Falloff::physical) warn("all lights are exported with physical falloff");
    if (d.specular != d.diffuse) warn("lights have the same intensity for diffuse and specular light");
    ModelNode node;
    node.name = name;
    node.light = static_cast<int>(model_.lights.size());
    node.matrix = looking_along(kind.is_distant ? glm::dvec3(0.0) : d.position, -d.direction, {0, 1, 0});
    model_.lights.push_back(light);
    add_root(std::move(node));
  }

  void warn_about_omissions() {
    const bool has_particles = scene_.particles.count > 0 || !scene_.particles.file.path.empty() || !scene_.particle_systems.empty();
    if (has_particles) warn("particles are omitted");
    if (!scene_.environments.empty() || scene_.background.type != BackgroundType::color) warn("environments and backgrounds are omitted");
    const auto is_ambient = [](const auto& light) { return light.second.ambient > 0.0; };
    if (scene_.head.ambient.linear != glm::dvec3(0.0) || std::ranges::any_of(scene_.lights, is_ambient)) warn("ambient light is omitted");
    if (!scene_.animations.empty()) warn("scene animations are omitted");
  }

  const SceneDescription& scene_;
  const PreparedScene& prepared_;
  Model model_;
  SceneMaterials materials_{model_};
};

}  // namespace

Model scene_model(SceneDescription scene, SceneAssets& assets, bool with_lights, const MemoryModels& models) {
  const FloatMode float_mode;
  scene.shadow.method = ShadowMethod::none;
  for (auto& [name, object] : scene.objects) {
    object.mesh_error = 0.0;  // the model has no view
    if (object.shape != Shape::sphere) continue;
    object.shape = Shape::icosphere;
    object.level = kSphereLevel;
  }
  SceneDescription meshes = scene;
  for (auto& [name, object] : meshes.objects) object.visible = object.visible && object.shape != Shape::file;
  const PreparedScene prepared = assets.prepare(meshes, kExportWidth, kExportHeight);
  SceneExporter exporter(meshes, prepared);
  for (const auto& [name, object] : scene.objects) {
    if (object.shape != Shape::file || !object.visible) continue;
    const auto known = models.find(object.file.path.string());
    if (known != models.end()) {
      exporter.add_file(name, object, known->second->model);
    } else {
      exporter.add_file(name, object, read_model(object.file.path, {.allow_outside = object.allow_outside}));
    }
  }
  return exporter.model(with_lights);
}

}  // namespace halfspace::HS_LANES
