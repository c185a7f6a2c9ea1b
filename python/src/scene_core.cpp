// SPDX-License-Identifier: Apache-2.0
#include "scene_core.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/render/export/export_files.h"
#include "halfspace/render/model_file/input_files.h"
#include "halfspace/render/prepare/scene_places.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_paths.h"
#include "messages.h"
#include "shot_queue.h"
#include "signals.h"

namespace halfspace::python {

namespace {

/// The smallest axis-aligned box that contains all added points.
class Box {
 public:
  void add(const glm::dvec3& point) {
    low_ = glm::min(low_, point);
    high_ = glm::max(high_, point);
  }
  bool is_empty() const { return !(low_.x <= high_.x); }
  const glm::dvec3& low() const { return low_; }
  const glm::dvec3& high() const { return high_; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec3 low_{kInfinity}, high_{-kInfinity};
};

template <class T>
std::vector<std::string> copied_names(const Named<T>& list) {
  const std::vector<std::string_view> names = names_of(list);
  return {names.begin(), names.end()};
}

// Adds the corners of a transformed box.
void add_corners(Box& box, const Box& object, const glm::dmat4& world_from_object) {
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? object.high().x : object.low().x, (i & 2) != 0 ? object.high().y : object.low().y,
                            (i & 4) != 0 ? object.high().z : object.low().z);
    box.add(glm::dvec3(world_from_object * glm::dvec4(corner, 1.0)));
  }
}

std::optional<std::array<glm::dvec3, 2>> bounds_of(const PreparedScene& scene) {
  Box all;
  std::map<const glm::vec3*, Box> meshes;  // copies of an object share their positions
  for (const PreparedDraw& draw : scene.draws) {
    const std::span<const glm::vec3> positions = draw.source.streams.positions;
    if (draw.source.object < 0 || positions.empty() || std::holds_alternative<ShadowCatcher>(draw.shader)) continue;
    Box& mesh = meshes[positions.data()];
    if (mesh.is_empty()) std::ranges::for_each(positions, [&](const glm::vec3& p) { mesh.add(glm::dvec3(p)); });
    add_corners(all, mesh, draw.source.world_from_object);
  }
  for (const PlacedSpheres& placed : scene.spheres) {
    for (std::size_t i = 0; i < placed.particles->radii.size(); ++i) {
      const glm::dvec3 radius(static_cast<double>(placed.particles->radii[i])), &center = placed.particles->centers_ws[i];
      all.add(center - radius);
      all.add(center + radius);
    }
  }
  if (all.is_empty()) return std::nullopt;
  return std::array{all.low(), all.high()};
}

}  // namespace

void SceneMutex::lock() {
  if (owner_ == std::this_thread::get_id())
    throw InputError("scene: is used by a signal handler while the same thread prepares it; expected another scene in the handler");
  mutex_.lock();
  owner_ = std::this_thread::get_id();
}

void SceneMutex::unlock() {
  owner_ = std::thread::id();
  mutex_.unlock();
}

SceneCore::SceneCore(OpenedScene opened, int threads)
    : state_{std::move(opened.scene), {}, {}},
      camera_names_(std::move(opened.camera_names)),
      workers_(threads, check_signals),
      assets_(workers_, warner()) {
  if (opened.model != nullptr) state_.models[opened.model_file.string()] = opened.model;
}

SceneCore::SceneCore(const SceneCore& other, const std::lock_guard<SceneMutex>&)
    : state_(other.state_),
      camera_names_(other.camera_names_),
      workers_(other.threads(), check_signals),
      assets_(other.assets_, workers_, warner()) {}

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
  bounds_known_ = false;
}

std::string SceneCore::value(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  SceneDescription scene = state_.scene.description();
  const Section section = find_section(scene, path, state_.scene.source());
  return (section.empty() ? value_of(find_key(scene, path, state_.scene.source()).field) : json_of(section)).dump();
}

std::vector<std::string> SceneCore::keys() const {
  const std::lock_guard lock(mutex_);
  SceneDescription scene = state_.scene.description();
  std::vector<std::string> paths;
  for (const NamedSection& section : sections_of(scene)) {
    for (const Field& field : fields_of(section.section))
      paths.push_back(section.path.empty() ? field.key->name : section.path + "." + field.key->name);
  }
  return paths;
}

void SceneCore::merge(const std::string& patch) {
  const std::lock_guard lock(mutex_);
  state_.scene.merge(patch, state_.scene.source());
  bounds_known_ = false;
}

std::vector<std::string> SceneCore::objects() const {
  const std::lock_guard lock(mutex_);
  return copied_names(state_.scene.description().objects);
}

bool SceneCore::has_object(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return find_named(state_.scene.description().objects, name) != nullptr;
}

std::vector<std::string> SceneCore::lights() const {
  const std::lock_guard lock(mutex_);
  return copied_names(state_.scene.description().lights);
}

std::vector<std::string> SceneCore::cameras() const {
  const std::lock_guard lock(mutex_);
  return copied_names(state_.scene.description().cameras);
}

CameraDescription SceneCore::camera(const std::string& name, double time) const {
  const std::lock_guard lock(mutex_);
  const auto renamed = camera_names_.find(name);
  const SceneDescription description = state_.scene.at(time);
  if (name.empty()) return camera_of(description);
  if (const CameraDescription* found = find_named(description.cameras, renamed != camera_names_.end() ? renamed->second : name))
    return *found;
  std::string names;
  for (const auto& [known, camera] : description.cameras) names += (names.empty() ? "one of " : ", ") + known;
  throw InputError("camera: no camera '" + name + "' in this scene; expected " + (names.empty() ? "a halfspace.Camera" : names));
}

std::string SceneCore::print() const {
  const std::lock_guard lock(mutex_);
  return state_.scene.print();
}

std::optional<std::array<glm::dvec3, 2>> SceneCore::bounds() {
  const std::lock_guard lock(mutex_);
  if (bounds_known_) return bounds_;
  Shot shot{.camera = CameraDescription{}, .color = false, .regular_meshes = true};  // any camera: nothing is culled
  bounds_ = bounds_of(state_.prepare(shot, {16, 16}, assets_));
  bounds_known_ = true;
  return bounds_;
}

void SceneCore::export_to(const std::string& out) {
  const std::lock_guard lock(mutex_);
  const ModelFormat format = model_format_of(out).value();
  SceneAssets assets(assets_, workers_, {});  // of pictures; those of the export are dropped
  for (const auto& [file, model] : state_.models) assets.add_model(file, model);
  ExportSource source = export_source(state_.description({}), state_.scene.source(), assets, format, state_.models);
  write_files(out, exported_files(std::move(source), out, format, warner()));
}

void SceneCore::protect_inputs(const std::string& out) {
  const std::lock_guard lock(mutex_);
  ReadModels models;
  for (const auto& [file, model] : state_.models) models.try_emplace({file, model->allow_outside}, model);
  models = read_models(state_.scene, std::move(models));
  add_models(assets_, models);  // they are not read again
  reject_overwriting(out, input_files(state_.description({}), state_.scene.source(), models));
}

void SceneCore::provide(const std::string& file, std::shared_ptr<const ModelAsset> model) {
  const std::lock_guard lock(mutex_);
  state_.models[file] = std::move(model);
}

void SceneCore::place(const std::string& object, std::vector<glm::dmat4> transforms) {
  const std::lock_guard lock(mutex_);
  state_.places[object] = std::move(transforms);
  bounds_known_ = false;
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
  if (warned_.insert(problem).second) warnings_.push_back(in_python_terms(problem));
}

std::vector<std::string> SceneCore::take_warnings() {
  const std::lock_guard lock(warnings_mutex_);
  return std::exchange(warnings_, {});
}

SceneDescription SceneCore::State::description(const Shot& shot) const {
  SceneDescription description = scene.at(shot.time);
  for (auto& [name, object] : description.objects) {
    if (shot.regular_meshes) object.mesh_error = 0.0;
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
    return shot.color ? assets.prepare(shown, size.width, size.height) : assets.prepare_values(shown, size.width, size.height);
  } catch (const InputError& e) {
    throw InputError(message_in_scene(scene, e.what()));
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
  const int teams = static_cast<int>(images_at_once(shots.size() - 1));
  ShotQueue queue(1, shots.size());
  // A separate team, because threads that wait for the lock in render() must not occupy the threads that prepare() needs while it holds the
  // lock.
  const Workers team(workers_.threads());
  team.for_each(teams, [&](int) {
    const Workers own(1, [&queue] { queue.check(); });
    SceneAssets assets(shared, own, warner());
    queue.work([&](std::size_t i) { render(i, state.prepare(shots[i], size, assets), own); });
  });
}

}  // namespace halfspace::python
