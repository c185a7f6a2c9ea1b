// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool/service.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "halfspace/core/tool/limits.h"
#include "halfspace/image/image_limits.h"
#include "halfspace/image/tool/failure.h"
#include "halfspace/image/tool/protocol.h"

namespace halfspace::HS_LANES {

namespace {

// Limits on CPU time.
constexpr unsigned kReadSeconds = 60;
constexpr unsigned kWriteSeconds = 1200;               // images to write are our own, and 16384x16384 pixels take minutes
constexpr uint64_t kAddressSpace = uint64_t{6} << 30;  // 2^28 pixels of 16 bytes, plus the libraries
// Limit on the number of pixels that a header may claim per byte of the file (a constant JPEG has about 100, a bilevel TIFF 8000).
constexpr uint64_t kMaxPixelsPerByte = 8192;

// Receives a request and, for reading, the descriptor that comes with it. Returns false at the end of the input.
bool receive_request(ToolRequest& request, int& file) {
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))];
  iovec part = {&request, sizeof request};
  msghdr message = {};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  ssize_t n = 0;
  while ((n = ::recvmsg(STDIN_FILENO, &message, MSG_CMSG_CLOEXEC | MSG_WAITALL)) < 0 && errno == EINTR) {
  }
  file = -1;
  if (n != static_cast<ssize_t>(sizeof request) || request.magic != kImageToolMagic) return false;
  const cmsghdr* rights = CMSG_FIRSTHDR(&message);
  if (rights != nullptr && rights->cmsg_type == SCM_RIGHTS) std::memcpy(&file, CMSG_DATA(rights), sizeof file);
  return true;
}

bool handle_read(const ToolHandlers& handlers, const ToolRequest& request, const std::string& format, int file) {
  struct stat status = {};
  if (file < 0 || ::fstat(file, &status) != 0) return false;
  limit_time(kReadSeconds);
  const bool ready = handlers.read(
      {file, static_cast<uint64_t>(status.st_size), format, request.task == ToolTask::read_gray, request.max_pixels, request.max_bytes});
  ::close(file);
  return ready;
}

bool handle(const ToolHandlers& handlers, const ToolRequest& request, int file) {
  const std::string format(request.format, ::strnlen(request.format, sizeof request.format));
  if (request.task != ToolTask::write) return handle_read(handlers, request, format, file);
  if (handlers.write == nullptr) return false;
  limit_time(kWriteSeconds);
  return handlers.write(format);
}

}  // namespace

int serve_requests(const ToolHandlers& handlers) {
  limit_memory(kAddressSpace);
  exit_with_reader();
  ToolRequest request;
  int file = -1;
  while (receive_request(request, file)) {
    const bool ready = handle(handlers, request, file);
    if (std::fflush(stdout) != 0 || !ready) break;
    ::alarm(0);
  }
  return 0;
}

void receive(void* memory, std::size_t bytes) {
  for (char* to = static_cast<char*>(memory); bytes > 0;) {
    const ssize_t n = ::read(STDIN_FILENO, to, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw Failure{"the image data ended early"};
    to += n;
    bytes -= static_cast<std::size_t>(n);
  }
}

void check_claimed_size(const ReadRequest& request, int64_t width, int64_t height, uint64_t bytes_per_pixel) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + " pixels";
  if (width < 1 || height < 1) throw Failure{"has " + size + "; expected a flat image of at least 1x1"};
  const uint64_t pixels = static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
  if (pixels > kMaxImagePixels) throw Failure{"claims " + size + "; expected at most 2^28 pixels and 32768 pixels per side", true};
  if (pixels > request.max_pixels)
    throw Failure{size + "; expected at most " + std::to_string(request.max_pixels) + " pixels (--max-pixels)", true};
  if (pixels > (1u << 20) && pixels / kMaxPixelsPerByte > request.file_bytes) {
    throw Failure{"claims " + size + " but has only " + std::to_string(request.file_bytes) + " bytes; expected a complete image file"};
  }
  if (pixels * bytes_per_pixel > request.max_bytes) {
    throw Failure{"claims " + size + " of " + std::to_string(bytes_per_pixel) + " bytes; expected at most " +
                      std::to_string(request.max_bytes >> 20) + " MiB (--max-memory)",
                  true};
  }
}

}  // namespace halfspace::HS_LANES
