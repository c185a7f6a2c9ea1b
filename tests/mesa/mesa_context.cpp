// SPDX-License-Identifier: Apache-2.0
#include "mesa/mesa_context.h"

#include <cstdlib>
#include <string_view>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace halfspace::test {

namespace {

void set_environment() {
  const auto set = [](const char* name, const char* value) { setenv(name, value, 1); };
  set("EGL_PLATFORM", "surfaceless");
  set("LIBGL_ALWAYS_SOFTWARE", "1");
  set("GALLIUM_DRIVER", "llvmpipe");
  // no_aos_sampling filters textures in float instead of 8-bit integers; no_quad_lod computes a level of detail per pixel.
  set("GALLIVM_PERF", "no_aos_sampling,no_quad_lod");
  // The key of Mesa's shader cache does not include GALLIVM_PERF, so a cached shader could have been compiled without it.
  set("MESA_SHADER_CACHE_DISABLE", "true");
  // llvmpipe's additional threads do not help, because tests already run in parallel.
  set("LP_NUM_THREADS", "0");
}

bool contains(const char* extensions, std::string_view name) {
  return extensions != nullptr && std::string_view(extensions).find(name) != std::string_view::npos;
}

}  // namespace

std::unique_ptr<MesaContext> MesaContext::create(std::string& missing) {
  set_environment();
  const auto absent = [&missing](const char* what) {
    missing = what;
    return nullptr;
  };
  // libepoxy terminates the process if it cannot load a function, so check for the library first.
  if (dlopen("libEGL.so.1", RTLD_LAZY | RTLD_GLOBAL) == nullptr) return absent("libEGL.so.1 is missing (Debian: libegl1)");
  if (!contains(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless"))
    return absent("EGL has no surfaceless platform (Debian: libegl-mesa0)");

  std::unique_ptr<MesaContext> mesa(new MesaContext);
  mesa->display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (mesa->display_ == EGL_NO_DISPLAY || !eglInitialize(mesa->display_, nullptr, nullptr)) {
    mesa->display_ = nullptr;
    return absent("Mesa's surfaceless display cannot be opened (Debian: libgl1-mesa-dri)");
  }
  eglBindAPI(EGL_OPENGL_API);
  const EGLint want_config[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  eglChooseConfig(mesa->display_, want_config, &config, 1, &configs);
  if (configs == 0) return absent("Mesa offers no OpenGL configuration");
  const EGLint want_context[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  mesa->context_ = eglCreateContext(mesa->display_, config, EGL_NO_CONTEXT, want_context);
  if (mesa->context_ == EGL_NO_CONTEXT || !eglMakeCurrent(mesa->display_, EGL_NO_SURFACE, EGL_NO_SURFACE, mesa->context_))
    return absent("Mesa cannot create an OpenGL 4.5 core context");

  const auto text = [](GLenum name) { return std::string(reinterpret_cast<const char*>(glGetString(name))); };
  mesa->description_ = text(GL_RENDERER) + ", " + text(GL_VERSION);
  if (mesa->description_.rfind("llvmpipe", 0) != 0) {
    missing = "the renderer is " + mesa->description_ + ", not llvmpipe";
    return nullptr;
  }
  return mesa;
}

MesaContext::~MesaContext() {
  if (display_ == nullptr) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_ != nullptr) eglDestroyContext(display_, context_);
  eglTerminate(display_);
}

}  // namespace halfspace::test

// Mesa leaks a few kilobytes at exit, from libraries that are already unloaded, so no suppression can name them. Leaks in Halfspace are
// found by the other test programs.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }
