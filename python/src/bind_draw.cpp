// SPDX-License-Identifier: Apache-2.0
//
// Passes that draw arrays with the shaders of the library.
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bindings.h"
#include "draw_shader.h"
#include "halfspace/core/parallel.h"
#include "halfspace/render/frame/add_draw.h"
#include "signals.h"

namespace halfspace::python {

namespace {

/// A draw, and the objects that keep its arrays alive.
struct Draw {
  Shader shader;
  VertexView vertices;
  std::shared_ptr<const Indices> indices;
  DrawState state;
  std::vector<py::object> arrays;

  void add_to(Pass& pass) const {
    const auto add = [&]<class S>(const S& chosen) {
      if constexpr (std::is_same_v<S, SceneShader>) {
        add_draw(pass, {chosen, vertices, indices, state}, state);
      } else {
        pass.draw_depth(chosen, vertices, *indices, state);
      }
    };
    std::visit(add, shader.shader);
  }
};

class ArrayPass {
 public:
  /// color and depth: arrays of width x height pixels in the format, or None.
  ArrayPass(int width, int height, ColorFormat color_format, py::object color, DepthFormat depth_format, py::object depth, int samples)
      : width_(width), height_(height), samples_(samples), color_(std::move(color)), depth_(std::move(depth)) {
    color_target_.format = color_format;
    color_target_.data = data_of(color_);
    color_target_.width = width, color_target_.height = height;
    color_target_.store = color_.is_none() ? StoreOp::dont_care : StoreOp::store;
    depth_target_.format = depth_format;
    depth_target_.data = data_of(depth_);
    depth_target_.width = width, depth_target_.height = height;
    depth_target_.store = depth_.is_none() ? StoreOp::dont_care : StoreOp::store;
  }

  void set_load(bool load, const std::array<float, 4>& clear_color, float clear_depth, uint8_t clear_stencil) {
    color_target_.load = load ? LoadOp::load : LoadOp::clear;
    depth_target_.load = load && depth_target_.data != nullptr ? LoadOp::load : LoadOp::clear;
    color_target_.clear_value = {clear_color[0], clear_color[1], clear_color[2], clear_color[3]};
    depth_target_.clear_value = clear_depth;
    depth_target_.stencil_clear_value = clear_stencil;
  }

  /// divisors: for each stream, 0 for one row per vertex or 1 for one row per instance.
  void draw(const Shader& shader, const std::vector<Array<float>>& streams, const std::vector<uint32_t>& divisors,
            const std::optional<Array<uint32_t>>& indices, const DrawState& state, uint32_t instances) {
    std::array<VertexStream, kMaxStreams> list;
    std::vector<py::object> kept;
    for (std::size_t i = 0; i < streams.size(); ++i) {
      const auto n = static_cast<int32_t>(streams[i].shape(1));
      list.at(i) = {reinterpret_cast<const std::byte*>(streams[i].data()), n * static_cast<int32_t>(sizeof(float)), n,
                    static_cast<std::size_t>(streams[i].shape(0)), divisors.at(i)};
      kept.push_back(streams[i]);
    }
    const VertexView view = detail::bind_streams(std::span(list).first(streams.size()));
    std::shared_ptr<const Indices> order;
    if (indices) {
      order = std::make_shared<const Indices>(std::span(indices->data(), static_cast<std::size_t>(indices->size())), view.vertex_count);
      kept.push_back(*indices);
    } else {
      order = std::make_shared<const Indices>(Indices::sequential(view.vertex_count));
    }
    draws_.push_back({shader, view, std::move(order), state, std::move(kept)});
    draws_.back().state.instances = instances;
  }

  /// Returns the number of draws and the results of the occlusion queries.
  std::pair<std::size_t, std::vector<uint64_t>> run(int threads) {
    PassStatistics statistics;
    const std::vector<Draw> draws = std::exchange(draws_, {});
    try {
      const py::gil_scoped_release release;
      Pass pass(width_, height_, color_target_, depth_target_, {.samples = samples_});
      for (const Draw& d : draws) d.add_to(pass);
      statistics = pass.run(Workers(threads, check_signals));
    } catch (const std::logic_error& e) {  // a failed check
      throw InputError(std::string("pass: the draws are invalid (") + e.what() + ")");
    }
    return {draws.size(), statistics.queries};
  }

 private:
  static std::byte* data_of(const py::object& array) {
    return array.is_none() ? nullptr : static_cast<std::byte*>(array.cast<py::array>().mutable_data());
  }

  int width_, height_, samples_;
  py::object color_, depth_;
  ColorTarget color_target_;
  DepthTarget depth_target_;
  std::vector<Draw> draws_;
};

}  // namespace

void bind_draw(py::module_& m) {
  bind_shaders(m);
  py::class_<ArrayPass>(m, "Pass")
      .def(py::init<int, int, ColorFormat, py::object, DepthFormat, py::object, int>())
      .def("set_load", &ArrayPass::set_load)
      .def("draw", &ArrayPass::draw)
      .def("run", &ArrayPass::run);
}

}  // namespace halfspace::python
