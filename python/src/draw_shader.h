// SPDX-License-Identifier: Apache-2.0
//
// The shaders that Python code can draw with.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/shading/surface/depth_only.h"

namespace halfspace::python {

/// A shader with its uniforms and the data that they point to.
struct Shader {
  /// DepthOnly and MaskedDepth write only depth and stencil.
  std::variant<SceneShader, DepthOnly, MaskedDepth<false>> shader;
  std::vector<std::string> attributes;  ///< names of the arrays that a draw needs
  std::vector<std::shared_ptr<const void>> data{};
};

/// Called by bind_draw().
void bind_shaders(pybind11::module_& m);

}  // namespace halfspace::python
