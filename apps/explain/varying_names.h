// SPDX-License-Identifier: Apache-2.0
//
// Names of the varyings of the shaders that scenes can use. A test compares them with the headers in shading/.
#pragma once

#include <array>
#include <string_view>

#include "halfspace/render/prepared_scene.h"

namespace halfspace {

/// The members of S::Varyings in order, including members that some variants of the shader do not have.
template <class S>
inline constexpr std::array<std::string_view, 0> kVaryingNames{};

template <ShadingRate rate, bool mapped, NormalDetail detail, bool highlight>
inline constexpr std::array<std::string_view, 10> kVaryingNames<SurfaceShader<rate, mapped, detail, highlight>>{
    "corner_rws", "position_os", "position_rws", "normal_ws", "tangent_ws", "side", "color", "diffuse", "specular", "uv"};

template <MetallicStreams streams, bool masked>
inline constexpr std::array<std::string_view, 7> kVaryingNames<MetallicSurface<streams, masked>>{
    "position_rws", "normal_ws", "tangent_ws", "side", "uv", "second_uv", "color"};

template <bool exact>
inline constexpr std::array<std::string_view, 3> kVaryingNames<SphereImpostor<exact>>{"center_cs", "radius", "color"};

template <>
inline constexpr std::array<std::string_view, 1> kVaryingNames<StarSky>{"ray_ws"};
template <>
inline constexpr std::array<std::string_view, 1> kVaryingNames<EnvironmentSky>{"ray_ws"};
template <>
inline constexpr std::array<std::string_view, 1> kVaryingNames<ColoredPrimitives>{"color"};
template <>
inline constexpr std::array<std::string_view, 1> kVaryingNames<NormalLines>{"normal_ws"};
template <>
inline constexpr std::array<std::string_view, 2> kVaryingNames<ShadowCatcher>{"position_os", "position_rws"};

}  // namespace halfspace
