// SPDX-License-Identifier: Apache-2.0
#include "peers/gl/gl_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <sched.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "halfspace/core/check.h"

namespace halfspace {

namespace {

// The path in the Debian package chromium.
constexpr std::string_view kSwiftShaderIcd = "/usr/lib/chromium/vk_swiftshader_icd.json";

void set(const char* name, const std::string& value) { setenv(name, value.c_str(), 1); }

void choose_swiftshader() {
  set("GALLIUM_DRIVER", "zink");
  set("MESA_LOADER_DRIVER_OVERRIDE", "zink");
  // SwiftShader lacks features that zink requires for OpenGL 3.3. The workloads use none of them, so override the version.
  set("MESA_GL_VERSION_OVERRIDE", "3.3");
  set("MESA_GLSL_VERSION_OVERRIDE", "330");
  if (std::getenv("VK_ICD_FILENAMES") != nullptr) return;
  if (!std::filesystem::exists(kSwiftShaderIcd))
    throw InputError("SwiftShader not found: no " + std::string(kSwiftShaderIcd) +
                     "; install the Debian packages chromium and libvulkan1, or set VK_ICD_FILENAMES to its ICD");
  set("VK_ICD_FILENAMES", std::string(kSwiftShaderIcd));
}

void bind_to_cores(int cores) {
  cpu_set_t may, wanted;
  CPU_ZERO(&wanted);
  if (sched_getaffinity(0, sizeof may, &may) != 0) return;
  for (std::size_t i = 0; i < CPU_SETSIZE && CPU_COUNT(&wanted) < cores; ++i) {
    if (CPU_ISSET(i, &may)) CPU_SET(i, &wanted);
  }
  sched_setaffinity(0, sizeof wanted, &wanted);
}

void choose(GlDriver driver, int threads) {
  set("EGL_PLATFORM", "surfaceless");
  set("LIBGL_ALWAYS_SOFTWARE", "1");
  switch (driver) {
    case GlDriver::llvmpipe:
      set("GALLIUM_DRIVER", "llvmpipe");
      set("LP_NUM_THREADS", std::to_string(threads == 1 ? 0 : threads));
      break;
    case GlDriver::swiftshader:
      choose_swiftshader();
      bind_to_cores(threads);
      break;
    case GlDriver::softpipe: set("GALLIUM_DRIVER", "softpipe"); break;
  }
}

constexpr std::string_view name_of(GlDriver driver) {
  constexpr std::array<std::string_view, 3> k{"llvmpipe", "SwiftShader", "softpipe"};
  return k[static_cast<std::size_t>(driver)];
}

[[noreturn]] void absent(const std::string& what) { throw InputError("no OpenGL: " + what); }

}  // namespace

GlContext::GlContext(GlDriver driver, int threads) {
  choose(driver, threads);
  open();
  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  description_ = text(GL_RENDERER) + ", " + text(GL_VERSION);
  if (description_.find(name_of(driver)) == std::string::npos)
    absent("requested " + std::string(name_of(driver)) + ", got " + description_ +
           "; install libgl1-mesa-dri, and libvulkan1 for SwiftShader");
}

void GlContext::open() {
  // libepoxy aborts the process if it cannot load a library, so check first.
  if (dlopen("libEGL.so.1", RTLD_LAZY | RTLD_GLOBAL) == nullptr) absent("libEGL.so.1 is missing; install libegl1");
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (extensions == nullptr || std::string_view(extensions).find("EGL_MESA_platform_surfaceless") == std::string_view::npos)
    absent("EGL has no surfaceless platform; install libegl-mesa0");
  display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (!eglInitialize(display_, nullptr, nullptr))
    absent("cannot open Mesa's surfaceless display; install libgl1-mesa-dri, and libvulkan1 for SwiftShader");
  eglBindAPI(EGL_OPENGL_API);
  const std::array<EGLint, 5> want_config{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  eglChooseConfig(display_, want_config.data(), &config, 1, &configs);
  const std::array<EGLint, 7> want_context{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, want_context.data());
  if (context_ == EGL_NO_CONTEXT || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
    absent("Mesa cannot create an OpenGL 3.3 core context");
}

GlContext::~GlContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

}  // namespace halfspace
