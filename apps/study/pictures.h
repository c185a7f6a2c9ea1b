// SPDX-License-Identifier: Apache-2.0
//
// Helpers for studies that render images: timed rendering, and comparison with the reference image.
#pragma once

#include "halfspace/render/prepared_scene.h"
#include "study/study.h"

namespace halfspace {

/// A rendered scene in linear light, and the time of one frame without the preparation of the scene.
struct TimedPicture {
  Image<glm::vec4> light;
  Timing time;
  PassStatistics statistics;
};
TimedPicture timed_picture(const SceneDescription& scene, int width, int height, const StudyOptions& options, const Workers& workers);

enum class PictureError : uint8_t {
  rms,  ///< root mean square error
  mean  ///< mean absolute error; proportional to the area of the wrong pixels along an edge
};

/// Compares an image with the reference image `truth`. Sets the error, the metrics (rms, mean, p999, max, ssim) and the pictures of the
/// variant.
void set_picture_error(Variant& variant, const Image<glm::vec4>& light, const Image<glm::vec4>& truth, PictureError kind);

/// Sets the reference image and its estimated error, for a reference that converges as the number of bands increases. The error is a third
/// of the difference from `half`, an image with half the number of bands.
void set_truth(Truth& truth, const Image<glm::vec4>& light, const Image<glm::vec4>& half, PictureError kind);

/// Encodes linear light as 8-bit sRGB.
Image<glm::u8vec4> codes_of(const Image<glm::vec4>& light);

/// A sphere lit by one directional light.
struct LitSphere {
  double radius = 1.0;
  glm::dvec3 center_ws{0.0};
  LightModel model = LightModel::blinn_phong;
  double ambient = 0.05, diffuse = 0.7, specular = 0.5, shininess = 40.0;
  glm::dvec3 towards_light_ws{1.0, 1.0, 1.5};
};

/// The image of a sphere on black, from one ray through each pixel center.
struct SphereTruth {
  Image<glm::vec4> light;  ///< rounded to float, for display and image comparison
  Image<double> exact;     ///< unrounded, as reference for rms_error
  double error;            ///< largest difference of a pixel from the result in long double
};
SphereTruth sphere_truth(const LitSphere& sphere, const View& view);

/// Returns the RMS error of the red channel.
double rms_error(const Image<glm::vec4>& light, const Image<double>& truth);

/// Returns the largest distance between the sphere and the plane of a triangle of its mesh, in world units.
double deepest_chord(const Mesh& mesh, double radius);

}  // namespace halfspace
