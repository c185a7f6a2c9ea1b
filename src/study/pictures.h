// SPDX-License-Identifier: Apache-2.0
//
// What studies of pictures share: a scene's light with its time, and a picture's error against the truth.
#pragma once

#include "halfspace/render/prepared_scene.h"
#include "halfspace/study/study.h"

namespace halfspace {

/// A scene's linear light, and the time of one frame without preparation.
struct TimedPicture {
  Image<glm::vec4> light;
  Timing time;
  PassStatistics statistics;
};
TimedPicture timed_picture(const SceneDescription& scene, int width, int height, const StudyOptions& options, const Workers& workers);

enum class PictureError : uint8_t {
  rms,  ///< root of the mean square
  mean  ///< mean of the absolute: of pixels that change sides at an edge it counts the area
};

/// Sets the variant's error by its light against the truth's, its measures (rms, mean, p999, max, ssim) and its pictures.
void judge_picture(Variant& variant, const Image<glm::vec4>& light, const Image<glm::vec4>& truth, PictureError kind);

/// The truth of what converges with a number of bands: its picture, and a third of the step from half as many bands as its error.
void set_truth(Truth& truth, const Image<glm::vec4>& light, const Image<glm::vec4>& half, PictureError kind);

/// Light as sRGB codes.
Image<glm::u8vec4> codes_of(const Image<glm::vec4>& light);

/// A sphere round the origin as one directional light shows it.
struct LitSphere {
  double radius = 1.0;
  glm::dvec3 center_ws{0.0};
  LightModel model = LightModel::blinn_phong;
  double ambient = 0.05, diffuse = 0.7, specular = 0.5, shininess = 40.0;
  glm::dvec3 towards_light_ws{1.0, 1.0, 1.5};
};

/// Its exact light at the pixels' centres, black around it, by a ray each.
struct SphereTruth {
  Image<glm::vec4> light;  ///< to be seen
  Image<double> exact;     ///< to be measured from
  double error;            ///< the largest difference of a pixel to long double
};
SphereTruth sphere_truth(const LitSphere& sphere, const View& view);

/// The root of the mean square of what red differs by from the truth.
double rms_error(const Image<glm::vec4>& light, const Image<double>& truth);

/// How far the planes of a sphere's triangles lie below the sphere at the most, in units.
double deepest_chord(const Mesh& mesh, double radius);

}  // namespace halfspace
