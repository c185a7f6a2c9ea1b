// SPDX-License-Identifier: Apache-2.0
//
// The contents of a model file: meshes, materials, textures and a hierarchy of nodes. All readers (OBJ, glTF, PLY, STL) produce the
// same structs, so that code that draws a model does not depend on its format. All references between items are indices into the
// lists of Model; -1 means none. Readers check all indices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/resource_limits.h"
#include "halfspace/shading/texture/sampler.h"

namespace halfspace::HS_LANES {

// ---- textures --------------------------------------------------------------------------------------------------

/// Textures of a specular-glossiness material that are converted texel by texel (KHR_materials_pbrSpecularGlossiness).
struct SpecularGlossiness {
  enum class Result : uint8_t {
    base_color,         ///< sRGB, with the alpha of the diffuse texture
    metallic_roughness  ///< linear: roughness in green, metalness in blue
  };

  /// Diffuse color, and specular color (sRGB) with the glossiness in alpha. -1: the property has no texture.
  int diffuse_texture = -1, specular_texture = -1;
  glm::vec3 diffuse{1.0f}, specular{1.0f};  ///< linear; they multiply the textures
  float glossiness = 1.0f;
  Result result = Result::base_color;

  /// Returns true if both images are results of the same conversion.
  bool same_sources(const SpecularGlossiness& other) const {
    return diffuse_texture == other.diffuse_texture && specular_texture == other.specular_texture && diffuse == other.diffuse &&
           specular == other.specular && glossiness == other.glossiness;
  }
};

/// An image: a file, the bytes of a file (PNG, JPEG, ...) that were stored in the model file, pixels that a program provides, or the result
/// of a conversion.
struct ModelImage {
  std::string name;                                     ///< for messages: the path or name in the model file
  std::filesystem::path file;                           ///< absolute; empty if `bytes` or `pixels` has the image or there is none
  std::shared_ptr<const std::vector<std::byte>> bytes;  ///< null if the image is a file
  std::shared_ptr<const ColorPicture> pixels{};         ///< replaces the other two; never set by readers. Straight alpha
  bool missing = false;                                 ///< a material uses the image, but the reader did not find it
  std::optional<SpecularGlossiness> converted{};        ///< replaces file, bytes and pixels

  /// Returns whether there is a file, bytes or pixels.
  bool has_content() const { return !file.empty() || bytes != nullptr || pixels != nullptr; }
};

/// An image and how it is sampled.
struct ModelTexture {
  int image = -1;
  Sampler sampler;
};

/// Maximum anisotropy of model textures that are filtered with mip levels.
inline constexpr int kModelAnisotropy = 8;

/// A channel of a texture: red, green, blue, alpha, or the luminance of the color.
enum class Channel : uint8_t { red, green, blue, alpha, luminance };

/// A texture as used by one property of a material.
struct TextureUse {
  int texture = -1;                ///< -1: the property has no texture
  int uv_set = 0;                  ///< 0 or 1: index in ModelMesh::uvs
  glm::mat3x2 uv_transform{1.0f};  ///< uv' = uv_transform · (u, v, 1)
  Channel channel = Channel::red;  ///< for properties that are single numbers
};

// ---- materials -------------------------------------------------------------------------------------------------

/// How opacity is used. `mask`: the surface exists where opacity ≥ ModelMaterial::alpha_cutoff. `blend`: the surface is blended over its
/// background with its opacity.
enum class AlphaMode : uint8_t { opaque, mask, blend };

/// A metallic-roughness material (glTF 2.0, section 3.9 and appendix B). Every property is its factor times its texture. Color factors are
/// linear; base color, emissive, specular color and sheen color textures are encoded in sRGB; all others are linear. Readers convert other
/// kinds of materials.
struct ModelMaterial {
  std::string name;
  bool is_default = false;           ///< replaces the missing material of a mesh
  std::array<int, 2> uv_sets{0, 1};  ///< the file's UV sets that ModelMesh::uvs contains if the mesh has this material; -1: none
  glm::vec4 base_color{1.0f};        ///< linear; w is the opacity
  TextureUse base_color_map;         ///< its alpha channel multiplies the opacity
  TextureUse opacity_map;            ///< a separate opacity map; multiplies the opacity
  AlphaMode alpha_mode = AlphaMode::opaque;
  /// Whether `mask` is only a guess, because the format does not say how opacity is used: if the opacity map has many values between 0 and
  /// 1, the surface is blended.
  bool mask_unless_soft = false;
  float alpha_cutoff = 0.5f;
  float metallic = 0.0f, roughness = 1.0f;
  TextureUse metallic_map, roughness_map;
  float specular = 1.0f;           ///< scales the normal-incidence reflectance of non-metals (KHR_materials_specular)
  glm::vec3 specular_color{1.0f};  ///< linear
  TextureUse specular_map, specular_color_map;
  float ior = 1.5f;  ///< index of refraction, ≥ 1
  float clearcoat = 0.0f, clearcoat_roughness = 0.0f;
  TextureUse clearcoat_map, clearcoat_roughness_map, clearcoat_normal_map;
  float clearcoat_normal_scale = 1.0f;
  float sheen = 0.0f;           ///< scales sheen_color; 0: none
  glm::vec3 sheen_color{1.0f};  ///< linear (KHR_materials_sheen)
  float sheen_roughness = 0.0f;
  TextureUse sheen_map, sheen_color_map, sheen_roughness_map;
  TextureUse normal_map;      ///< tangent space, green up
  float normal_scale = 1.0f;  ///< scales x and y of the normal map
  TextureUse bump_map;        ///< heights, used where there is no normal map; only the first channel counts
  float bump_scale = 1.0f;    ///< height of the value 1 in model units
  TextureUse occlusion_map;
  float occlusion_strength = 1.0f;
  glm::vec3 emissive{0.0f};  ///< linear, may exceed 1
  TextureUse emissive_map;
  bool unlit = false;  ///< the base color is the result, without lighting
  bool double_sided = false;
};

/// All texture uses of a material.
inline constexpr std::array kTextureUses{&ModelMaterial::base_color_map,       &ModelMaterial::opacity_map,
                                         &ModelMaterial::metallic_map,         &ModelMaterial::roughness_map,
                                         &ModelMaterial::specular_map,         &ModelMaterial::specular_color_map,
                                         &ModelMaterial::clearcoat_map,        &ModelMaterial::clearcoat_roughness_map,
                                         &ModelMaterial::clearcoat_normal_map, &ModelMaterial::sheen_map,
                                         &ModelMaterial::sheen_color_map,      &ModelMaterial::sheen_roughness_map,
                                         &ModelMaterial::normal_map,           &ModelMaterial::bump_map,
                                         &ModelMaterial::occlusion_map,        &ModelMaterial::emissive_map};

// ---- meshes ----------------------------------------------------------------------------------------------------

enum class MeshTopology : uint8_t { triangles, lines, points };

/// Offsets that are added to the vertices of a mesh, scaled by a weight. Each list is empty or has one entry per vertex.
struct MorphTarget {
  std::vector<glm::vec3> positions, normals, tangents;
};

/// Vertices of one material. Every non-empty list has one entry per vertex.
struct ModelMesh {
  std::string name;
  MeshTopology topology = MeshTopology::triangles;
  glm::dvec3 origin{0.0};  ///< position of a vertex in the space of its node: origin + positions[i]
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;             ///< unit length; always present in triangle meshes that a reader returns
  bool computed_normals = false;              ///< the file has no normals for this mesh
  std::vector<glm::vec4> tangents;            ///< as in Mesh: xyz along increasing u, w is the sign of the bitangent
  std::array<std::vector<glm::vec2>, 2> uvs;  ///< v = 0 is the top row of the image
  std::vector<glm::vec4> colors;              ///< linear, multiplied by the base color
  std::vector<uint32_t> indices;  ///< a list of triangles or line segments; for points, empty or the vertices to draw. All are in range.
  int material = -1;              ///< -1: ModelMaterial{}
  std::vector<int> variant_materials;  ///< one per Model::variants, or empty
  std::vector<MorphTarget> targets;
  std::vector<std::array<uint16_t, 4>> joints;       ///< indices into ModelSkin::joints
  std::vector<glm::vec4> weights;                    ///< weights of the joints; they add up to 1 for each vertex
  std::vector<std::array<uint16_t, 4>> more_joints;  ///< joints 5 to 8 of every vertex; empty if no vertex has more than 4
  std::vector<glm::vec4> more_weights;
};

// ---- nodes -----------------------------------------------------------------------------------------------------

/// A transform as translation · rotation · scale. `rotation` has unit length.
struct NodeTransform {
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // w, x, y, z
  glm::dvec3 scale{1.0};
};

struct ModelNode {
  std::string name;
  NodeTransform transform;
  std::optional<glm::dmat4> matrix;  ///< replaces `transform`
  std::vector<int> children;         ///< the hierarchy is a forest: every node has at most one parent and there are no cycles
  std::vector<int> meshes;
  int skin = -1, camera = -1, light = -1;
  bool visible = true;                   ///< false: the meshes and lights of the node and of its descendants are not drawn
  std::vector<float> morph_weights;      ///< weights of the morph targets of the node's meshes; empty if all are 0
  std::vector<NodeTransform> instances;  ///< transforms of copies relative to the node; empty for a single copy
};

/// A set of joints that deform a mesh.
struct ModelSkin {
  std::vector<int> joints;                  ///< nodes
  std::vector<glm::dmat4> joint_from_mesh;  ///< inverse bind matrices, one per joint
};

/// A camera at the origin of its node, looking along -z, with y up.
struct ModelCamera {
  std::string name;
  bool perspective = true;
  double fovy = 0.8;                ///< full vertical angle in radians, in (0, π)
  double height = 2.0;              ///< height of the view volume of an orthographic camera
  double near = 0.1, far = 1000.0;  ///< far may be infinity
};

enum class ModelLightType : uint8_t { directional, point, spot };

/// A light at the origin of its node that shines along -z (KHR_lights_punctual).
struct ModelLight {
  std::string name;
  ModelLightType type = ModelLightType::directional;
  glm::vec3 color{1.0f};                           ///< linear
  double intensity = 1.0;                          ///< candela, or lux for a directional light
  double range = 0.0;                              ///< 0: unlimited
  double inner = 0.0, outer = 0.7853981633974483;  ///< half angles of the cone in radians
};

struct ModelScene {
  std::string name;
  std::vector<int> roots;
};

// ---- animation -------------------------------------------------------------------------------------------------

enum class AnimatedProperty : uint8_t { translation, rotation, scale, weights, visibility };
enum class KeyInterpolation : uint8_t { step, linear, cubic };

/// The values of one property of one node over time.
struct AnimationChannel {
  int node = -1;
  AnimatedProperty property = AnimatedProperty::translation;
  KeyInterpolation interpolation = KeyInterpolation::linear;
  std::vector<float> times;   ///< seconds, strictly increasing
  std::vector<float> values;  ///< `width` numbers per keyframe; three times as many for `cubic`: in-tangent, value, out-tangent
  /// Numbers per value: 3, 4 (rotation as x, y, z, w), the number of morph targets, or 1 (visibility: 0 is hidden).
  int width = 3;
};

struct ModelAnimation {
  std::string name;
  std::vector<AnimationChannel> channels;
};

// ---- model -----------------------------------------------------------------------------------------------------

/// The direction that points up in a model.
enum class UpAxis : uint8_t { y, z };

struct Model {
  std::string format;  ///< "OBJ", "glTF", "PLY", "STL"
  UpAxis up = UpAxis::y;
  std::vector<ModelImage> images;
  std::vector<ModelTexture> textures;
  std::vector<ModelMaterial> materials;
  std::vector<ModelMesh> meshes;
  std::vector<ModelNode> nodes;
  std::vector<ModelSkin> skins;
  std::vector<ModelCamera> cameras;
  std::vector<ModelLight> lights;
  std::vector<ModelScene> scenes;  ///< at least one
  int scene = 0;                   ///< the default scene
  std::vector<ModelAnimation> animations;
  std::vector<std::string> variants;
  std::vector<std::string> extensions;              ///< the extensionsUsed list of the file
  std::vector<std::string> unsupported_extensions;  ///< extensions in this list that have no effect
  std::vector<std::filesystem::path> files;         ///< absolute: other files that were read, such as buffers and material libraries
  std::vector<std::string> warnings;                ///< one line for each problem that was ignored or repaired
};

/// Returns all files that the model and its images are read from, except for the model file itself.
std::vector<std::filesystem::path> files_of(const Model& model);

/// Limits and permissions for reading a model.
struct ReadModelOptions {
  bool allow_outside = false;                             ///< open referenced files outside the folder of the model
  std::size_t max_memory = resource_limits().max_memory;  ///< memory limit in bytes, checked before memory is allocated
  std::size_t memory_in_use = 0;                          ///< part of max_memory; read_model() adds what else is in memory
  float crease_degrees = 30.0f;                           ///< OBJ, PLY and STL without normals: edges sharper than this stay sharp

  /// Returns the part of max_memory that is not in use.
  std::size_t memory_left() const { return max_memory > memory_in_use ? max_memory - memory_in_use : 0; }
};

/// Reads a model file. The format is detected from the contents or, if they are ambiguous, from the extension. Throws InputError
/// "FILE: PLACE: problem; expected ..." if the file cannot be read.
Model read_model(const std::filesystem::path& file, const ReadModelOptions& options = {});

}  // namespace halfspace::HS_LANES
