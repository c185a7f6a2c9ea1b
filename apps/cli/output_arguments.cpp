// SPDX-License-Identifier: Apache-2.0
#include "cli/output_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>

#include "command_line/errors.h"
#include "halfspace/core/text.h"

namespace halfspace {

namespace {

// A value of --aov: its name and the channels of its EXR layer.
struct ValueName {
  std::string_view name;
  std::string_view channels;  // one letter per channel; empty: a single channel "id"
};
// In the order of FrameValue.
constexpr std::array<ValueName, kFrameValues> kNames{{{"depth", "Z"},
                                                      {"distance", "Z"},
                                                      {"normal", "XYZ"},
                                                      {"camera_normal", "XYZ"},
                                                      {"albedo", "RGB"},
                                                      {"position", "XYZ"},
                                                      {"uv", "UV"},
                                                      {"object", ""},
                                                      {"instance", ""},
                                                      {"triangle", ""},
                                                      {"barycentrics", "XYZ"}}};

const ValueName& name_of(FrameValue value) { return kNames[static_cast<std::size_t>(value)]; }

std::vector<FrameValue> parse_values(std::string_view list) {
  std::vector<std::string_view> names;
  for (const ValueName& v : kNames) names.push_back(v.name);
  std::vector<FrameValue> values;
  while (!list.empty()) {
    const std::string_view word = list.substr(0, list.find(','));
    list.remove_prefix(std::min(list.size(), word.size() + 1));
    const auto found = std::ranges::find(names, word);
    if (found == names.end()) throw UsageError(fmt::format("--aov has '{}'{}", word, suggestion(std::string(word), names)));
    const auto value = static_cast<FrameValue>(found - names.begin());
    if (std::ranges::find(values, value) == values.end()) values.push_back(value);
  }
  return values;
}

ImageRect parse_crop(std::string_view text, const PictureSize& size) {
  std::array<int, 4> numbers{};
  std::string_view rest = text;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t comma = rest.find(',');
    numbers[k] = (comma == std::string_view::npos) == (k == 3) ? parse_number(rest.substr(0, comma)) : -1;
    if (k < 3) rest.remove_prefix(std::min(rest.size(), comma == std::string_view::npos ? comma : comma + 1));
  }
  const ImageRect r{numbers[0], numbers[1], numbers[2], numbers[3]};
  const bool inside = r.x >= 0 && r.y >= 0 && r.width >= 1 && r.height >= 1 && r.x < size.width && r.y < size.height &&
                      r.width <= size.width - r.x && r.height <= size.height - r.y;
  if (!inside) {
    throw UsageError(fmt::format("--crop is '{}'; expected X,Y,W,H inside the {}x{} image, for example 0,0,{},{}", text, size.width,
                                 size.height, (size.width + 1) / 2, (size.height + 1) / 2));
  }
  return r;
}

std::filesystem::path beside(const std::filesystem::path& picture, std::string_view what) {
  return picture.parent_path() / fmt::format("{}-{}.exr", picture.stem().string(), what);
}

// Returns the name of channel k of a value, for example "normal.X".
std::string channel_name(FrameValue value, std::size_t k) {
  const ValueName& v = name_of(value);
  return fmt::format("{}.{}", v.name, v.channels.empty() ? "id" : v.channels.substr(k, 1));
}

// Adds the channels of a value, whose image has `count` 32-bit numbers per pixel.
template <class T>
void add_channels(std::vector<ExrChannel>& channels, FrameValue value, const Image<T>& image) {
  constexpr std::size_t count = sizeof(T) / 4;
  for (std::size_t k = 0; k < count; ++k) {
    const auto fill = [&image, k](int y, std::span<std::byte> row) {
      const auto* from = reinterpret_cast<const std::byte*>(image.row(y).data());
      for (std::size_t x = 0; x < static_cast<std::size_t>(image.width()); ++x)
        std::memcpy(row.data() + 4 * x, from + 4 * (x * count + k), 4);
    };
    channels.push_back({channel_name(value, k), std::is_same_v<T, uint32_t> ? ExrSample::uint32 : ExrSample::float32, fill});
  }
}

}  // namespace

OutputChoice parse_output(const OutputArguments& args, const PictureSize& size, const std::filesystem::path& out,
                          const OutputFormat& format) {
  OutputChoice choice;
  choice.values = parse_values(args.aov);
  choice.separate = args.separate;
  if (args.separate && args.aov.empty()) throw UsageError("--aov-separate requires --aov; expected --aov LIST as well");
  if (!choice.values.empty() && (!format.is_picture() || is_stream(out)))
    throw UsageError(fmt::format("-o is '{}'; expected the name of a picture, because --aov writes files next to it", out.string()));
  if (!args.bits.empty() && args.bits != "8" && args.bits != "16")
    throw UsageError(fmt::format("--bits is '{}'; expected 8 or 16", args.bits));
  choice.fine = args.bits == "16";
  if (choice.fine && !(format.is_picture() && format.picture == ImageFile::png))
    throw UsageError(fmt::format("--bits is '16', but -o is '{}'; expected a file name ending in .png", out.string()));
  if (!args.crop.empty()) choice.crop = parse_crop(args.crop, size);
  return choice;
}

int bytes_per_pixel(const OutputChoice& choice, const OutputFormat& format) {
  std::size_t bytes = format.is_linear() ? sizeof(glm::vec4) : choice.fine ? sizeof(glm::vec4) + sizeof(glm::u16vec4) : sizeof(glm::u8vec4);
  for (const FrameValue value : choice.values) bytes += 4 * std::max<std::size_t>(name_of(value).channels.size(), 1);
  return static_cast<int>(choice.crop ? 2 * bytes : bytes);
}

ValueImages::ValueImages(const OutputChoice& choice, int width, int height) : choice_(choice), width_(width), height_(height) {
  for (const FrameValue value : choice.values) {
    switch (name_of(value).channels.size()) {
      case 0: images_.emplace_back(Image<uint32_t>(width, height)); break;
      case 1: images_.emplace_back(Image<float>(width, height)); break;
      case 2: images_.emplace_back(Image<glm::vec2>(width, height)); break;
      default: images_.emplace_back(Image<glm::vec3>(width, height)); break;
    }
  }
}

void ValueImages::bind(FrameImages& images) {
  for (std::size_t i = 0; i < images_.size(); ++i) {
    switch (choice_.values[i]) {
      case FrameValue::depth: images.depth = &std::get<Image<float>>(images_[i]); break;
      case FrameValue::distance: images.distance = &std::get<Image<float>>(images_[i]); break;
      case FrameValue::normal: images.normal = &std::get<Image<glm::vec3>>(images_[i]); break;
      case FrameValue::camera_normal: images.camera_normal = &std::get<Image<glm::vec3>>(images_[i]); break;
      case FrameValue::albedo: images.albedo = &std::get<Image<glm::vec3>>(images_[i]); break;
      case FrameValue::position: images.position = &std::get<Image<glm::vec3>>(images_[i]); break;
      case FrameValue::uv: images.uv = &std::get<Image<glm::vec2>>(images_[i]); break;
      case FrameValue::object: images.object = &std::get<Image<uint32_t>>(images_[i]); break;
      case FrameValue::instance: images.instance = &std::get<Image<uint32_t>>(images_[i]); break;
      case FrameValue::triangle: images.triangle = &std::get<Image<uint32_t>>(images_[i]); break;
      case FrameValue::barycentrics: images.barycentrics = &std::get<Image<glm::vec3>>(images_[i]); break;
    }
  }
}

std::vector<ExrChannel> ValueImages::channels() const {
  std::vector<ExrChannel> channels;
  for (std::size_t i = 0; i < images_.size(); ++i)
    std::visit([&](const auto& image) { add_channels(channels, choice_.values[i], image); }, images_[i]);
  return channels;
}

void ValueImages::write(const std::filesystem::path& path, const ImageText& text) const {
  const std::vector<std::filesystem::path> files = value_files(choice_, path);
  if (files.empty()) return;
  if (!choice_.separate) return write_exr(files[0], width_, height_, channels(), text);
  for (std::size_t i = 0; i < images_.size(); ++i) {
    std::vector<ExrChannel> one;
    std::visit([&](const auto& image) { add_channels(one, choice_.values[i], image); }, images_[i]);
    write_exr(files[i], width_, height_, one, text);
  }
}

bool share_file(const OutputChoice& choice, const std::filesystem::path& picture) {
  return !choice.values.empty() && !choice.separate && image_file_of(picture) == ImageFile::exr;
}

std::string value_names(const OutputChoice& choice) {
  std::string names;
  for (const FrameValue value : choice.values) names += fmt::format("{}{}", names.empty() ? "" : ",", name_of(value).name);
  return names;
}

std::vector<std::filesystem::path> value_files(const OutputChoice& choice, const std::filesystem::path& picture) {
  if (choice.values.empty() || share_file(choice, picture)) return {};
  if (!choice.separate) return {beside(picture, "aov")};
  std::vector<std::filesystem::path> files;
  for (const FrameValue value : choice.values) files.push_back(beside(picture, name_of(value).name));
  return files;
}

}  // namespace halfspace
