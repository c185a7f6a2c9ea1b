// SPDX-License-Identifier: Apache-2.0
#include "scene_core.h"

#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace::python {

SceneCore::SceneCore(OpenedScene opened, int threads)
    : state_{std::move(opened.scene), {}, {}},
      camera_names_(std::move(opened.camera_names)),
      workers_(threads),
      assets_(workers_, warner()) {
  if (opened.model != nullptr) state_.models[opened.model_file.string()] = opened.model;
}

SceneCore::SceneCore(const SceneCore& other, const std::lock_guard<std::mutex>&)
    : state_(other.state_), camera_names_(other.camera_names_), workers_(other.threads()), assets_(other.assets_, workers_, warner()) {}

std::shared_ptr<SceneCore> SceneCore::copy() const {
  const std::lock_guard lock(mutex_);
  return std::shared_ptr<SceneCore>(new SceneCore(*this, lock));
}

void SceneCore::set(const std::vector<std::string>& settings) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> own = settings;
  constexpr std::string_view kCamera = "camera=";
  for (std::string& setting : own) {
    if (!setting.starts_with(kCamera)) continue;
    const auto found = camera_names_.find(setting.substr(kCamera.size()));
    if (found != camera_names_.end()) setting = std::string(kCamera) + found->second;
  }
  state_.scene.set(own);
}

std::string SceneCore::value(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  SceneDescription scene = state_.scene.description();
  return value_of(find_key(scene, path, state_.scene.source()).field).dump();
}

void SceneCore::merge(const std::string& patch) {
  const std::lock_guard lock(mutex_);
  state_.scene.merge(patch, state_.scene.source());
}

std::vector<std::string> SceneCore::objects() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& [name, object] : state_.scene.description().objects) names.push_back(name);
  return names;
}

bool SceneCore::has_object(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return find_named(state_.scene.description().objects, name) != nullptr;
}

bool SceneCore::has_light(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return find_named(state_.scene.description().lights, name) != nullptr;
}

std::string SceneCore::print() const {
  const std::lock_guard lock(mutex_);
  return state_.scene.print();
}

void SceneCore::provide(const std::string& file, std::shared_ptr<const ModelAsset> model) {
  const std::lock_guard lock(mutex_);
  state_.models[file] = std::move(model);
}

void SceneCore::place(const std::string& object, std::vector<glm::dmat4> transforms) {
  const std::lock_guard lock(mutex_);
  state_.places[object] = std::move(transforms);
}

void SceneCore::forget_object(const std::string& object) {
  const std::lock_guard lock(mutex_);
  state_.places.erase(object);
}

void SceneCore::forget_model(const std::string& file) {
  const std::lock_guard lock(mutex_);
  state_.models.erase(file);
}

void SceneCore::warn(const std::string& problem) {
  const std::lock_guard lock(warnings_mutex_);
  if (warned_.insert(problem).second) warnings_.push_back(problem);
}

std::vector<std::string> SceneCore::take_warnings() {
  const std::lock_guard lock(warnings_mutex_);
  return std::exchange(warnings_, {});
}

SceneDescription SceneCore::State::description(const Shot& shot) const {
  SceneDescription description = scene.at(shot.time);
  for (auto& [name, object] : description.objects) {
    const auto found = places.find(name);
    if (found == places.end()) continue;
    object.instances.clear();
    for (const glm::dmat4& transform : found->second) object.instances.push_back({.matrix = transform});
    object.visible = object.visible && !found->second.empty();
  }
  if (shot.transparent) description.background.type = BackgroundType::transparent;
  if (shot.camera) {
    description.cameras = {{"shot", *shot.camera}};
    description.head.camera = "shot";
  }
  return description;
}

PreparedScene SceneCore::State::prepare(const Shot& shot, PictureSize size, SceneAssets& assets) const {
  const SceneDescription shown = description(shot);
  for (const auto& [file, model] : models) assets.add_model(file, model);  // assets drop models that a frame does not use
  try {
    return assets.prepare(shown, size.width, size.height);
  } catch (const InputError& e) {
    throw InputError(scene.source() + ": " + e.what());
  }
}

PreparedScene SceneCore::prepare(const Shot& shot, PictureSize size) {
  const std::lock_guard lock(mutex_);
  return state_.prepare(shot, size, assets_);
}

Image<glm::u8vec4> SceneCore::take_picture(PictureSize size) {
  std::unique_lock lock(mutex_);
  Image<glm::u8vec4> kept = std::move(picture_);
  picture_ = {};
  lock.unlock();
  if (kept.width() == size.width && kept.height() == size.height) return kept;
  return {size.width, size.height};
}

void SceneCore::keep_picture(Image<glm::u8vec4> picture) {
  const std::lock_guard lock(mutex_);
  picture_ = std::move(picture);
}

void SceneCore::expect(std::span<const double> times, PictureSize size) {
  const std::lock_guard lock(mutex_);
  const auto time_of = [&](int i) { return times[static_cast<std::size_t>(i)]; };
  if (!times.empty()) expect_frames(assets_, state_.scene, static_cast<int>(times.size()), time_of, size.width, size.height);
}

// The first shot is rendered by all threads and loads the assets. Afterwards, each thread renders whole images with its own list of the
// shared assets. The lock is not held while rendering, because render() may call Python code that uses the scene. All shots show the state
// of the scene at the time of the call.
void SceneCore::for_each_shot(std::span<const Shot> shots, PictureSize size,
                              const std::function<void(std::size_t, const PreparedScene&, const Workers&)>& render) {
  if (shots.empty()) return;
  std::unique_lock lock(mutex_);
  const State state = state_;
  auto first = std::make_optional(state.prepare(shots[0], size, assets_));
  const SceneAssets shared(assets_, workers_, {});
  lock.unlock();
  render(0, *first, workers_);
  first.reset();
  const int teams = static_cast<int>(std::min<std::size_t>(shots.size() - 1, static_cast<std::size_t>(workers_.threads())));
  std::atomic<std::size_t> next = 1;
  // A separate team, because threads that wait for the lock in render() must not occupy the threads that prepare() needs while it holds the
  // lock.
  const Workers team(workers_.threads());
  team.for_each(teams, [&](int) {
    const Workers own(1);
    SceneAssets assets(shared, own, warner());
    try {
      for (std::size_t i = next++; i < shots.size(); i = next++) {
        render(i, state.prepare(shots[i], size, assets), own);
      }
    } catch (...) {
      next = shots.size();
      throw;
    }
  });
}

}  // namespace halfspace::python
