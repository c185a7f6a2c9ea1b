// SPDX-License-Identifier: Apache-2.0
//
// A windowless context of a software OpenGL implementation.
#pragma once

#include <string>

namespace halfspace {

/// llvmpipe and softpipe are Mesa drivers. SwiftShader is Chromium's software Vulkan implementation; Mesa's zink driver implements OpenGL
/// on top of it.
enum class GlDriver { llvmpipe, swiftshader, softpipe };

/// A surfaceless EGL context for OpenGL 3.3 core. It is current on the thread that created it until it is destroyed.
class GlContext {
 public:
  /// Sets process-wide environment variables that select the driver and its number of threads. threads must be at least 1:
  ///   llvmpipe     LP_NUM_THREADS is 0 for one thread, so that the main thread does all the work. Otherwise it is `threads`, and the
  ///                driver has that many threads in addition to the main thread.
  ///   SwiftShader  The driver starts a thread for each core that the process can use, so the process is bound to `threads` cores.
  ///   softpipe     The driver is single-threaded; `threads` is ignored.
  /// Throws InputError if the driver is missing or a different driver is loaded. The message says what to install.
  GlContext(GlDriver driver, int threads);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// GL_RENDERER and GL_VERSION.
  const std::string& description() const { return description_; }

 private:
  void open();

  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string description_;
};

}  // namespace halfspace
