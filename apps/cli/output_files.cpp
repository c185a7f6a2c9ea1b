// SPDX-License-Identifier: Apache-2.0
#include "cli/output_files.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "halfspace/image/atomic_output.h"
#include "halfspace/image/png.h"

namespace halfspace {

namespace {

// The color image of a picture, in the number format of the file.
struct ColorImage {
  Image<glm::u8vec4> codes;
  Image<glm::u16vec4> fine_codes;
  Image<glm::vec4> light;
};

void bind(ColorImage& color, const PictureFiles& files, FrameImages& images) {
  const auto make = [&](auto& image, auto*& bound) {
    image = {files.size.width, files.size.height};
    bound = &image;
  };
  if (files.format.is_linear()) return make(color.light, images.light);
  files.choice.fine ? make(color.fine_codes, images.fine_picture) : make(color.codes, images.picture);
}

void write(const ColorImage& color, const ValueImages& values, const PictureFiles& files) {
  if (files.sink != nullptr) return files.format.is_linear() ? files.sink->add(color.light) : files.sink->add(color.codes);
  if (files.format.to_standard_output)
    return write_standard_output(files.choice.fine ? encode_png(color.fine_codes, files.text)
                                                   : encode_png(color.codes, PngCodes::srgb, files.text));
  if (share_file(files.choice, files.picture)) {
    std::vector<ExrChannel> channels = color_channels(color.light);
    std::ranges::move(values.channels(), std::back_inserter(channels));
    return write_exr(files.picture, files.size.width, files.size.height, channels, files.text);
  }
  if (files.format.is_linear()) return write_image(files.picture, color.light, files.text);
  if (files.choice.fine) return write_png(files.picture, color.fine_codes, files.text);
  if (files.picture.has_extension()) return write_image(files.picture, color.codes, files.text);
  write_png(files.picture, color.codes, files.text);  // for example /dev/stdout
}

}  // namespace

void render_files(const PreparedScene& scene, const PictureFiles& files, const Workers& workers, RenderReport& report) {
  const auto start = std::chrono::steady_clock::now();
  const auto milliseconds = [&] { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(); };
  ColorImage color;
  ValueImages values(files.choice, files.size.width, files.size.height);
  FrameImages images{.crop = files.choice.crop};
  bind(color, files, images);
  values.bind(images);
  const PassStatistics counts =
      files.naive != nullptr ? draw_naive_picture(scene, images, workers, *files.naive) : render_frame(scene, images, workers);
  report.counts += counts;
  ++report.pictures;
  report.empty_pictures += counts.samples_passed == 0 ? 1 : 0;
  const double render_ms = milliseconds();
  values.write(files.picture, files.text);
  write(color, values, files);
  report.draw_ms += render_ms;
  report.render_ms += render_ms;
  report.write_ms += milliseconds() - render_ms;
}

std::vector<std::filesystem::path> all_files(const PictureFiles& files) {
  std::vector<std::filesystem::path> paths = value_files(files.choice, files.picture);
  paths.push_back(files.picture);
  return paths;
}

}  // namespace halfspace
