// SPDX-License-Identifier: Apache-2.0
#include "view/window.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "halfspace/core/check.h"

namespace halfspace {

namespace {

[[noreturn]] void throw_no_display(const char* reason) {
  throw InputError(fmt::format("display: cannot open a window ({}); expected a running X server or Wayland session", reason));
}

// Selects the video driver. Without a display, SDL would try all drivers, which print messages, and finally use one that shows no window.
void choose_driver() {
  if (SDL_getenv("SDL_VIDEODRIVER") != nullptr) return;
  const bool x11 = SDL_getenv("DISPLAY") != nullptr, wayland = SDL_getenv("WAYLAND_DISPLAY") != nullptr;
  if (!x11 && !wayland) throw_no_display("neither DISPLAY nor WAYLAND_DISPLAY is set");
  SDL_SetHint(SDL_HINT_VIDEODRIVER, x11 && wayland ? "x11,wayland" : x11 ? "x11" : "wayland");
}

// Converts a row from RGBA in memory to SDL's ARGB8888.
void copy_row(std::span<const glm::u8vec4> from, uint32_t* to) {
  for (std::size_t x = 0; x < from.size(); ++x) {
    const glm::u8vec4 c = from[x];
    to[x] = 0xff000000u | static_cast<uint32_t>(c.x) << 16 | static_cast<uint32_t>(c.y) << 8 | c.z;
  }
}

}  // namespace

Window::Window(const std::string& title, int width, int height) {
  choose_driver();
  SDL_SetHint(SDL_HINT_RENDER_DRIVER, "software");
  SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
  SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // the program has its own
  if (SDL_Init(SDL_INIT_VIDEO) != 0) throw_no_display(SDL_GetError());
  window_.reset(SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height,
                                 SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI));
  if (window_ == nullptr) throw_no_display(SDL_GetError());
  renderer_.reset(SDL_CreateRenderer(window_.get(), -1, SDL_RENDERER_SOFTWARE));
  if (renderer_ == nullptr) throw_no_display(SDL_GetError());
}

Window::~Window() {
  texture_.reset();
  renderer_.reset();
  window_.reset();
  SDL_Quit();
}

glm::ivec2 Window::size() const {
  glm::ivec2 size(0);
  SDL_GetRendererOutputSize(renderer_.get(), &size.x, &size.y);
  return glm::max(size, glm::ivec2(1));
}

void Window::set_texture_size(int width, int height) {
  if (texture_ != nullptr && texture_size_ == glm::ivec2(width, height)) return;
  texture_.reset(SDL_CreateTexture(renderer_.get(), SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STREAMING, width, height));
  if (texture_ == nullptr) throw OutputError(fmt::format("window: {}", SDL_GetError()));
  SDL_SetTextureBlendMode(texture_.get(), SDL_BLENDMODE_NONE);
  texture_size_ = {width, height};
}

void Window::present(const Image<glm::u8vec4>& image) {
  set_texture_size(image.width(), image.height());
  void* texels = nullptr;
  int pitch = 0;
  if (SDL_LockTexture(texture_.get(), nullptr, &texels, &pitch) != 0) throw OutputError(fmt::format("window: {}", SDL_GetError()));
  for (int y = 0; y < image.height(); ++y) {
    copy_row(image.row(y), reinterpret_cast<uint32_t*>(static_cast<std::byte*>(texels) + static_cast<std::ptrdiff_t>(y) * pitch));
  }
  SDL_UnlockTexture(texture_.get());
  SDL_RenderCopy(renderer_.get(), texture_.get(), nullptr, nullptr);
  SDL_RenderPresent(renderer_.get());
}

}  // namespace halfspace
