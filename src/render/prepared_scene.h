// SPDX-License-Identifier: Apache-2.0
//
// From description to draws. In: a scene's description and the size of the picture. Out: shaders with their uniforms,
// vertex views and draw states, in drawing order, for a pass or for the naive pipeline.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/parallel.h"
#include "halfspace/geometry/mesh.h"
#include "halfspace/raster/pass.h"
#include "halfspace/render/model/model_choice.h"
#include "halfspace/render/particles.h"
#include "halfspace/render/view.h"
#include "halfspace/scene/description.h"
#include "halfspace/shading/environment_sky.h"
#include "halfspace/shading/shadow_map.h"
#include "halfspace/shading/sphere_impostor.h"
#include "halfspace/shading/star_sky.h"
#include "halfspace/shading/surface_shader.h"

namespace halfspace {

/// Every shader that a scene may draw by. What visits it compiles them all: add_draw.cpp, and one file of tests.
using SceneShader = std::variant<SurfaceShader<ShadingRate::none, false>, SurfaceShader<ShadingRate::none, true>,            //
                                 SurfaceShader<ShadingRate::flat, false>, SurfaceShader<ShadingRate::flat, true>,            //
                                 SurfaceShader<ShadingRate::provoking, false>, SurfaceShader<ShadingRate::provoking, true>,  //
                                 SurfaceShader<ShadingRate::gouraud, false>, SurfaceShader<ShadingRate::gouraud, true>,      //
                                 SurfaceShader<ShadingRate::gouraud, true, NormalDetail::none, false>,                       //
                                 SurfaceShader<ShadingRate::phong, false>, SurfaceShader<ShadingRate::phong, true>,          //
                                 SurfaceShader<ShadingRate::phong, true, NormalDetail::map>,                                 //
                                 SurfaceShader<ShadingRate::phong, true, NormalDetail::bump>,                                //
                                 SurfaceShader<ShadingRate::phong, true, NormalDetail::slopes>,                              //
                                 SphereImpostor<false>, SphereImpostor<true>, StarSky, EnvironmentSky>;

/// One draw. std::visit on the shader gives its type back.
struct PreparedDraw {
  SceneShader shader;
  VertexView vertices;
  std::shared_ptr<const Indices> indices;
  DrawState state;  ///< reversed Z: clear depth to 0
};

/// What opaque surfaces of scenes are drawn with: reversed Z, the nearest wins. mirrored: the object's transform turns windings.
DrawState opaque_state(CullMode cull, bool mirrored);

/// What spheres as points are drawn with.
DrawState sprite_state();

/// Adds it to a pass.
void add_draw(Pass& pass, const PreparedDraw& draw);

/// A mesh and its place: what shadow maps and rays are made from.
struct PlacedMesh {
  const Mesh* mesh;
  std::shared_ptr<const Indices> indices;
  glm::dmat4 world_from_object;
  bool two_sided, casts_shadow, receives_shadow;
  int object = 0;  ///< its place among the scene's objects

  bool mirrored() const { return glm::determinant(glm::dmat3(world_from_object)) < 0.0; }
};

/// Exact spheres of a scene: its particles, or an object's copies. Original sprites, which are no spheres, are not among them.
struct PlacedSpheres {
  std::shared_ptr<const Particles> particles;
  bool casts_shadow, receives_shadow;
  int object = -1;  ///< its place among the scene's objects; −1: the particles
};

/// A light as this picture has it.
struct PreparedLight {
  std::string name;
  Light light;  ///< its shadow is null where it casts none
  LightDescription description;
  double map_ms = 0.0;  ///< that its maps took
};

/// All that a picture needs. Movable; keeps alive what its draws point to.
struct PreparedScene {
  std::vector<PreparedDraw> draws;
  glm::vec4 clear_color{0, 0, 0, 1};  ///< linear
  PostDescription post;
  int samples = 1;  ///< of a pixel
  View view;
  std::vector<PlacedMesh> meshes;  ///< of every object that is drawn
  std::vector<PlacedSpheres> spheres;
  std::vector<PreparedLight> lights;
  PassStatistics shadow_statistics;  ///< of the passes that made shadow maps
  std::vector<std::shared_ptr<const void>> assets;
};

/// Makes textures, meshes and maps as descriptions ask for them, and keeps them for the next frame as long as it wants
/// the same.
class SceneAssets {
 public:
  explicit SceneAssets(const Workers& workers) : workers_(workers) {}

  /// Tells of a frame to come: from now on, generated maps without a width of their own are at least as fine as that frame
  /// needs. Told of all frames of a range before the first, they do not change on the way. width, height: of the picture, px.
  void expect(const SceneDescription& scene, int width, int height);

  /// The same scene with the cheapest models whose picture of that size is as right as asked (docs/accuracy.md): chosen by a model of
  /// errors and costs from the scene alone, so that it is the same on every machine. Throws as prepare does.
  FittedScene fit(const SceneDescription& scene, int width, int height, const AllowedError& allowed);

  /// width, height: of the picture, px. Throws InputError that begins with the key, where a file cannot be used.
  PreparedScene prepare(const SceneDescription& scene, int width, int height);

 private:
  friend class ScenePreparation;
  struct Entry {
    std::shared_ptr<const void> asset;
    bool wanted;  // since the last frame was prepared
  };
  const Workers& workers_;
  std::map<std::string, Entry> entries_;    ///< by what they are made from
  std::map<std::string, int> widths_;       ///< of generated maps, at least, by the object's name
  int panorama_width_ = 0, face_size_ = 0;  ///< of generated environments, at least
};

/// Draws the scene into 8-bit codes, as its post section says. Light is kept for the whole picture only where
/// auto_exposure must see all of it first; else it lives in the tiles.
PassStatistics render(const PreparedScene& scene, Image<glm::u8vec4>& picture, const Workers& workers);
/// Draws the scene as linear numbers, alpha 1: light before exposure and tone curve.
PassStatistics render(const PreparedScene& scene, Image<glm::vec4>& picture, const Workers& workers);

}  // namespace halfspace
