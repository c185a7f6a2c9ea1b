// SPDX-License-Identifier: Apache-2.0
//
// A window that shows images. SDL opens the window and copies each image to it as a texture. Neither a GPU nor OpenGL is needed.
#pragma once

#include <SDL.h>

#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "halfspace/core/image.h"

namespace halfspace {

class Window {
 public:
  /// Throws InputError if there is no display.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  SDL_Window* handle() const { return window_.get(); }
  /// Returns the current size in pixels, at least 1x1.
  glm::ivec2 size() const;
  void set_title(const std::string& title) { SDL_SetWindowTitle(window_.get(), title.c_str()); }

  /// Shows an image, which should have the size of the window. Its alpha is ignored.
  void present(const Image<glm::u8vec4>& image);

 private:
  template <class T>
  using Owned = std::unique_ptr<T, void (*)(T*)>;

  void set_texture_size(int width, int height);

  Owned<SDL_Window> window_{nullptr, SDL_DestroyWindow};
  Owned<SDL_Renderer> renderer_{nullptr, SDL_DestroyRenderer};
  Owned<SDL_Texture> texture_{nullptr, SDL_DestroyTexture};
  glm::ivec2 texture_size_{0};
};

}  // namespace halfspace
