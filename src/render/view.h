// SPDX-License-Identifier: Apache-2.0
//
// The view of a camera, as matrices and vectors.
#pragma once

#include "halfspace/core/vec.h"
#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

struct View {
  glm::dmat4 clip_from_world;
  glm::dvec3 eye_ws;
  glm::dvec3 to_eye_ws;                    ///< orthographic: unit vector from every point towards the eye; perspective: 0
  glm::dvec3 forward_ws, right_ws, up_ws;  ///< unit vectors
  double tan_x, tan_y;                     ///< tangents of half the field of view
  double near, far;                        ///< units along forward_ws
  int width_px, height_px;
  /// Perspective: ray_ws + x·ray_x_ws + y·ray_y_ws is the direction of the ray through the NDC (x, y), and has a length of 1 along
  /// forward_ws.
  glm::dvec3 ray_ws{}, ray_x_ws{}, ray_y_ws{};
  bool symmetric = true;  ///< the view axis passes through the center of the image, and the image axes are perpendicular
};

/// Returns the camera with these matrices. The projection may have an off-center principal point and skewed image axes, as calibrated
/// cameras do. Throws InputError, with a message that begins with "camera: ", if world_from_camera is not a rotation and a translation, or
/// if clip_from_camera is not a perspective or orthographic projection.
CameraDescription matrix_camera(const CameraMatrices& matrices);

/// Returns the distance of the near plane. If CameraDescription::near is 0, it is so near that it cuts off nothing that is in front of the
/// eye: far · 2^-40 for a perspective camera (a nanometer if far is a kilometer), and 0 for an orthographic one. If the far plane is
/// chosen as well, it is at 2^-30.
///
/// A perspective camera can afford this because depth is a float with reversed Z: near / distance. Its relative precision is the same at
/// every distance and for all planes. tests/render/near_plane_test.cpp measures this.
double near_plane(const CameraDescription& camera);

/// Returns the distance of the far plane. If CameraDescription::far is 0, it is at kFarthest for a perspective camera. The depth of an
/// orthographic camera is linear, so that a distant far plane makes it coarse; it is then 1000 units behind the near plane.
double far_plane(const CameraDescription& camera);

/// A far plane that cuts off nothing: coordinates of scenes are at most 10^9, and so distances at most 2√3 · 10^9.
inline constexpr double kFarthest = 0x1p33;

/// Returns the view of a camera for an image of width x height pixels, with reversed Z.
View make_view(const CameraDescription& camera, int width, int height);

/// Returns the size, in world units, that one pixel covers at the depth of a point. The position is relative to the eye, with the axes of
/// world space.
double pixel_width(const View& view, const glm::dvec3& position_rws);

/// Upper bounds on how far a projected point moves, in pixels, per world unit that the point moves inside a ball. The second
/// function applies to the silhouette of the ball itself, where only movement towards the ball's center counts.
double pixels_per_unit(const View& view, const glm::dvec3& center_ws, double radius);
double silhouette_pixels_per_unit(const View& view, const glm::dvec3& center_ws, double radius);

/// Returns an upper bound on how far a transform moves a point whose preimage moves by 1. For a rotation with a uniform scale, this is the
/// scale.
double stretch_of(const glm::dmat4& transform);

/// Returns the bound of pixels_per_unit for those points of the ball that would be in the image if the camera turned towards them. It
/// depends on their distance from the eye only. For points that are in the image, the smaller of both bounds holds.
double turned_pixels_per_unit(const View& view, const glm::dvec3& center_ws, double radius);

/// Returns true if the ball is entirely outside one of the four side planes of the view.
bool is_outside(const View& view, const glm::dvec3& center_ws, double radius);

/// Returns the transform of a placement: scale, then rotation, then translation.
glm::dmat4 world_from_object(const Placement& placement);

}  // namespace halfspace::HS_LANES
