// SPDX-License-Identifier: Apache-2.0
//
// A picture of the conformance tests as plain data: the drawings, their shaders (one of a few), and the targets. The tile path, the oracle
// and Mesa draw the same data, so every case is written only once.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "halfspace/raster/vertex_input.h"
#include "halfspace/shading/texture/texture.h"
#include "halfspace/shading/texture/texture_memory.h"
#include "property/scene.h"

namespace halfspace::conformance {

/// The shaders in shaders.h.
enum class Kind : uint8_t {
  color,
  clip,
  cutout,
  depth,
  point,
  derivative,
  texture,
  instance,
  two_colors,
  four_colors,
  geometry,
  tessellation,
  cull,
  sample_inputs,
  sample_mask_in,
  sample_mask,
  viewport,
  attributes,
  outputs,
  layer,
  layer_geometry
};

/// Output of `color`: its varying with one of four interpolation qualifiers.
enum ColorMode { kSmooth, kFlat, kLinear, kCentroid };
/// Output of `derivative`, multiplied by its value: exact derivatives of the coordinates, or differences within the 2x2 quad.
enum DerivativeMode { kDdx, kDdy, kFwidth, kQuadDdx, kQuadDdy, kQuadFwidth };
/// What `geometry` emits: a strip of all vertices of a primitive; a small strip at each vertex, with `value` vertices and ends; or a strip
/// that depends on the numbers of the primitive, the instance and the invocation.
enum GeometryMode { kWhole, kAtVertices, kByNumber };
/// The layers into which `layer_geometry` emits a primitive: the first kGeometryLayers, or some of them, depending on its number.
enum LayerMode { kAllLayers, kSomeLayers };
/// The levels of `tessellation`: `value` everywhere; different ones at each edge; the same, but odd patches are discarded.
enum TessellationMode { kUniform, kPerEdge, kDiscardOdd };
/// Output of `sample_inputs`: the number of the sample, divided by 8, or its position in the pixel.
enum SampleMode { kSampleId, kSamplePosition };
/// How `texture` selects the mip level: from the derivatives of its coordinates, or from `value`.
enum TextureMode { kByDerivatives, kByLevel };

inline constexpr std::size_t kOutputs = 4;
/// The types of the colors of `outputs`, one for each attachment.
using OutputTypes = std::array<ColorType, kOutputs>;

struct Vertex {
  glm::vec4 pos_clip;
  glm::vec4 color{1.0f};
  glm::vec4 extra{0.0f};  ///< clip and cull distances, point size, texture coordinates, an offset, a viewport or a layer (by shader)
};

/// Attributes in memory that several draws can share.
struct AttributeArray {
  std::shared_ptr<const std::vector<std::byte>> memory;
  VertexStream stream;  ///< in `memory`
};

struct Drawing {
  Kind kind = Kind::color;
  int mode = 0;
  float value = 0.0f;
  std::vector<Vertex> vertices;
  std::vector<AttributeArray> arrays{};          ///< of `attributes`: one for each member of ArrayAttributes, in place of `vertices`
  std::vector<uint32_t> indices{};               ///< if empty, all vertices in order
  bool restart = false;                          ///< the index kRestart ends a primitive
  IndexLayout index_layout = IndexLayout::wide;  ///< how indices are stored
  std::vector<glm::vec4> rows{};                 ///< if not empty, `extra` is read from here, with one row per `divisor` instances
  uint32_t divisor = 1;
  std::shared_ptr<const Texture2D> texture{};
  Sampler sampler{};
  TessellationLayout tessellation{};                 ///< of `tessellation`: one of kTessellationLayouts
  GeometryLayout geometry{};                         ///< of `geometry` or `layer_geometry`: one of kGeometryLayouts or kLayerLayouts
  OutputTypes outputs{};                             ///< of `outputs`: one of kOutputTypes
  std::shared_ptr<const ViewportArray> viewports{};  ///< of `viewport`, which `state` refers to
  DrawState state{};
  std::optional<ClearValues> clear{};  ///< executed before the draw
};

struct Picture {
  int width = 32, height = 32;  ///< powers of two, so that positions on the 1/256 px grid are exact
  int samples = 1;
  bool supersample = false;
  int layers = 1;
  TextureKind kind = TextureKind::two_d;  ///< of a texture with these layers
  std::vector<ColorFormat> colors{ColorFormat::rgba8};
  DepthFormat depth = DepthFormat::d32fs8;
  glm::vec4 clear_color{0.0f};
  float clear_depth = 1.0f;
  uint8_t clear_stencil = 0;
  std::vector<Drawing> draws{};
};

/// A drawn picture, addressed by window coordinates (origin at the lower left).
struct Seen {
  int width = 0, height = 0;
  std::vector<ColorFormat> formats;
  DepthFormat depth_format = DepthFormat::none;
  Pictures bytes;
  std::vector<uint64_t> queries;

  /// Returns the stored value: codes divided by the largest one (for sRGB the encoded value, not the linear one), or floats.
  glm::vec4 color(int x, int y, std::size_t attachment = 0, int layer = 0) const;
  /// Returns the stored integers; unsigned ones keep their bits.
  glm::ivec4 integers(int x, int y, std::size_t attachment = 0) const;
  std::span<const std::byte> texel_bytes(int x, int y, std::size_t attachment = 0, int layer = 0) const;
  /// Returns the stored integer or, for float formats, the depth.
  double depth(int x, int y, int layer = 0) const;
  int stencil(int x, int y) const;
  bool is_constant() const;

 private:
  std::size_t index(int x, int y, int layer = 0) const;
  glm::vec4 texel(int x, int y, std::size_t attachment, int layer = 0) const;
};

/// A test case.
struct Case {
  std::string name;
  std::function<Picture()> picture;
  /// Checks the picture against a closed form. Returns a description of the error, or an empty string. If null, the oracle is the only
  /// reference.
  std::function<std::string(const Picture&, const Seen&)> truth{};
  bool may_be_constant = false;       ///< otherwise, a picture of a single color is an error
  const char* not_by_mesa = nullptr;  ///< reason why Mesa does not draw this case
};
using Cases = std::vector<Case>;

/// Returns the number of vertices in the arrays or in `vertices`.
std::size_t vertex_count(const Drawing& drawing);
/// Draws with the tile path.
Seen draw(const Picture& picture, const PassOptions& options = {}, int threads = 1);
/// Draws with the tile path into the layers of a texture. Depths are not stored.
void draw_into(const Picture& picture, TextureMemory& texture);
/// Draws with the oracle.
Seen draw_by_oracle(const Picture& picture);
/// Compares the tile path (deferred, and immediate in small tiles) with the oracle. Returns the difference; empty if there is none.
std::string difference_from_oracle(const Picture& picture);
/// Returns a description of the picture for messages.
std::string describe(const Picture& picture);
/// Performs all checks of a case: the oracle, its closed form, and that the picture is not constant.
std::string check(const Case& c);

}  // namespace halfspace::conformance
