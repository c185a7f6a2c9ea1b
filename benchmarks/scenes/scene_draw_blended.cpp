// SPDX-License-Identifier: Apache-2.0
#include "scenes/scene_draw.h"

namespace halfspace {

void draw_scene_blended(Pass& pass, const SceneJob& job, const SceneObject& object) { draw_scene_object<SceneBlended>(pass, job, object); }

}  // namespace halfspace
