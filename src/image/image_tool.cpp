// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_tool.h"

#include <signal.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/core/resource_limits.h"
#include "halfspace/core/text.h"
#include "halfspace/core/tool_folder.h"
#include "halfspace/image/image_errors.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_limits.h"
#include "halfspace/image/image_text.h"
#include "halfspace/image/tool_pool.h"

namespace halfspace::HS_LANES {

namespace {

[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& what) {
  fail_writing(path, "cannot write (" + what + ")");
}

// The result of a request. `answered` and `answered_last` mean a complete answer; after `answered_last`, the tool must not be reused.
enum class Exchange { answered, answered_last, tool_ended };

// Why there was no answer.
struct ToolFailure {
  std::string text;
  bool started = true;
  bool killed = false;  // by SIGKILL, which a decoder does not send to itself: most likely the system is out of memory
};

// Lends a tool of the pool to exchange(tool), which sends a request and receives the answer. If a tool that has served earlier requests
// ends, one of those requests may have damaged it, or something else may have killed it, so exchange is called again with a new tool. A
// request that reaches the time limit is not repeated.
template <class F>
std::optional<ToolFailure> exchange_with_tool(ToolPool& pool, const std::filesystem::path& program, F&& exchange) {
  for (;;) {
    ToolPool::Lease lease(pool);
    const bool used = lease.tool().running();
    const int error = used ? 0 : lease.tool().start(program);
    if (error != 0) return ToolFailure{std::strerror(error), false};
    const Exchange result = exchange(lease.tool());
    if (result == Exchange::answered) lease.keep();
    if (result != Exchange::tool_ended) return std::nullopt;
    const int signal = lease.tool().wait();
    if (!used || signal == SIGXCPU || signal == SIGALRM)
      return ToolFailure{.text = signal == 0 ? "ended early" : std::string("died: ") + ::strsignal(signal), .killed = signal == SIGKILL};
  }
}

ToolRequest request_of(ToolTask task, std::string_view format) {
  ToolRequest request;
  request.max_pixels = resource_limits().max_pixels;
  request.max_bytes = memory_left();
  request.task = task;
  HS_CHECK_OP(format.size(), <, sizeof request.format,
              "image tool: the name of the format is too long; expected one that fits the request");
  std::ranges::copy(format, request.format);
  return request;
}

std::optional<std::string> receive_message(ToolProcess& tool, uint32_t bytes) {
  std::string message(std::min<std::size_t>(bytes, 1000), '\0');
  if (!tool.receive(message.data(), message.size())) return std::nullopt;
  return printable(message);  // it may quote names from the file
}

template <class Picture, std::size_t kSample>
bool receive_pixels(ToolProcess& tool, const PictureHeader& h, const std::string& name, Picture& picture) {
  using Pixels = std::variant_alternative_t<kSample, Picture>;
  const auto edge = [](int32_t pixels) { return static_cast<uint64_t>(pixels); };
  const MemoryClaim claim(decoding_memory(edge(h.width), edge(h.height), h.channels * sample_bytes(h.sample)), name);
  Pixels image(h.width, h.height);
  if (!tool.receive(image.data(), image.texels().size_bytes())) return false;
  picture = std::move(image);
  return true;
}

template <class Picture>
Exchange receive_samples(ToolProcess& tool, const PictureHeader& h, const std::string& name, Picture& picture, std::string& message) {
  bool complete = false;
  switch (h.sample) {
    case Sample::uint8: complete = receive_pixels<Picture, 0>(tool, h, name, picture); break;
    case Sample::uint16: complete = receive_pixels<Picture, 1>(tool, h, name, picture); break;
    case Sample::float32: complete = receive_pixels<Picture, 2>(tool, h, name, picture); break;
    default: message = "cannot be read: the decoder and this program have different versions"; return Exchange::answered_last;
  }
  return complete ? Exchange::answered : Exchange::tool_ended;
}

// Receives the decoder's response: an image or an error message.
template <class Picture>
Exchange receive_picture(ToolProcess& tool, uint32_t channels, const std::string& name, Picture& picture, std::string& message) {
  PictureHeader h;
  if (!tool.receive(&h, sizeof h)) return Exchange::tool_ended;
  if (h.magic == kImageToolMagic && h.width == 0) {
    std::optional<std::string> text = receive_message(tool, h.message_bytes);
    if (!text) return Exchange::tool_ended;
    if (h.height != 0) throw LimitError(name + ": " + *text);
    message = *std::move(text);
    return Exchange::answered;
  }
  if (h.magic == kImageToolMagic) check_image_size(static_cast<uint64_t>(h.width), static_cast<uint64_t>(h.height), name);
  if (h.magic != kImageToolMagic || h.channels != channels) {
    message = "cannot be read: the decoder and this program have different versions";
    return Exchange::answered_last;
  }
  return receive_samples(tool, h, name, picture, message);
}

struct DecoderProgram {
  std::filesystem::path path;
  ToolPool& pool;
};

DecoderProgram decoder_for(const ImageSource& source) {
  const std::string_view format = source.tool_format()->name;
  if (std::filesystem::path jpeg = format == "jpeg" ? find_jpeg_tool() : ""; !jpeg.empty()) return {std::move(jpeg), jpeg_tool_pool()};
  std::filesystem::path program = find_image_tool();
  if (program.empty()) {
    fail_reading(source.name(), "is " + std::string(format) + ", and " + kImageToolName +
                                    " is not installed; expected PNG, or that program (it is built if OpenImageIO is available)");
  }
  return {std::move(program), image_tool_pool()};
}

template <class Picture>
Picture read_by_tool(ImageSource& source, ToolTask task) {
  const DecoderProgram program = decoder_for(source);
  const ToolRequest request = request_of(task, source.tool_format()->name);
  const int file = source.descriptor();
  Picture picture;
  std::string message;
  const auto failure = exchange_with_tool(program.pool, program.path, [&](ToolProcess& tool) {
    if (!tool.send_with_descriptor(&request, sizeof request, file)) return Exchange::tool_ended;
    return receive_picture(tool, task == ToolTask::read_gray ? 1 : 4, source.name(), picture, message);
  });
  if (failure && !failure->started) {
    fail_reading(source.name(), "cannot be read: " + program.path.string() + " does not start (" + failure->text + ")");
  }
  // Not the fault of the file, so no picture should be drawn without it.
  if (failure && failure->killed) throw LimitError(source.name() + ": the decoder was killed; expected enough free memory for it");
  if (failure)
    message = "cannot be read as " + std::string(source.tool_format()->name) + " (the decoder " + failure->text +
              "); expected a complete image file";
  if (!message.empty()) fail_reading(source.name(), message);
  return picture;
}

bool send_rows(ToolProcess& tool, const PictureHeader& header, const std::function<void(int y, std::span<std::byte> row)>& fill_row) {
  std::vector<std::byte> row(row_bytes(header));
  for (int y = 0; y < header.height; ++y) {
    fill_row(y, row);
    if (!tool.send(row.data(), row.size())) return false;
  }
  return true;
}

// Returns the text as protocol.h describes it.
std::string tool_text(const ImageText& text) {
  std::string strings;
  for (const std::string& string : {text_lines(text), text.software, text.comment, text.fingerprint}) strings += string + '\0';
  return strings;
}

// Receives the encoder's answer, a file or a message.
Exchange receive_file(ToolProcess& tool, uint64_t max_bytes, std::vector<std::byte>& file, std::string& message) {
  FileHeader h;
  if (!tool.receive(&h, sizeof h)) return Exchange::tool_ended;
  if (h.magic != kImageToolMagic || h.file_bytes > max_bytes) {
    message = std::string(kImageToolName) + " and this program have different versions";
    return Exchange::answered_last;
  }
  if (h.file_bytes == 0) {
    std::optional<std::string> text = receive_message(tool, h.message_bytes);
    if (!text) return Exchange::tool_ended;
    message = *std::move(text);
    return Exchange::answered_last;
  }
  file.resize(h.file_bytes);
  return tool.receive(file.data(), file.size()) ? Exchange::answered : Exchange::tool_ended;
}

}  // namespace

ColorPicture read_color_by_tool(ImageSource& source) { return read_by_tool<ColorPicture>(source, ToolTask::read_color); }

GrayPicture read_gray_by_tool(ImageSource& source) { return read_by_tool<GrayPicture>(source, ToolTask::read_gray); }

std::vector<std::byte> encode_by_tool(const std::filesystem::path& path, const char* format, PictureHeader header, const ImageText& text,
                                      const std::function<void(int y, std::span<std::byte> row)>& fill_row) {
  const std::filesystem::path program = find_image_tool();
  if (program.empty()) {
    cannot_write(path, std::string(kImageToolName) + " is not installed; expected a file name ending in .png, or that program");
  }
  const ToolRequest request = request_of(ToolTask::write, format);
  const std::string strings = tool_text(text);
  header.message_bytes = static_cast<uint32_t>(strings.size());
  const uint64_t max_bytes = 2 * row_bytes(header) * static_cast<uint64_t>(header.height) + strings.size() + (1 << 20);
  std::vector<std::byte> file;
  std::string message;
  const auto failure = exchange_with_tool(image_tool_pool(), program, [&](ToolProcess& tool) {
    // An encoder that fails exits before it has received all rows; its response gives the reason.
    const bool sent = tool.send(&request, sizeof request) && tool.send(&header, sizeof header) &&
                      tool.send(strings.data(), strings.size()) && send_rows(tool, header, fill_row);
    const Exchange result = receive_file(tool, max_bytes, file, message);
    return sent || !message.empty() ? result : Exchange::tool_ended;
  });
  if (failure && !failure->started) cannot_write(path, program.string() + " does not start: " + failure->text);
  if (failure) cannot_write(path, std::string("the ") + format + " encoder " + failure->text);
  if (!message.empty()) cannot_write(path, message);
  return file;
}

std::vector<std::byte> encode_codes_by_tool(const std::filesystem::path& path, const char* format, const Image<glm::u8vec4>& image,
                                            uint32_t channels, const ImageText& text) {
  HS_CHECK(!image.empty(), "write_image: the image is empty; expected at least one pixel");
  PictureHeader header;
  header.width = image.width();
  header.height = image.height();
  header.channels = channels;
  header.sample = Sample::uint8;
  return encode_by_tool(path, format, header, text, [&](int y, std::span<std::byte> row) {
    std::byte* to = row.data();
    for (const glm::u8vec4& texel : image.row(y)) {
      std::memcpy(to, &texel, channels);
      to += channels;
    }
  });
}

std::filesystem::path find_image_tool() { return find_tool(kImageToolName); }

std::filesystem::path find_jpeg_tool() { return find_tool(kJpegToolName); }

}  // namespace halfspace::HS_LANES
