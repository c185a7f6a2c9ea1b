// SPDX-License-Identifier: Apache-2.0
//
// halfspace-draco-tool decodes Draco-compressed meshes of glTF files for halfspace (see protocol.h). It is a separate program because input
// files are untrusted and a Draco stream cannot be validated before it is decoded.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string_view>

#include "halfspace/core/tool/limits.h"
#include "halfspace/model/draco_tool/decode.h"

namespace halfspace::HS_LANES {

namespace {

constexpr unsigned kSeconds = 60;                      // CPU time limit for all meshes of a file
constexpr uint64_t kProgramBytes = uint64_t{1} << 28;  // address space before a mesh is decoded
constexpr uint64_t kMaxBytes = uint64_t{6} << 30;      // maximum address space
constexpr uint64_t kBytesPerByte = 8;                  // address space per byte of the result, including the decoder's own tables

// Returns false if the input ends early.
bool receive(void* memory, std::size_t bytes) {
  for (char* to = static_cast<char*>(memory); bytes > 0;) {
    const ssize_t n = ::read(STDIN_FILENO, to, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    to += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

template <class T>
void put(const T* items, std::size_t count) {
  std::fwrite(items, sizeof(T), count, stdout);
}

void reject(const DracoFailure& failure) {
  DracoHeader header;
  header.message_bytes = static_cast<uint32_t>(failure.text.size());
  header.exceeds_limit = failure.exceeds_limit ? 1 : 0;
  put(&header, 1);
  put(failure.text.data(), failure.text.size());
}

void answer(std::span<const char> stream, std::span<const uint32_t> ids, uint64_t max_bytes) {
  const DecodedDraco decoded = decode_draco(stream, ids, max_bytes);
  put(&decoded.header, 1);
  put(decoded.attributes.data(), decoded.attributes.size());
  put(decoded.data.data(), decoded.data.size());
}

// Handles a request. Returns false if this process should end.
bool serve_one() {
  DracoRequest request;
  if (!receive(&request, sizeof request) || request.magic != kDracoToolMagic || request.attributes > kMaxDracoAttributes) return false;
  limit_memory(std::min(kMaxBytes, kProgramBytes + request.stream_bytes + kBytesPerByte * std::min(request.max_bytes, kMaxBytes)));
  std::vector<uint32_t> ids(request.attributes);
  std::vector<char> stream;
  bool ready = true;
  try {
    stream.resize(request.stream_bytes);
    if (!receive(ids.data(), ids.size() * sizeof(uint32_t)) || !receive(stream.data(), stream.size())) return false;
    answer(stream, ids, request.max_bytes);
  } catch (const DracoFailure& failure) {
    reject(failure);
  } catch (const std::bad_alloc&) {
    reject({"needs too much memory; expected a smaller mesh (--max-memory)", true});
    ready = false;
  } catch (const std::length_error&) {
    reject({"needs too much memory; expected a smaller mesh (--max-memory)", true});
    ready = false;
  }
  return std::fflush(stdout) == 0 && ready;
}

}  // namespace

}  // namespace halfspace::HS_LANES

int main(int argc, char** argv) {
  if (argc != 2 || argv[1] != std::string_view("serve")) {
    std::fputs("halfspace-draco-tool is started by halfspace; usage: halfspace-draco-tool serve\n", stderr);
    return 2;
  }
  halfspace::exit_with_reader();
  halfspace::limit_time(halfspace::kSeconds);
  while (halfspace::serve_one()) {
  }
  std::_Exit(0);
}
