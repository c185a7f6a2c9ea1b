// SPDX-License-Identifier: Apache-2.0
//
// Renders a prepared scene: its color and, from a second pass, values such as depth, normals and ids.
#pragma once

#include <limits>
#include <optional>

#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/shading/values/frame_values.h"

namespace halfspace::HS_LANES {

/// A rectangle of an image, in pixels from the upper left corner.
struct ImageRect {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The images of a frame that render_frame() fills. Null images are not requested. The images are not owned. All must have the size for
/// which the scene was prepared, or that of the crop.
///
/// Colors are antialiased as the scene specifies. All other values are those of the surface at the center of a pixel, without filtering.
/// Only opaque surfaces have them, including the visible parts of masked surfaces. Blended surfaces, floors that only show shadows and
/// lines of normals are ignored. Positions and distances are in scene units.
struct FrameImages {
  Image<glm::u8vec4>* picture = nullptr;        ///< 8-bit display values, as the post section of the scene specifies; straight alpha
  Image<glm::u16vec4>* fine_picture = nullptr;  ///< the same with 16 bits per channel, not dithered
  Image<glm::vec4>* light = nullptr;            ///< linear light before exposure and tone curve, straight alpha

  // Images of the values of FrameValue. Where there is no surface, they are 0 unless stated otherwise.
  Image<float>* depth = nullptr;              ///< background_depth where there is no surface
  Image<float>* distance = nullptr;           ///< background_depth where there is no surface
  Image<glm::vec3>* normal = nullptr;         ///< world space
  Image<glm::vec3>* camera_normal = nullptr;  ///< x right, y up, z towards the eye
  Image<glm::vec3>* albedo = nullptr;         ///< linear
  Image<glm::vec3>* position = nullptr;       ///< world space
  Image<glm::vec2>* uv = nullptr;             ///< 0 if the mesh has none
  /// Index into the scene's objects. Particle systems have the indices after those of the objects. kNoId where there is no surface.
  Image<uint32_t>* object = nullptr;
  /// Index of the copy of an object. For a model with n meshes, copy · n + mesh. For spheres and particles, the index of the sphere. kNoId
  /// where there is no surface.
  Image<uint32_t>* instance = nullptr;
  /// Index of the triangle, point or line in its mesh; 0 for spheres. kNoId where there is no surface.
  Image<uint32_t>* triangle = nullptr;
  Image<glm::vec3>* barycentrics = nullptr;  ///< (1, 0, 0) for points and spheres

  float background_depth = std::numeric_limits<float>::infinity();
  /// Renders only this rectangle, which must be inside the frame. The images have its size and contain the same pixels as the full frame.
  std::optional<ImageRect> crop{};
};

inline constexpr uint32_t kNoId = 0xffffffffu;

/// Returns true if an image other than the color images is requested.
bool wants_values(const FrameImages& images);

/// Renders the requested images. Throws LimitError if auto_exposure needs more memory than permitted. The result does not depend on the
/// number of workers. Light is stored for the whole image only if it is requested, or if auto_exposure has to measure it first. Otherwise
/// it exists only in tiles. The returned statistics are the sums over all passes that draw the scene, except for that of unlit_layer().
PassStatistics render_frame(const PreparedScene& scene, const FrameImages& images, const Workers& workers);

/// Renders only the color of a frame. See render_frame() for the meaning of the images and for other values.
PassStatistics render(const PreparedScene& scene, Image<glm::u8vec4>& picture, const Workers& workers);
PassStatistics render(const PreparedScene& scene, Image<glm::vec4>& light, const Workers& workers);

/// Converts light that has already been rendered to the color images of a frame. The result is bit-identical to that of render_frame(). The
/// light must be opaque and have the size for which the scene was prepared. There must be no crop, and only color images can be requested.
void display_frame(const PreparedScene& scene, const Image<glm::vec4>& light, const FrameImages& images, const Workers& workers);

}  // namespace halfspace::HS_LANES
