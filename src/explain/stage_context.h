// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace {

PassContext stage_context(const PreparedScene& scene, const Workers& workers);

}  // namespace halfspace
