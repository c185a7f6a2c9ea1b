// SPDX-License-Identifier: Apache-2.0
#include "explain/history_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace halfspace {

namespace {

const char* primitive_text(Topology topology) {
  if (topology == Topology::points) return "point";
  return is_lines(topology) ? "line" : "triangle";
}

std::string number_text(float x) { return fmt::format("{:.6g}", x); }

// Formats numbers as columns.
std::string columns_text(const float* values, std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) out += fmt::format("{:>13}", number_text(values[i]));
  return out;
}
std::string color_text(const glm::vec4& c) { return columns_text(&c.x, 3); }

std::string row_text(const std::string& name, const std::string& values, const std::string& note = {}) {
  return fmt::format("     {:<28}{}{}\n", name, values, note.empty() ? note : fmt::format("   {}", note));
}

std::string alpha_text(const glm::vec4& c) { return c.w == 1.0f ? std::string() : fmt::format("alpha {}", number_text(c.w)); }

// Returns how depths were compared, for example "depth 0.5, compared with the stored depth 0.4".
std::string depth_text(const TracedFragment& f, const char* primitive) {
  if (!f.is_tested) return fmt::format("depth {}, not tested", number_text(f.depth));
  const std::string depth = number_text(f.depth), stored = number_text(f.stored_depth);
  if (f.outcome > FragmentOutcome::block_rejected) return fmt::format("depth {}, compared with the stored depth {}", depth, stored);
  return fmt::format("depth {}; nearest depth of the {} {}, compared with the farthest depth in the {} {}", depth, primitive,
                     number_text(f.tested_depth), f.outcome == FragmentOutcome::tile_rejected ? "tile" : "block", stored);
}

std::string outcome_sentence(FragmentOutcome outcome, const char* primitive) {
  switch (outcome) {
    case FragmentOutcome::tile_rejected: return fmt::format("rejected with its tile, in which the {} cannot be visible", primitive);
    case FragmentOutcome::block_rejected:
      return fmt::format("rejected with its block of 8x8 pixels, in which the {} cannot be visible", primitive);
    case FragmentOutcome::depth_failed: return "failed the depth test";
    case FragmentOutcome::stencil_failed: return "failed the stencil test";
    case FragmentOutcome::discarded: return "discarded by the shader";
    case FragmentOutcome::hidden_before_shading: return "passed, but was hidden by a later fragment before it was shaded";
    case FragmentOutcome::depth_only: return "passed and wrote its depth";
    case FragmentOutcome::shaded: return "shaded; its color replaced the stored one";
    case FragmentOutcome::blended: return "shaded and blended";
    case FragmentOutcome::layered: return "shaded and kept as a transparent layer";
    case FragmentOutcome::layer_merged:
      return "shaded and kept as a transparent layer; the sample had too many layers, so its two farthest were merged";
  }
  return "";
}

std::string outcome_line(const FragmentDetail& d, int samples) {
  const TracedFragment& f = d.fragment;
  const char* primitive = primitive_text(d.topology);
  const std::string sample = samples == 1 ? std::string() : fmt::format("sample {}: ", f.sample);
  return fmt::format("   {}{}\n     {}\n", sample, outcome_sentence(f.outcome, primitive), depth_text(f, primitive));
}

// Returns why a light has no effect, or an empty string.
std::string darkness_text(const FragmentDetail& d, const NamedValue& term) {
  constexpr std::string_view prefix = "diffuse, light ";
  if (!term.name.starts_with(prefix) || std::ranges::any_of(term.values, [](float x) { return x != 0.0f; })) return {};
  const std::string shadow = fmt::format("shadow, light {}", term.name.substr(prefix.size()));
  const bool shadowed = std::ranges::any_of(d.factors, [&](const NamedValue& v) { return v.name == shadow && v.values[0] == 0.0f; });
  return shadowed ? "in shadow" : "the surface faces away from the light or has no diffuse reflection";
}

std::string values_text(const std::vector<NamedValue>& values) {
  std::string out;
  for (const NamedValue& v : values) out += row_text(v.name, columns_text(v.values.data(), v.values.size()));
  return out;
}

std::string shader_text(const FragmentDetail& d) {
  std::string out = fmt::format("   shader: {}{}\n", d.shader, d.fragment.is_shaded ? "" : " (not shaded in this frame)");
  const bool is_outside = d.barycentrics.x < 0.0f || d.barycentrics.y < 0.0f || d.barycentrics.z < 0.0f;
  out += row_text("weights of the vertices", columns_text(&d.barycentrics.x, 3),
                  is_outside ? "evaluated at the pixel center, which is outside the triangle" : "");
  out += row_text("1/w", columns_text(&d.inv_w, 1));
  out += values_text(d.varyings);
  out += values_text(d.factors);
  if (d.terms.size() > 1) {
    out += "   terms of the linear light\n";
    for (const NamedValue& t : d.terms) out += row_text(t.name, columns_text(t.values.data(), t.values.size()), darkness_text(d, t));
    out += row_text("sum: color", color_text(d.color), alpha_text(d.color));
  } else {
    out += row_text("color", color_text(d.color), alpha_text(d.color));
  }
  if (!d.blend.empty()) out += row_text("blend", fmt::format("  {}", d.blend));
  return out;
}

// Returns true if two fragments are samples of the same primitive with the same color. The text shows such fragments together.
bool shows_same(const FragmentDetail& a, const FragmentDetail& b) {
  return a.fragment.draw == b.fragment.draw && a.fragment.id == b.fragment.id && a.fragment.round == b.fragment.round &&
         a.fragment.is_shaded == b.fragment.is_shaded && a.color == b.color && a.barycentrics == b.barycentrics;
}

std::string fragments_text(std::size_t number, std::span<const FragmentDetail> same, int samples) {
  const FragmentDetail& d = same.front();
  const TracedFragment& f = d.fragment;
  const std::string copy = d.copy == 0 ? std::string() : fmt::format(", copy {}", d.copy);
  const std::string instance = f.instance == 0 ? std::string() : fmt::format(", instance {}", f.instance);
  const std::string numbers = same.size() == 1 ? fmt::format("{}", number) : fmt::format("{}-{}", number, number + same.size() - 1);
  std::string out = fmt::format("{}. {}{}: {} {} of draw {}{}{}\n", numbers, d.object, copy, primitive_text(d.topology), f.primitive,
                                f.draw, instance, d.is_front ? "" : ", seen from behind");
  for (const FragmentDetail& s : same) out += outcome_line(s, samples);
  out += shader_text(d);
  for (const FragmentDetail& s : same) {
    if (s.fragment.outcome < FragmentOutcome::shaded) continue;
    out += row_text(samples == 1 ? "stored color" : fmt::format("stored color of sample {}", s.fragment.sample),
                    color_text(s.fragment.value), alpha_text(s.fragment.value));
  }
  out += '\n';
  return out;
}

std::string result_text(const PixelHistory& h) {
  std::string out = "Result\n";
  for (std::size_t i = 0; h.samples.size() > 1 && i < h.samples.size(); ++i)
    out += row_text(fmt::format("sample {}", i), color_text(h.samples[i]), alpha_text(h.samples[i]));
  const DisplayDetail& d = h.display;
  out += row_text(h.samples.size() > 1 ? "mean of the samples" : "linear light", color_text(d.light), alpha_text(d.light));
  out += row_text("exposure", columns_text(&d.exposure, 1));
  out += row_text("after the tone curve", columns_text(&d.tone_mapped.x, 3));
  out += row_text("value in the picture", fmt::format("{:>13}{:>13}{:>13}", d.code.x, d.code.y, d.code.z),
                  d.code.w == 255 ? std::string() : fmt::format("alpha {}", d.code.w));
  return out;
}

}  // namespace

const char* storage_text(ColorFormat format) {
  if (format == ColorFormat::srgb8a8) return "8-bit sRGB values";
  return format == ColorFormat::rgba16f ? "half floats" : "floats";
}

std::string history_text(const std::string& title, const PixelHistory& h, const FrameTrace& trace) {
  std::string out = fmt::format("{}, {}x{}, pixel {},{} from the upper left (GL window coordinates {}, {})\n", title, trace.width,
                                trace.height, h.pixel.x, h.pixel.y, h.window.x, h.window.y);
  const auto total = h.fragments.size() + h.others;
  out += fmt::format("{} fragment{} in submission order; depth 1 is near and 0 is far\n", total, total == 1 ? "" : "s");
  out += fmt::format("colors are stored as {}\n", storage_text(trace.format));
  if (trace.samples > 1) out += fmt::format("{} samples per pixel; each sample of a triangle is a fragment\n", trace.samples);
  out += fmt::format("\n{}\n", row_text("clear color", color_text(h.clear_color), alpha_text(h.clear_color)));
  for (std::size_t begin = 0; begin < h.fragments.size();) {
    std::size_t end = begin + 1;
    while (end < h.fragments.size() && shows_same(h.fragments[begin], h.fragments[end])) ++end;
    out += fragments_text(begin + 1, std::span(h.fragments).subspan(begin, end - begin), trace.samples);
    begin = end;
  }
  if (h.others != 0) out += fmt::format("{} more fragments are not listed.\n\n", h.others);
  return out + result_text(h);
}

}  // namespace halfspace
