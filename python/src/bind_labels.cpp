// SPDX-License-Identifier: Apache-2.0
//
// Labels: the values of a frame other than its color.
#include <atomic>
#include <cstring>
#include <set>

#include "bindings.h"
#include "halfspace/render/frame/frame.h"
#include "memory.h"
#include "shots.h"

namespace halfspace::python {

namespace {

/// The images of all labels. Those that are not requested are empty.
struct LabelImages {
  Image<glm::u8vec4> color;
  Image<float> depth, distance;
  Image<glm::vec3> normal, camera_normal, albedo, position, barycentrics;
  Image<glm::vec2> uv;
  Image<uint32_t> object, instance, triangle;

  /// Returns the bytes per pixel of the images with these names.
  std::size_t pixel_bytes(const std::set<std::string>& names) {
    std::size_t sum = 0;
    for_each([&](const char* name, const auto& image, auto) { sum += names.contains(name) ? sizeof *image.data() : 0; });
    return sum;
  }

  /// Calls visit(name, image, member of FrameImages) for each label.
  template <class F>
  void for_each(const F& visit) {
    visit("color", color, &FrameImages::picture);
    visit("depth", depth, &FrameImages::depth);
    visit("distance", distance, &FrameImages::distance);
    visit("normal", normal, &FrameImages::normal);
    visit("camera_normal", camera_normal, &FrameImages::camera_normal);
    visit("albedo", albedo, &FrameImages::albedo);
    visit("position", position, &FrameImages::position);
    visit("uv", uv, &FrameImages::uv);
    visit("object", object, &FrameImages::object);
    visit("instance", instance, &FrameImages::instance);
    visit("triangle", triangle, &FrameImages::triangle);
    visit("barycentrics", barycentrics, &FrameImages::barycentrics);
  }
};

using Names = std::set<std::string>;

/// The values that are rendered, and how.
struct Wanted {
  Names names;
  float background_depth;
  bool alpha;  ///< the color has a fourth channel, and no background

  Shot shot(double time, const CameraDescription* camera) const {
    Shot shot = shot_of(time, camera);
    shot.transparent = alpha;
    shot.color = names.contains("color");
    return shot;
  }
};

/// Allocates the requested images and renders them.
void render_labels(LabelImages& images, const Wanted& wanted, PictureSize size, const PreparedScene& scene, const Workers& workers) {
  FrameImages frame;
  frame.background_depth = wanted.background_depth;
  images.for_each([&](const char* name, auto& image, auto member) {
    if (!wanted.names.contains(name)) return;
    image = std::decay_t<decltype(image)>(size.width, size.height);
    frame.*member = &image;
  });
  render_frame(scene, frame, workers);
}

// Returns an array of shape (height, width, 3).
py::array rgb_of(const Image<glm::u8vec4>& image) {
  py::array_t<uint8_t> array({py::ssize_t{image.height()}, py::ssize_t{image.width()}, py::ssize_t{3}});
  uint8_t* out = array.mutable_data();
  const py::gil_scoped_release release;
  copy_rgb(image.texels(), out);
  return array;
}

// Moves the images with these names to arrays.
py::dict arrays_of(LabelImages& images, const Names& names, bool alpha) {
  py::dict arrays;
  images.for_each([&]<class Texel>(const char* name, Image<Texel>& image, auto) {
    if (!names.contains(name)) return;
    if constexpr (std::is_same_v<Texel, glm::u8vec4>) {
      if (!alpha) {
        arrays[name] = rgb_of(image);
        return;
      }
    }
    arrays[name] = array_of(std::move(image));
  });
  return arrays;
}

py::dict labels(SceneCore& scene, int width, int height, double time, const CameraDescription* camera, const Names& names,
                float background_depth, bool alpha) {
  LabelImages images;
  const Wanted wanted{names, background_depth, alpha};
  const Shot shot = wanted.shot(time, camera);
  const PictureSize size{width, height};
  return with_memory(size, images.pixel_bytes(names) + (names.contains("color") && !alpha ? 3 : 0), [&] {
    {
      const py::gil_scoped_release release;
      render_labels(images, wanted, size, scene.prepare(shot, size), scene.workers());
    }
    return arrays_of(images, names, alpha);
  });
}

/// Arrays of shape (N, height, width, ...) that a batch fills.
class LabelArrays {
 public:
  LabelArrays(const Wanted& wanted, std::size_t count, PictureSize size) : alpha_(wanted.alpha) {
    LabelImages images;
    images.for_each([&](const char* name, auto& image, auto) {
      using Texel = std::decay_t<decltype(*image.data())>;
      if (!wanted.names.contains(name)) return;
      std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(count), size.height, size.width};
      if constexpr (std::is_same_v<Texel, glm::u8vec4>) {
        shape.push_back(alpha_ ? 4 : 3);
      } else if constexpr (!std::is_arithmetic_v<Texel>) {
        shape.push_back(Texel::length());
      }
      py::array array(py::dtype::of<Number<Texel>>(), shape);
      places_[name] = static_cast<std::byte*>(array.mutable_data());
      arrays_[name] = std::move(array);
    });
  }

  /// Copies the images of one shot. Thread-safe for different shots.
  void store(std::size_t shot, LabelImages& images) const {
    images.for_each([&]<class Texel>(const char* name, const Image<Texel>& image, auto) {
      const auto place = places_.find(name);
      if (place == places_.end()) return;
      if constexpr (std::is_same_v<Texel, glm::u8vec4>) {
        if (!alpha_) return copy_rgb(image.texels(), reinterpret_cast<uint8_t*>(place->second) + shot * 3 * image.texels().size());
      }
      const std::size_t bytes = image.texels().size_bytes();
      std::memcpy(place->second + shot * bytes, image.data(), bytes);
    });
  }

  const py::dict& arrays() const { return arrays_; }

 private:
  template <class Texel>
  struct NumberOf {
    using type = Texel;
  };
  template <class Texel>
  requires requires { typename Texel::value_type; }
  struct NumberOf<Texel> {
    using type = typename Texel::value_type;
  };
  template <class Texel>
  using Number = typename NumberOf<Texel>::type;

  bool alpha_;
  py::dict arrays_;
  std::map<std::string, std::byte*> places_;
};

py::dict label_batch(SceneCore& scene, int width, int height, const std::vector<double>& times,
                     const std::vector<CameraDescription*>& cameras, const Names& names, float background_depth, bool alpha,
                     const py::object& progress) {
  const PictureSize size{width, height};
  const Wanted wanted{names, background_depth, alpha};
  std::vector<Shot> shots;
  for (std::size_t i = 0; i < times.size(); ++i) shots.push_back(wanted.shot(times[i], cameras[i]));
  const std::size_t pixel = LabelImages().pixel_bytes(names);
  return with_memory(size, pixel * (shots.size() + scene.images_at_once(shots.size())), [&] {
    const LabelArrays arrays(wanted, shots.size(), size);
    std::atomic<std::size_t> finished = 0;
    {
      const py::gil_scoped_release release;
      scene.for_each_shot(shots, size, [&](std::size_t i, const PreparedScene& prepared, const Workers& workers) {
        LabelImages images;
        render_labels(images, wanted, size, prepared, workers);
        arrays.store(i, images);
        report(progress, ++finished, shots.size());
      });
    }
    return arrays.arrays();
  });
}

}  // namespace

void bind_labels(py::module_& m) {
  m.def("labels", &labels);
  m.def("label_batch", &label_batch);
  m.attr("no_id") = kNoId;
}

}  // namespace halfspace::python
