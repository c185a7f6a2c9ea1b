// SPDX-License-Identifier: Apache-2.0
#include "workloads/picture_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include "halfspace/core/check.h"
#include "halfspace/image/atomic_output.h"

namespace halfspace {

namespace {

struct PixelError {
  double worst = 0, squares = 0;
};

PixelError color_error(const glm::u8vec4& code, const vec4<double>& truth) {
  PixelError error;
  for (int k = 0; k < 4; ++k) {
    const double off = std::abs(code[k] - 255.0 * std::clamp(truth[k], 0.0, 1.0));
    error.worst = std::max(error.worst, off);
    error.squares += off * off;
  }
  return error;
}

constexpr std::streamsize kPixelBytes = 5 * sizeof(float);

std::optional<WorkloadTruth> read_truth(const std::filesystem::path& path, WorkloadSize size) {
  std::ifstream in(path, std::ios::binary);
  WorkloadTruth truth(size.width, size.height, vec4<double>(0.0), 1.0);
  std::array<float, 5> pixel;
  for (std::size_t i = 0; i < truth.color.texels().size(); ++i) {
    if (!in.read(reinterpret_cast<char*>(pixel.data()), kPixelBytes)) return std::nullopt;
    truth.color.data()[i] = {pixel[0], pixel[1], pixel[2], pixel[3]};
    truth.depth.data()[i] = pixel[4];
  }
  return truth;
}

void write_truth(const std::filesystem::path& path, const WorkloadTruth& truth) {
  std::ofstream out(path, std::ios::binary);
  for (std::size_t i = 0; i < truth.color.texels().size(); ++i) {
    const glm::vec4 c(glm::dvec4(truth.color.data()[i]));
    const std::array<float, 5> pixel{c.x, c.y, c.z, c.w, static_cast<float>(truth.depth.data()[i])};
    out.write(reinterpret_cast<const char*>(pixel.data()), kPixelBytes);
  }
  if (!out.flush()) throw OutputError(path.string() + ": cannot write the file");
}

// Returns true if a channel varies by more than 16/255 in the 3 x 3 neighborhood of a pixel, which must not be on the border.
bool is_at_edge(const Image<glm::u8vec4>& image, int x, int y) {
  glm::ivec4 low(image.at(x, y)), high = low;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      low = glm::min(low, glm::ivec4(image.at(x + dx, y + dy)));
      high = glm::max(high, glm::ivec4(image.at(x + dx, y + dy)));
    }
  }
  const glm::ivec4 range = high - low;
  return std::max({range.x, range.y, range.z, range.w}) > 16;
}

}  // namespace

PictureErrors picture_errors(const WorkloadPicture& picture, const WorkloadTruth& truth, double depth_tolerance) {
  const std::size_t pixels = truth.color.texels().size();
  const auto drawn = [&](std::size_t i) {
    return truth.depth.data()[i] < 1.0 || (picture.depth != nullptr && picture.depth->data()[i] < 1.0f);
  };
  bool any_drawn = false;
  for (std::size_t i = 0; i < pixels; ++i) any_drawn = any_drawn || drawn(i);
  PictureErrors errors;
  double squares = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    const PixelError color = color_error(picture.color->data()[i], truth.color.data()[i]);
    if (any_drawn && !drawn(i)) {
      errors.background_off += color.worst >= 0.51 ? 1 : 0;
      continue;
    }
    const double depth = picture.depth == nullptr ? 0 : std::abs(static_cast<double>(picture.depth->data()[i]) - truth.depth.data()[i]);
    ++errors.covered;
    errors.colors_off += color.worst > 1.0 ? 1 : 0;
    errors.depths_off += depth > depth_tolerance ? 1 : 0;
    errors.worst_color = std::max(errors.worst_color, color.worst);
    errors.worst_depth = std::max(errors.worst_depth, depth);
    squares += color.squares;
  }
  errors.rms_color = std::sqrt(squares / (4.0 * std::max(errors.covered, 1)));
  return errors;
}

PictureDifference picture_difference(const Image<glm::u8vec4>& a, const Image<glm::u8vec4>& b) {
  PictureDifference difference;
  for (int y = 1; y + 1 < a.height(); ++y) {
    for (int x = 1; x + 1 < a.width(); ++x) {
      if (is_at_edge(a, x, y) || is_at_edge(b, x, y)) continue;
      ++difference.compared;
      const glm::ivec4 off = glm::abs(glm::ivec4(a.at(x, y)) - glm::ivec4(b.at(x, y)));
      difference.off += std::max({off.x, off.y, off.z, off.w}) > 2 ? 1 : 0;
    }
  }
  return difference;
}

WorkloadTruth kept_truth(const std::filesystem::path& directory, std::string_view name, const Workload& workload, WorkloadSize size) {
  make_directory(directory);
  const std::string file = fmt::format("{}.{}x{}.truth", name, size.width, size.height);
  if (std::optional<WorkloadTruth> kept = read_truth(directory / file, size)) return *std::move(kept);
  WorkloadTruth truth = workload.truth();
  write_truth(directory / file, truth);
  return truth;
}

}  // namespace halfspace
