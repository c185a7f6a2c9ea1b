// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "explain/history_text.h"

namespace halfspace {

namespace {

using OrderedJson = nlohmann::ordered_json;

// Returns a number with the fewest decimal digits that identify the float.
OrderedJson number_json(float x) { return std::strtod(fmt::format("{}", x).c_str(), nullptr); }

template <int n>
OrderedJson vector_json(const glm::vec<n, float>& v) {
  OrderedJson out = OrderedJson::array();
  for (int i = 0; i < n; ++i) out.push_back(number_json(v[i]));
  return out;
}

OrderedJson values_json(const std::vector<NamedValue>& values) {
  OrderedJson out = OrderedJson::object();
  for (const NamedValue& v : values) {
    OrderedJson list = OrderedJson::array();
    for (const float x : v.values) list.push_back(number_json(x));
    out[v.name] = list.size() == 1 ? list[0] : list;
  }
  return out;
}

bool changes_sample(FragmentOutcome outcome) { return outcome >= FragmentOutcome::shaded; }

OrderedJson fragment_json(const FragmentDetail& d) {
  const TracedFragment& f = d.fragment;
  OrderedJson out = {{"draw", f.draw},
                     {"object", d.object},
                     {"copy", d.copy},
                     {"instance", f.instance},
                     {"primitive", f.primitive},
                     {"front_facing", d.is_front},
                     {"sample", f.sample},
                     {"outcome", outcome_name(f.outcome)},
                     {"depth", number_json(f.depth)}};
  if (f.is_tested) {
    out["tested_depth"] = number_json(f.tested_depth);
    out["stored_depth"] = number_json(f.stored_depth);
  }
  out["shaded"] = f.is_shaded;
  out["shader"] = d.shader;
  out["barycentrics"] = vector_json(d.barycentrics);
  out["inv_w"] = number_json(d.inv_w);
  out["varyings"] = values_json(d.varyings);
  out["terms"] = values_json(d.terms);
  out["factors"] = values_json(d.factors);
  out["color"] = vector_json(d.color);
  if (!d.blend.empty()) out["blend"] = d.blend;
  if (changes_sample(f.outcome)) out["value"] = vector_json(f.value);
  return out;
}

}  // namespace

std::string history_json(const PixelHistory& h, const FrameTrace& trace) {
  OrderedJson fragments = OrderedJson::array(), samples = OrderedJson::array();
  for (const FragmentDetail& d : h.fragments) fragments.push_back(fragment_json(d));
  for (const glm::vec4& s : h.samples) samples.push_back(vector_json(s));
  const DisplayDetail& d = h.display;
  const OrderedJson out = {{"pixel", {h.pixel.x, h.pixel.y}},
                           {"window", vector_json(h.window)},
                           {"size", {trace.width, trace.height}},
                           {"stored_as", storage_text(trace.format)},
                           {"clear_color", vector_json(h.clear_color)},
                           {"fragments", fragments},
                           {"fragments_left_out", h.others},
                           {"samples", samples},
                           {"light", vector_json(d.light)},
                           {"exposure", number_json(d.exposure)},
                           {"tone_mapped", vector_json(d.tone_mapped)},
                           {"code", {d.code.x, d.code.y, d.code.z, d.code.w}}};
  return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace halfspace
