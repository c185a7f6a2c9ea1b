// SPDX-License-Identifier: Apache-2.0
//
// Prepares scenes for the tests of explain.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "explain/pixel_history.h"
#include "explain/stage_geometry.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace {

/// A prepared scene and the objects that it refers to.
struct PreparedText {
  PreparedText(const SceneDescription& scene, int width, int height, int threads = 2)
      : workers(threads), assets(workers), description(scene), prepared(assets.prepare(scene, width, height)) {}
  PreparedText(const std::string& text, int width, int height)
      : PreparedText(SceneFile::parse(text, "test", std::filesystem::current_path()).at(0.0), width, height) {}

  /// Calls f with the context of the frame after setup, and its primitives.
  void visit(const std::function<void(const PassContext&, const StageGeometry&)>& f) const {
    visit_set_up_scene(prepared, workers, [&](const PassContext& context, int) { f(context, stage_geometry(context)); });
  }

  Workers workers;
  SceneAssets assets;
  SceneDescription description;
  PreparedScene prepared;
};

}  // namespace halfspace
