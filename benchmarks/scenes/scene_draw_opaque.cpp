// SPDX-License-Identifier: Apache-2.0
#include "scenes/scene_draw.h"

namespace halfspace {

void draw_scene_opaque(Pass& pass, const SceneJob& job, const SceneObject& object) { draw_scene_object<SceneOpaque>(pass, job, object); }
void draw_scene_unlit(Pass& pass, const SceneJob& job, const SceneObject& object) { draw_scene_object<SceneUnlit>(pass, job, object); }

}  // namespace halfspace
