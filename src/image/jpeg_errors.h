// SPDX-License-Identifier: Apache-2.0
//
// Errors of libjpeg, which reports them through a function that must not return.
#pragma once

#include <cstddef>
// jpeglib.h uses size_t and FILE without including their headers.
#include <cstdio>
//
#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>
#include <utility>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Receives the errors of one jpeg_decompress_struct or jpeg_compress_struct. Must not move.
class JpegErrors {
 public:
  /// The premature end of a file, for which libjpeg only issues a warning, counts as an error. Other warnings are ignored.
  JpegErrors() {
    jpeg_std_error(&manager_);
    manager_.error_exit = [](j_common_ptr codec) { of(codec).fail(codec); };
    manager_.output_message = [](j_common_ptr) {};
    manager_.emit_message = [](j_common_ptr codec, int level) {
      if (level < 0 && codec->err->msg_code == JWRN_JPEG_EOF) of(codec).fail(codec);
    };
  }
  JpegErrors(const JpegErrors&) = delete;
  JpegErrors& operator=(const JpegErrors&) = delete;

  jpeg_error_mgr* manager() { return &manager_; }

  /// Runs work, which may call libjpeg. Returns false if libjpeg reported an error; work has then been left with longjmp, so it must not
  /// create objects with destructors.
  template <class F>
  bool run(F&& work) {
    if (setjmp(jump_) != 0) return false;
    work();
    return true;
  }

  /// The message of the last error.
  const char* text() const { return text_; }

 private:
  static JpegErrors& of(j_common_ptr codec) { return *reinterpret_cast<JpegErrors*>(codec->err); }

  [[noreturn]] void fail(j_common_ptr codec) {
    manager_.format_message(codec, text_);
    std::longjmp(jump_, 1);
  }

  jpeg_error_mgr manager_ = {};  // must be the first member, because of() converts a pointer to it
  std::jmp_buf jump_;
  char text_[JMSG_LENGTH_MAX] = "";
};

}  // namespace halfspace::HS_LANES
