// SPDX-License-Identifier: Apache-2.0
//
// The scene behind halfspace.Scene, without Python types: a scene file, objects with meshes from memory, and assets that are kept between
// images. All functions are thread-safe and are called without the GIL, because they wait for each other.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "halfspace/core/parallel.h"
#include "halfspace/render/model_file/opened_scene.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/render/view.h"

namespace halfspace::python {

/// Width and height of an image in pixels, each 1 to 16384.
struct PictureSize {
  int width, height;
};

/// The time, camera and background of an image.
struct Shot {
  double time = 0.0;                          ///< seconds
  std::optional<CameraDescription> camera{};  ///< replaces the camera of the scene
  bool transparent = false;                   ///< alpha is 0 where nothing is drawn, and the background is omitted
  bool color = true;                          ///< false: no color is needed, see SceneAssets::prepare_values
  bool regular_meshes = false;                ///< mesh_error has no effect, because its meshes depend on the camera
};

/// A mutex for which a thread that already holds it does not wait. This happens in a signal handler of Python that uses the scene that its
/// thread prepares.
class SceneMutex {
 public:
  /// Throws InputError if this thread holds the mutex.
  void lock();
  void unlock();

 private:
  std::mutex mutex_;
  std::atomic<std::thread::id> owner_{};  ///< the thread that holds the mutex
};

/// The functions that render end with an exception when a signal handler of Python raises one (signals.h). The scene is unchanged.
class SceneCore {
 public:
  SceneCore(OpenedScene opened, int threads);
  /// Returns a copy that shares the assets.
  std::shared_ptr<SceneCore> copy() const;

  /// Sets keys, as in SceneFile::set. `camera` in a setting may also be the name of a camera in the model file.
  void set(const std::vector<std::string>& settings);
  /// Returns the value of a key, or the values of all keys of a section, as JSON text.
  std::string value(const std::string& path) const;
  /// Returns the full paths of all keys, in the order of a scene file.
  std::vector<std::string> keys() const;
  /// Applies a JSON merge patch to the scene file.
  void merge(const std::string& patch);
  /// Returns the names of all objects, in the order of their ids.
  std::vector<std::string> objects() const;
  bool has_object(const std::string& name) const;
  /// Returns the names of all lights and of all cameras.
  std::vector<std::string> lights() const;
  std::vector<std::string> cameras() const;
  /// Returns a camera of the scene at a time in seconds. name: as in a setting of `camera`; empty: the camera that the scene selects.
  CameraDescription camera(const std::string& name, double time) const;
  /// Returns the whole scene as the text of a scene file.
  std::string print() const;
  /// Returns the minimum and maximum coordinates of all visible objects at time 0, in world space; nullopt if there are none. Each object
  /// contributes the axis-aligned box around its transformed bounding box. Objects that only show shadows are not visible.
  std::optional<std::array<glm::dvec3, 2>> bounds();

  /// Writes the scene at time 0 as a model file. The extension of `out` must be that of a model format.
  void export_to(const std::string& out);
  /// Throws OutputError if the output is a file that the scene reads.
  void protect_inputs(const std::string& out);

  /// Provides the model for objects with this file name.
  void provide(const std::string& file, std::shared_ptr<const ModelAsset> model);
  /// Sets the transforms of the copies of an object, from its space to world space.
  void place(const std::string& object, std::vector<glm::dmat4> transforms);
  void forget_object(const std::string& object);
  void forget_model(const std::string& file);

  PreparedScene prepare(const Shot& shot, PictureSize size);
  /// Returns the image that keep_picture() kept if it has this size, otherwise a new one. Its contents are undefined.
  Image<glm::u8vec4> take_picture(PictureSize size);
  /// Keeps an image for the next frame, because allocating a new image also clears it.
  void keep_picture(Image<glm::u8vec4> picture);
  /// Announces frames, so that generated maps do not change between them.
  void expect(std::span<const double> times, PictureSize size);
  /// Prepares all shots and calls render(index, scene, workers) for each, several at a time from several threads.
  void for_each_shot(std::span<const Shot> shots, PictureSize size,
                     const std::function<void(std::size_t, const PreparedScene&, const Workers&)>& render);

  /// Returns the warnings since the last call.
  std::vector<std::string> take_warnings();
  int threads() const { return workers_.threads(); }
  /// Returns the names of cameras in the model file, and the corresponding names in the scene.
  const std::map<std::string, std::string>& camera_names() const { return camera_names_; }
  /// Returns how many of `shots` images for_each_shot() renders at the same time.
  std::size_t images_at_once(std::size_t shots) const { return std::min(shots, static_cast<std::size_t>(threads())); }
  const Workers& workers() const { return workers_; }

 private:
  // Everything that describes the scene.
  struct State {
    SceneFile scene;
    std::map<std::string, std::shared_ptr<const ModelAsset>> models;  ///< by file
    std::map<std::string, std::vector<glm::dmat4>> places;            ///< by object

    SceneDescription description(const Shot& shot) const;
    PreparedScene prepare(const Shot& shot, PictureSize size, SceneAssets& assets) const;
  };

  SceneCore(const SceneCore& other, const std::lock_guard<SceneMutex>&);
  std::function<void(const std::string&)> warner() {
    return [this](const std::string& problem) { warn(problem); };
  }
  void warn(const std::string& problem);

  mutable SceneMutex mutex_;  ///< guards the state, its bounds, the assets and the picture
  State state_;
  bool bounds_known_ = false;
  std::optional<std::array<glm::dvec3, 2>> bounds_;        ///< valid if bounds_known_
  const std::map<std::string, std::string> camera_names_;  ///< names in the model and the corresponding names in the scene
  Image<glm::u8vec4> picture_;
  std::mutex warnings_mutex_;
  std::vector<std::string> warnings_;
  std::set<std::string> warned_;
  Workers workers_;
  SceneAssets assets_;
};

}  // namespace halfspace::python
