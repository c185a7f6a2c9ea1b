// SPDX-License-Identifier: Apache-2.0
//
// A scene that is ready to draw in an image of a given size: shaders with their uniforms, vertex views and draw states, in drawing order,
// for a Pass or for the naive pipeline. SceneAssets (render/scene_assets.h) creates it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/raster/clusters.h"
#include "halfspace/raster/pass.h"
#include "halfspace/render/mesh_streams.h"
#include "halfspace/render/particles.h"
#include "halfspace/render/view.h"
#include "halfspace/scene/description.h"
#include "halfspace/shading/environment/environment_sky.h"
#include "halfspace/shading/environment/star_sky.h"
#include "halfspace/shading/shadow/shadow_map.h"
#include "halfspace/shading/sphere/sphere_impostor.h"
#include "halfspace/shading/surface/colored_primitives.h"
#include "halfspace/shading/surface/masked_depth.h"
#include "halfspace/shading/surface/metallic_surface.h"
#include "halfspace/shading/surface/normal_lines.h"
#include "halfspace/shading/surface/shadow_catcher.h"
#include "halfspace/shading/surface/surface_shader.h"

namespace halfspace::HS_LANES {

/// All shaders that a scene can use. Every std::visit over this type instantiates all of them, so only a few translation units may do so.
using SceneShader = std::variant<SurfaceShader<ShadingRate::none, false>, SurfaceShader<ShadingRate::none, true>,            //
                                 SurfaceShader<ShadingRate::flat, false>, SurfaceShader<ShadingRate::flat, true>,            //
                                 SurfaceShader<ShadingRate::provoking, false>, SurfaceShader<ShadingRate::provoking, true>,  //
                                 SurfaceShader<ShadingRate::gouraud, false>, SurfaceShader<ShadingRate::gouraud, true>,      //
                                 SurfaceShader<ShadingRate::gouraud, true, NormalDetail::none, false>,                       //
                                 SurfaceShader<ShadingRate::phong, false>, SurfaceShader<ShadingRate::phong, true>,          //
                                 SurfaceShader<ShadingRate::phong, true, NormalDetail::map>,                                 //
                                 SurfaceShader<ShadingRate::phong, true, NormalDetail::bump>,                                //
                                 SurfaceShader<ShadingRate::phong, true, NormalDetail::slopes>,                              //
                                 SphereImpostor<false>, SphereImpostor<true>, StarSky, EnvironmentSky,                       //
                                 MetallicSurface<MetallicStreams::basic>, MetallicSurface<MetallicStreams::colored>,         //
                                 MetallicSurface<MetallicStreams::mapped>, MetallicSurface<MetallicStreams::mapped, true>,   //
                                 MetallicSurface<MetallicStreams::detailed>, MetallicSurface<MetallicStreams::detailed, true>,
                                 MetallicSurface<MetallicStreams::full>, MetallicSurface<MetallicStreams::full, true>,  //
                                 ColoredPrimitives, NormalLines, ShadowCatcher>;

/// The origin of a draw, for the values of a frame other than its color (render/frame/frame.h).
struct DrawSource {
  int object = -1;        ///< as in FrameImages::object; −1: the background
  int instance = 0;       ///< copy · parts of the model + part
  MeshStreams streams{};  ///< includes streams that the shader does not read; empty for spheres, lines of normals and the background
  glm::dmat4 world_from_object{1.0};  ///< identity for spheres and the background
};

/// One draw call. std::visit recovers the type of the shader.
struct PreparedDraw {
  SceneShader shader;
  VertexView vertices;
  std::shared_ptr<const Indices> indices;
  DrawState state;  ///< uses reversed Z: clear depth to 0
  DrawSource source{};
};

/// Returns the draw state of opaque surfaces, with reversed Z. `mirrored` must be set if the object's transform inverts the
/// winding.
DrawState opaque_state(CullMode cull, bool mirrored);

/// Returns the draw state of spheres drawn as points.
DrawState sprite_state();

/// A mesh and its transform, for shadow maps and ray tracing.
struct PlacedMesh {
  std::span<const glm::vec3> positions, normals;  ///< one per vertex; not owned
  std::shared_ptr<const Indices> indices;         ///< of triangles
  glm::dmat4 world_from_object;
  bool two_sided, casts_shadow, receives_shadow;
  int object = 0;  ///< index in the scene's objects
  /// Set for masked and blended surfaces; selects the parts that cast shadows. Ray tracing treats these surfaces as opaque.
  std::optional<OpacityTest> opacity{};
  std::span<const glm::vec2> uvs{};     ///< for `opacity`; empty: (0, 0); not owned
  std::span<const glm::vec4> colors{};  ///< for `opacity`: alpha multiplies it; empty: alpha 1; not owned
  const Clusters* clusters = nullptr;   ///< of `indices`, or null; not owned
  /// The positions were made for this frame, for example by a skin. Those of other meshes last as long as `indices`.
  bool deformed = false;

  bool mirrored() const { return glm::determinant(glm::dmat3(world_from_object)) < 0.0; }
};

/// Exact spheres of a scene: its particles, or the copies of an object. Original sprites are not spheres and are not included.
struct PlacedSpheres {
  std::shared_ptr<const Particles> particles;
  bool casts_shadow, receives_shadow;
  int object = -1;  ///< index in the scene's objects; −1: particles
};

/// What has been simplified of a model file, or adapted to the view.
struct SimplifiedObject {
  int object = 0;          ///< index in the scene's objects
  uint64_t triangles = 0;  ///< of the file, in all copies; of a mesh that is everywhere as fine as its finest part
  uint64_t drawn = 0;
  /// No outline is off by more, in pixels, except that of folds of one-sided surfaces with a border (docs/explanation/max_error.md).
  double error_px = 0.0;
  bool is_estimate = false;  ///< error_px is not a bound, because a surface is known at the vertices of a grid only
};

/// A light, prepared for one image.
struct PreparedLight {
  std::string name;
  Light light;  ///< Light::shadow is null if it casts no shadow
  LightDescription description;
  double map_ms = 0.0;  ///< time to create its shadow maps
};

/// Everything needed to render an image. Movable. Keeps the assets alive that its draws point to.
struct PreparedScene {
  std::vector<PreparedDraw> draws;
  glm::vec4 clear_color{0, 0, 0, 1};  ///< linear
  bool transparent = false;           ///< colors are premultiplied by alpha, which is 0 where nothing is drawn
  PostDescription post;
  int samples = 1;  ///< per pixel
  View view;
  std::vector<PlacedMesh> meshes;  ///< meshes of all objects that are drawn
  std::vector<PlacedSpheres> spheres;
  std::vector<PreparedLight> lights;
  std::vector<SimplifiedObject> simplified;  ///< objects with ObjectDescription::model_error or mesh_error
  PassStatistics shadow_statistics;          ///< sum over the passes that rendered shadow maps
  double images_ms = 0.0;                    ///< time to decode images of models
  std::vector<std::shared_ptr<const void>> assets;
};

}  // namespace halfspace::HS_LANES
