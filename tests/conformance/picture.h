// SPDX-License-Identifier: Apache-2.0
//
// A picture of the conformance tests as plain data: what is drawn, with which of a few shaders, into what. The tile path, the oracle and
// Mesa draw the same data, so a set of parameters is written once.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "halfspace/shading/texture.h"
#include "property/scene.h"

namespace halfspace::conformance {

/// The shaders of shaders.h.
enum class Kind : uint8_t { color, clip, cutout, depth, point, derivative, texture, instance, two_colors, four_colors };

/// What `color` shows: its varying, interpolated in one of four ways.
enum ColorMode { kSmooth, kFlat, kLinear, kCentroid };
/// What `derivative` shows of u, times its value: exact derivatives, or differences over the 2x2 quad.
enum DerivativeMode { kDdx, kDdy, kFwidth, kQuadDdx, kQuadDdy, kQuadFwidth };
/// How `texture` chooses its level: by the derivatives of its coordinates, or by `value`.
enum TextureMode { kByDerivatives, kByLevel };

struct Vertex {
  glm::vec4 pos_clip;
  glm::vec4 color{1.0f};
  glm::vec4 extra{0.0f};  ///< clip distances, point size, texture coordinates or an offset, as the shader reads it
};

struct Drawing {
  Kind kind = Kind::color;
  int mode = 0;
  float value = 0.0f;
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices{};  ///< none: all vertices in order
  bool restart = false;             ///< kRestart among the indices ends a primitive
  bool narrow = false;              ///< indices of 16 bits
  std::vector<glm::vec4> rows{};    ///< not empty: `extra` comes from here, one row for `divisor` instances
  uint32_t divisor = 1;
  std::shared_ptr<const Texture2D> texture{};
  Sampler sampler{};
  DrawState state{};
};

struct Picture {
  int width = 32, height = 32;  ///< powers of two: positions on the 1/256 px grid are exact
  int samples = 1;
  bool supersample = false;
  std::vector<ColorFormat> colors{ColorFormat::rgba8};
  DepthFormat depth = DepthFormat::d32fs8;
  glm::vec4 clear_color{0.0f};
  float clear_depth = 1.0f;
  uint8_t clear_stencil = 0;
  std::vector<Drawing> draws{};
};

/// A drawn picture, by window coordinates (origin lower left).
struct Seen {
  int width = 0, height = 0;
  std::vector<ColorFormat> formats;
  DepthFormat depth_format = DepthFormat::none;
  Pictures bytes;
  std::vector<uint64_t> queries;

  /// The stored numbers: codes/255 of 8-bit formats (of sRGB the code, not the light), else the floats.
  glm::vec4 color(int x, int y, std::size_t attachment = 0) const;
  /// A code, or of float formats the depth.
  double depth(int x, int y) const;
  int stencil(int x, int y) const;
  bool is_constant() const;

 private:
  std::size_t index(int x, int y) const;
};

/// A set of parameters.
struct Case {
  std::string name;
  std::function<Picture()> picture;
  /// What the picture must hold by a closed form; empty, or what is wrong. May be null: then the oracle is the truth.
  std::function<std::string(const Picture&, const Seen&)> truth{};
  bool may_be_constant = false;       ///< else a picture of one colour is a failure
  const char* not_by_mesa = nullptr;  ///< why Mesa is not asked
};
using Cases = std::vector<Case>;

/// By the tile path.
Seen draw(const Picture& picture, const PassOptions& options = {}, int threads = 1);
/// By the oracle.
Seen draw_by_oracle(const Picture& picture);
/// Empty, or how the tile path (deferred, and at once in small tiles) differs from the oracle.
std::string difference_from_oracle(const Picture& picture);
/// Everything that is not the default, for messages.
std::string describe(const Picture& picture);
/// Everything that is asked of a case: the oracle, its closed form, and that something is seen.
std::string check(const Case& c);

}  // namespace halfspace::conformance
