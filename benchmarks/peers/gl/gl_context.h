// SPDX-License-Identifier: Apache-2.0
//
// A software OpenGL without a window.
#pragma once

#include <string>

namespace halfspace {

/// llvmpipe and softpipe are Mesa's own; SwiftShader is Chromium's Vulkan, on which Mesa's zink builds an OpenGL.
enum class GlDriver { llvmpipe, swiftshader, softpipe };

/// A surfaceless EGL context of OpenGL 3.3 core, current on the thread that made it until destroyed.
class GlContext {
 public:
  /// Sets the environment variables that choose the driver and its threads, for the whole process; threads >= 1:
  ///   llvmpipe     LP_NUM_THREADS: 0 for one thread, which then does everything; else so many beside the main one
  ///   SwiftShader  takes a thread for each core that the process may use, so the process is bound to so many cores
  ///   softpipe     has one
  /// Throws InputError where the driver is absent or another one answers; the message says what to install.
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
