// SPDX-License-Identifier: Apache-2.0
#include "halfspace/explain/page_history.h"

#include <algorithm>
#include <map>

#include "halfspace/explain/page_encode.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

constexpr int kDetailSide = 64, kDetailStep = 8;

// The columns of a table of fragments.
struct FragmentColumns {
  std::vector<uint16_t> draw;
  std::vector<uint32_t> instance, primitive;
  std::vector<uint8_t> sample, outcome;
  std::vector<float> depth;

  void add(const TracedFragment& f) {
    draw.push_back(static_cast<uint16_t>(f.draw));
    instance.push_back(f.instance);
    primitive.push_back(f.primitive);
    sample.push_back(f.sample);
    outcome.push_back(static_cast<uint8_t>(f.outcome));
    depth.push_back(f.depth);
  }
  PageJson json() const {
    return {{"count", draw.size()},
            {"draw", packed_planes(std::span<const uint16_t>(draw))},
            {"instance", packed_planes(std::span<const uint32_t>(instance))},
            {"primitive", packed_planes(std::span<const uint32_t>(primitive))},
            {"sample", packed_planes(std::span<const uint8_t>(sample))},
            {"outcome", packed_planes(std::span<const uint8_t>(outcome))},
            {"depth", packed_planes(std::span<const float>(depth))}};
  }
};

// Stores all values of some pixels. The names of the values are stored once per shader.
class Details {
 public:
  void add(const PixelHistory& h, uint32_t max_fragments) {
    std::vector<TracedFragment> traced;
    for (const FragmentDetail& f : h.fragments) traced.push_back(f.fragment);
    const std::vector<uint32_t> kept = kept_fragments(traced, max_fragments);
    pixels_.push_back(static_cast<uint32_t>(h.pixel.x) | static_cast<uint32_t>(h.pixel.y) << 16);
    counts_.push_back(static_cast<uint8_t>(kept.size()));
    others_.push_back(h.others + static_cast<uint32_t>(h.fragments.size() - kept.size()));
    add_display(h);
    for (const uint32_t i : kept) add_fragment(h.fragments[i]);
  }

  PageJson json() const {
    return {{"pixels", pixels_.size()},
            {"place", packed_planes(std::span<const uint32_t>(pixels_))},
            {"counts", packed_planes(std::span<const uint8_t>(counts_))},
            {"others", packed_planes(std::span<const uint32_t>(others_))},
            {"kinds", kinds_},
            {"kind", packed_planes(std::span<const uint16_t>(kind_))},
            {"fragments", columns_.json()},
            {"numbers", values_.size()},
            {"values", packed_planes(std::span<const float>(values_))}};
  }

 private:
  void put(const glm::vec4& v) { values_.insert(values_.end(), {v.x, v.y, v.z, v.w}); }
  void put(const glm::vec3& v) { values_.insert(values_.end(), {v.x, v.y, v.z}); }

  void add_display(const PixelHistory& h) {
    put(h.clear_color);
    for (const glm::vec4& s : h.samples) put(s);
    put(h.display.light);
    values_.push_back(h.display.exposure);
    put(h.display.tone_mapped);
    put(glm::vec4(h.display.code));
  }

  void add_fragment(const FragmentDetail& f) {
    const TracedFragment& t = f.fragment;
    columns_.add(t);
    values_.insert(values_.end(), {t.tested_depth, t.stored_depth, t.is_tested ? 1.0f : 0.0f, t.is_shaded ? 1.0f : 0.0f});
    put(f.barycentrics);
    values_.push_back(f.inv_w);
    put(f.color);
    put(t.value);
    PageJson kind{{"object", f.object}, {"copy", f.copy}, {"shader", f.shader}, {"blend", f.blend}};
    const auto put_all = [&](const char* key, const std::vector<NamedValue>& list) {
      kind[key] = PageJson::array();
      for (const NamedValue& v : list) {
        kind[key].push_back({v.name, v.values.size()});
        values_.insert(values_.end(), v.values.begin(), v.values.end());
      }
    };
    put_all("varyings", f.varyings);
    put_all("terms", f.terms);
    put_all("factors", f.factors);
    kind_.push_back(kind_of(kind));
  }

  uint16_t kind_of(const PageJson& kind) {
    const auto [found, is_new] = ids_.emplace(kind.dump(), static_cast<uint16_t>(ids_.size()));
    if (is_new) kinds_.push_back(kind);
    return found->second;
  }

  std::vector<uint32_t> pixels_, others_;
  std::vector<uint8_t> counts_;
  FragmentColumns columns_;
  std::vector<uint16_t> kind_;
  std::vector<float> values_;
  PageJson kinds_ = PageJson::array();
  std::map<std::string, uint16_t> ids_;
};

std::size_t numbers_of(const FragmentDetail& f) {
  std::size_t n = 16;
  for (const std::vector<NamedValue>* list : {&f.varyings, &f.terms, &f.factors}) {
    for (const NamedValue& v : *list) n += v.values.size();
  }
  return n;
}

// Returns the number of fragments per pixel that the page can store with all values.
uint32_t details_per_pixel(const std::vector<PixelHistory>& histories) {
  for (uint32_t max_fragments = FrameTrace::kMaxFragments; max_fragments > 1; max_fragments /= 2) {
    std::size_t numbers = 0;
    for (const PixelHistory& h : histories) {
      const std::size_t n = std::min<std::size_t>(h.fragments.size(), max_fragments);
      for (std::size_t i = 0; i < n; ++i) numbers += numbers_of(h.fragments[i]);
    }
    if (numbers <= kMaxPageValues) return max_fragments;
  }
  return 1;
}

PageJson details_json(const PageInput& in, const FrameTrace& trace) {
  const std::vector<glm::ivec2> pixels = detailed_pixels(trace.width, trace.height, in.pixel);
  const std::vector<PixelHistory> histories = pixel_histories(in.description, in.scene, trace, pixels, in.workers);
  const uint32_t max_fragments = details_per_pixel(histories);
  Details details;
  for (const PixelHistory& h : histories) details.add(h, max_fragments);
  return details.json();
}

}  // namespace

uint32_t fragments_per_pixel(const FrameTrace& trace, std::size_t max_fragments) {
  for (uint32_t limit = FrameTrace::kMaxFragments; limit > 1; --limit) {
    std::size_t sum = 0;
    for (std::size_t i = 0; i + 1 < trace.first.size(); ++i) sum += std::min(trace.first[i + 1] - trace.first[i], limit);
    if (sum <= max_fragments) return limit;
  }
  return 1;
}

std::vector<uint32_t> kept_fragments(std::span<const TracedFragment> fragments, uint32_t max_fragments) {
  std::vector<uint32_t> kept;
  for (const bool shaded : {true, false}) {
    for (uint32_t i = 0; i < fragments.size() && kept.size() < max_fragments; ++i) {
      if (fragments[i].is_shaded == shaded) kept.push_back(i);
    }
  }
  std::ranges::sort(kept);
  return kept;
}

std::vector<glm::ivec2> detailed_pixels(int width, int height, glm::ivec2 center) {
  const int x0 = std::clamp(center.x - kDetailSide / 2, 0, std::max(0, width - kDetailSide));
  const int y0 = std::clamp(center.y - kDetailSide / 2, 0, std::max(0, height - kDetailSide));
  std::vector<glm::ivec2> pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool near = x >= x0 && x < x0 + kDetailSide && y >= y0 && y < y0 + kDetailSide;
      if (near || (x % kDetailStep == 0 && y % kDetailStep == 0)) pixels.emplace_back(x, y);
    }
  }
  return pixels;
}

PageJson histories_json(const PageInput& in, const FrameTrace& trace) {
  const uint32_t max_fragments = fragments_per_pixel(trace, kMaxPageFragments);
  FragmentColumns columns;
  std::vector<uint8_t> counts;
  std::vector<uint32_t> others;
  for (int y = 0; y < trace.height; ++y) {
    for (int x = 0; x < trace.width; ++x) {
      const std::span<const TracedFragment> fragments = trace.at({x, y});
      const std::vector<uint32_t> kept = kept_fragments(fragments, max_fragments);
      for (const uint32_t i : kept) columns.add(fragments[i]);
      counts.push_back(static_cast<uint8_t>(kept.size()));
      others.push_back(trace.count({x, y}) - static_cast<uint32_t>(kept.size()));
    }
  }
  PageJson outcomes = PageJson::array();
  for (std::size_t i = 0; i < kFragmentOutcomes; ++i) outcomes.push_back(outcome_text(static_cast<FragmentOutcome>(i)));
  return {{"most", max_fragments},
          {"outcomes", outcomes},
          {"counts", packed_planes(std::span<const uint8_t>(counts))},
          {"others", packed_planes(std::span<const uint32_t>(others))},
          {"fragments", columns.json()},
          {"details", details_json(in, trace)}};
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
