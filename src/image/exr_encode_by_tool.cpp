// SPDX-License-Identifier: Apache-2.0
//
// OpenEXR encoding in builds without OpenEXR. halfspace-image-tool writes half-float RGB or RGBA, or a single float channel Z.
#include <algorithm>
#include <cstring>

#include "halfspace/core/check.h"
#include "halfspace/image/exr_encode.h"
#include "halfspace/image/image_errors.h"
#include "halfspace/image/image_tool.h"

namespace halfspace::HS_LANES {

namespace {

bool tool_can_write(std::span<const ExrChannel> channels) {
  if (channels.size() == 1) return channels[0].name == "Z" && channels[0].sample == ExrSample::float32;
  constexpr const char* kNames[] = {"R", "G", "B", "A"};
  if (channels.size() != 3 && channels.size() != 4) return false;
  return std::equal(channels.begin(), channels.end(), kNames,
                    [](const ExrChannel& c, const char* name) { return c.name == name && c.sample == ExrSample::float16; });
}

}  // namespace

std::vector<std::byte> encode_exr(const std::filesystem::path& path, int width, int height, std::span<const ExrChannel> channels,
                                  const ImageText& text) {
  HS_CHECK(width > 0 && height > 0 && !channels.empty(), "write_exr: there are no pixels or no channels; expected at least one of each");
  if (!tool_can_write(channels)) fail_writing(path, "cannot write (this build has no OpenEXR); expected channels R, G, B and A, or Z");
  PictureHeader header;
  header.width = width;
  header.height = height;
  header.channels = static_cast<uint32_t>(channels.size());
  header.sample = channels.size() == 1 ? Sample::float32 : Sample::float16;
  const std::size_t size = sample_bytes(header.sample);
  std::vector<std::byte> samples(size * static_cast<std::size_t>(width));
  return encode_by_tool(path, "openexr", header, text, [&](int y, std::span<std::byte> row) {
    for (std::size_t c = 0; c < channels.size(); ++c) {
      channels[c].fill_row(y, samples);
      for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
        std::memcpy(row.data() + (x * channels.size() + c) * size, samples.data() + x * size, size);
      }
    }
  });
}

}  // namespace halfspace::HS_LANES
