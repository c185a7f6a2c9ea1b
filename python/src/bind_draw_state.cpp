// SPDX-License-Identifier: Apache-2.0
//
// The state of a draw call. Enumerations have the names of raster/draw_state.h.
#include <initializer_list>

#include "bindings.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/target.h"

namespace halfspace::python {

namespace {

/// Binds an enumeration whose values are 0, 1, 2, ... in the order of the names.
template <class E>
void bind_enum(py::module_& m, const char* type, std::initializer_list<const char*> names) {
  py::enum_<E> bound(m, type);
  int value = 0;
  for (const char* name : names) bound.value(name, static_cast<E>(value++));
}

void bind_enums(py::module_& m) {
  bind_enum<Topology>(m, "DrawTopology", {"triangles", "triangle_strip", "triangle_fan", "points", "lines", "line_strip", "line_loop"});
  bind_enum<PolygonMode>(m, "PolygonMode", {"fill", "line", "point"});
  bind_enum<CompareOp>(m, "CompareOp", {"never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"});
  bind_enum<CullMode>(m, "CullMode", {"none", "front", "back", "front_and_back"});
  bind_enum<Winding>(m, "Winding", {"counter_clockwise", "clockwise"});
  bind_enum<ProvokingVertex>(m, "ProvokingVertex", {"last", "first"});
  bind_enum<ClipDepth>(m, "ClipDepth", {"negative_one_to_one", "zero_to_one"});
  bind_enum<ClipOrigin>(m, "ClipOrigin", {"lower_left", "upper_left"});
  bind_enum<PointOrigin>(m, "PointOrigin", {"upper_left", "lower_left"});
  bind_enum<BlendFactor>(m, "BlendFactor",
                         {"zero", "one", "src_color", "one_minus_src_color", "dst_color", "one_minus_dst_color", "src_alpha",
                          "one_minus_src_alpha", "dst_alpha", "one_minus_dst_alpha", "constant_color", "one_minus_constant_color",
                          "constant_alpha", "one_minus_constant_alpha", "src_alpha_saturate"});
  bind_enum<BlendEquation>(m, "BlendEquation", {"add", "subtract", "reverse_subtract", "min", "max"});
  bind_enum<StencilOp>(m, "StencilOp",
                       {"keep", "zero", "replace", "increment_clamp", "decrement_clamp", "invert", "increment_wrap", "decrement_wrap"});
  py::enum_<TexelFormat> formats(m, "TexelFormat");
  for (std::size_t i = 0; i < kTexelFormats; ++i) {
    const auto format = static_cast<TexelFormat>(i);
    formats.value(texel_info(format).name.data(), format);
  }
}

void bind_structs(py::module_& m) {
  py::class_<Rect>(m, "Rect").def(py::init([](int x, int y, int width, int height) { return Rect{x, y, width, height}; }));
  py::class_<ViewportRect>(m, "ViewportRect").def(py::init<float, float, float, float>());
  py::class_<BlendState>(m, "BlendState")
      .def(py::init<>())
      .def_readwrite("color_equation", &BlendState::color_equation)
      .def_readwrite("source_color", &BlendState::source_color)
      .def_readwrite("destination_color", &BlendState::destination_color)
      .def_readwrite("alpha_equation", &BlendState::alpha_equation)
      .def_readwrite("source_alpha", &BlendState::source_alpha)
      .def_readwrite("destination_alpha", &BlendState::destination_alpha)
      .def("set_constant", [](BlendState& self, float r, float g, float b, float a) {
        self.constant = {r, g, b, a};
      });
  py::class_<StencilFace>(m, "StencilFace")
      .def(py::init<>())
      .def_readwrite("compare", &StencilFace::compare)
      .def_readwrite("fail", &StencilFace::fail)
      .def_readwrite("depth_fail", &StencilFace::depth_fail)
      .def_readwrite("pass_", &StencilFace::pass)
      .def_readwrite("reference", &StencilFace::reference)
      .def_readwrite("read_mask", &StencilFace::read_mask)
      .def_readwrite("write_mask", &StencilFace::write_mask);
}

void bind_depth(py::class_<DrawState>& state) {
  state
      .def("set_depth", [](DrawState& self, bool test, bool write, CompareOp compare, ClipDepth clip, bool clamp, float range_near,
                           float range_far) { self.depth = {test, write, compare, clip, clamp, range_near, range_far}; })
      .def("set_offset", [](DrawState& self, float slope, float constant, float clamp, bool fill, bool outlines,
                            bool corners) { self.offset = {slope, constant, clamp, fill, outlines, corners}; })
      .def("set_stencil",
           [](DrawState& self, const StencilFace& front, const StencilFace& back) {
             self.stencil = StencilState{front, back};
           })
      .def("set_color_mask", [](DrawState& self, bool r, bool g, bool b, bool a) {
        self.color_mask = {r, g, b, a};
      });
}

}  // namespace

void bind_draw_state(py::module_& m) {
  bind_enums(m);
  bind_structs(m);
  py::class_<DrawState> state(m, "DrawState");
  state.def(py::init<>())
      .def_readwrite("topology", &DrawState::topology)
      .def_readwrite("base_vertex", &DrawState::base_vertex)
      .def_readwrite("point_size", &DrawState::point_size)
      .def_readwrite("point_origin", &DrawState::point_origin)
      .def_readwrite("line_width", &DrawState::line_width)
      .def_readwrite("polygon_mode", &DrawState::polygon_mode)
      .def_readwrite("viewport", &DrawState::viewport)
      .def_readwrite("clip_origin", &DrawState::clip_origin)
      .def_readwrite("scissor", &DrawState::scissor)
      .def_readwrite("cull", &DrawState::cull)
      .def_readwrite("front", &DrawState::front)
      .def_readwrite("provoking", &DrawState::provoking)
      .def_readwrite("sample_shading", &DrawState::sample_shading)
      .def_readwrite("alpha_to_coverage", &DrawState::alpha_to_coverage)
      .def_readwrite("sample_mask", &DrawState::sample_mask)
      .def_readwrite("order_independent", &DrawState::order_independent)
      .def_readwrite("blend", &DrawState::blend)
      .def_readwrite("query", &DrawState::query);
  bind_depth(state);
}

}  // namespace halfspace::python
