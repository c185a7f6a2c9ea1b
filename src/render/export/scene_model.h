// SPDX-License-Identifier: Apache-2.0
//
// Converts scenes to models, for export.
//
// * Every object becomes a node; its copies become instances. Exact spheres become icospheres with 20480 triangles. Objects of shape `file`
//   contribute the nodes of their model. Hidden objects, shadow catchers and particles are omitted.
// * Materials are converted from Blinn-Phong to metallic-roughness: the base color is color · diffuse and metalness is 0. The roughness r
//   with r² = sqrt(2/(shininess + 2)) gives the GGX distribution the width of the highlight, and the reflectance at normal incidence
//   F0 = 4 r⁴ · specular, at most 1, its peak. Without specular light F0 is 0. Objects with shading `none` are unlit.
// * Lights: an intensity of 1 is π candela or lux. All lights get physical falloff.
// * Ambient light, environments, the background, the tone curve, bump maps and reflections have no equivalent and are omitted.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "halfspace/model/model.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"

namespace halfspace::HS_LANES {

/// Models in memory, by the file names that objects have.
using MemoryModels = std::map<std::string, std::shared_ptr<const ModelAsset>>;

/// Returns the scene as a model with images in memory. Model::warnings has one line for each kind of data that is omitted. with_lights:
/// false for formats that cannot store lights. The model then has none, and there are no warnings about their conversion. models:
/// files that are not read. Throws InputError if a file that the scene refers to cannot be used.
Model scene_model(SceneDescription scene, SceneAssets& assets, bool with_lights = true, const MemoryModels& models = {});

}  // namespace halfspace::HS_LANES
