// SPDX-License-Identifier: Apache-2.0
//
// Compares the names of varyings with the headers of the shaders.
#include "explain/varying_names.h"

#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "support/files.h"

namespace halfspace {

namespace {

// Returns the names of the members of `struct Varyings` in a header.
std::vector<std::string> members_in(const std::string& header) {
  const std::string text = read_bytes("src/shading/" + header);
  std::smatch found;
  if (!std::regex_search(text, found, std::regex("struct Varyings \\{([^}]*)\\}"))) return {};
  const std::string body = std::regex_replace(found[1].str(), std::regex("//[^\n]*"), "");
  std::vector<std::string> names;
  const std::regex name("(\\w+)\\s*[,;]");
  // template arguments contain commas, too
  const std::string plain = std::regex_replace(std::regex_replace(body, std::regex("<[^<>]*>"), ""), std::regex("<[^;]*>"), "");
  for (std::sregex_iterator i(plain.begin(), plain.end(), name); i != std::sregex_iterator(); ++i) names.push_back((*i)[1]);
  return names;
}

template <class S>
void expect_names(const std::string& header) {
  EXPECT_EQ(members_in(header), std::vector<std::string>(kVaryingNames<S>.begin(), kVaryingNames<S>.end())) << header;
}

TEST(VaryingNames, MatchTheHeaders) {
  expect_names<SurfaceShader<ShadingRate::phong, true>>("surface/surface_shader.h");
  expect_names<MetallicSurface<MetallicStreams::full>>("surface/metallic_surface.h");
  expect_names<SphereImpostor<true>>("sphere/sphere_impostor.h");
  expect_names<StarSky>("environment/star_sky.h");
  expect_names<EnvironmentSky>("environment/environment_sky.h");
  expect_names<ColoredPrimitives>("surface/colored_primitives.h");
  expect_names<NormalLines>("surface/normal_lines.h");
  expect_names<ShadowCatcher>("surface/shadow_catcher.h");
}

}  // namespace

}  // namespace halfspace
