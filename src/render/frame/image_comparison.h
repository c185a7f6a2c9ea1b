// SPDX-License-Identifier: Apache-2.0
//
// Compares image files or images in memory, as `halfspace compare` does.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>

#include "halfspace/image/image_difference.h"

namespace halfspace::HS_LANES {

/// An image of 8-bit sRGB values or of linear light, and its name in messages.
struct ComparedImage {
  std::string name;
  std::variant<Image<glm::u8vec4>, Image<glm::vec4>> image;
};

/// Reads a file as linear light if its format implies linear values (holds_linear_numbers), otherwise as 8-bit values. Throws InputError.
ComparedImage read_compared_image(const std::string& file);

struct Comparison {
  std::string a, b;  ///< the names of the images
  ImageDifference difference;
  int width, height;
  bool linear;  ///< both images are linear light; otherwise, 8-bit values were compared
};

/// Compares two images: linear light if both are, otherwise 8-bit values, for which linear light is encoded as sRGB. difference: receives
/// the difference as a picture (difference_colors), unless it is null. Throws InputError if the sizes differ.
Comparison compare(const ComparedImage& a, const ComparedImage& b, Image<glm::u8vec4>* difference = nullptr);

/// Returns the results as text of several lines, and as a JSON object.
std::string comparison_text(const Comparison& comparison);
nlohmann::ordered_json comparison_json(const Comparison& comparison);

/// Returns a message if the largest difference exceeds the tolerance, otherwise an empty string. expected: the tolerance as text.
std::string excess(const Comparison& comparison, double tolerance, const std::string& expected);

}  // namespace halfspace::HS_LANES
