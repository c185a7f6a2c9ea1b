// SPDX-License-Identifier: Apache-2.0
#include "explain/page_history.h"

#include <algorithm>
#include <array>
#include <map>

#include "explain/history_text.h"
#include "explain/page_encode.h"

namespace halfspace {

namespace {

constexpr int kDetailSide = 64, kDetailStep = 8;
constexpr int kMaxCompletePixels = 320 * 180;

// The example pixel, the block around it, and the grid.
constexpr std::size_t kDetailGroups = 3;

struct PixelBlock {
  int x0, y0;
  bool contains(glm::ivec2 p) const { return p.x >= x0 && p.x < x0 + kDetailSide && p.y >= y0 && p.y < y0 + kDetailSide; }
};

PixelBlock detailed_block(int width, int height, glm::ivec2 center) {
  return {std::clamp(center.x - kDetailSide / 2, 0, std::max(0, width - kDetailSide)),
          std::clamp(center.y - kDetailSide / 2, 0, std::max(0, height - kDetailSide))};
}

// The columns of a table of fragments.
struct FragmentColumns {
  std::vector<uint16_t> draw;
  std::vector<uint32_t> instance, primitive;
  std::vector<uint8_t> index, sample, outcome;  // index: of the fragment among the traced fragments of its pixel
  std::vector<float> depth;

  void add(const TracedFragment& f, uint32_t number) {
    index.push_back(static_cast<uint8_t>(number));
    draw.push_back(static_cast<uint16_t>(f.draw));
    instance.push_back(f.instance);
    primitive.push_back(f.primitive);
    sample.push_back(f.sample);
    outcome.push_back(static_cast<uint8_t>(f.outcome));
    depth.push_back(f.depth);
  }
  PageJson json() const {
    return {{"count", draw.size()},
            {"index", packed_planes(std::span<const uint8_t>(index))},
            {"draw", packed_planes(std::span<const uint16_t>(draw))},
            {"instance", packed_planes(std::span<const uint32_t>(instance))},
            {"primitive", packed_planes(std::span<const uint32_t>(primitive))},
            {"sample", packed_planes(std::span<const uint8_t>(sample))},
            {"outcome", packed_planes(std::span<const uint8_t>(outcome))},
            {"depth", packed_planes(std::span<const float>(depth))}};
  }
};

// Stores all values of some fragments. The names of the values are stored once per shader.
class Details {
 public:
  void add(const PixelHistory& h, uint32_t max_fragments) {
    std::vector<TracedFragment> traced;
    for (const FragmentDetail& f : h.fragments) traced.push_back(f.fragment);
    const std::vector<uint32_t> kept = kept_fragments(traced, max_fragments);
    pixels_.push_back(static_cast<uint32_t>(h.pixel.x) | static_cast<uint32_t>(h.pixel.y) << 16);
    counts_.push_back(static_cast<uint8_t>(kept.size()));
    add_display(h);
    for (const uint32_t i : kept) {
      index_.push_back(static_cast<uint8_t>(i));
      add_fragment(h.fragments[i]);
    }
  }

  PageJson json() const {
    return {{"pixels", pixels_.size()},
            {"place", packed_planes(std::span<const uint32_t>(pixels_))},
            {"counts", packed_planes(std::span<const uint8_t>(counts_))},
            {"kinds", kinds_},
            {"fragments", kind_.size()},
            {"index", packed_planes(std::span<const uint8_t>(index_))},
            {"kind", packed_planes(std::span<const uint16_t>(kind_))},
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
    values_.insert(values_.end(), {t.tested_depth, t.stored_depth, t.is_tested ? 1.0f : 0.0f, t.is_shaded ? 1.0f : 0.0f});
    put(f.barycentrics);
    values_.push_back(f.inv_w);
    put(f.color);
    put(t.value);
    PageJson kind{{"shader", f.shader}, {"blend", f.blend}, {"front", f.is_front}};
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

  std::vector<uint32_t> pixels_;
  std::vector<uint8_t> counts_;
  std::vector<uint8_t> index_;  // of each fragment among the fragments of its pixel
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

// A set of pixels for which the page stores the values of the same number of fragments.
using PixelGroup = std::vector<const PixelHistory*>;

std::size_t numbers_of(const PixelGroup& group, uint32_t most) {
  std::size_t numbers = 0;
  for (const PixelHistory* h : group) {
    const std::size_t n = std::min<std::size_t>(h->fragments.size(), most);
    for (std::size_t i = 0; i < n; ++i) numbers += numbers_of(h->fragments[i]);
  }
  return numbers;
}

// Returns the number of fragments per pixel whose values are stored, for the example pixel, the block around it, and the grid. The groups
// share the budget in this order, but at least one fragment per pixel is stored.
std::array<uint32_t, kDetailGroups> details_per_pixel(const std::array<PixelGroup, kDetailGroups>& groups, std::size_t budget) {
  std::array<uint32_t, kDetailGroups> out{};
  std::size_t used = 0;
  for (const PixelGroup& group : groups) used += numbers_of(group, 1);
  for (std::size_t i = 0; i < kDetailGroups; ++i) {
    used -= numbers_of(groups[i], 1);
    uint32_t most = FrameTrace::kMaxFragments;
    while (most > 1 && used + numbers_of(groups[i], most) > budget) --most;
    used += numbers_of(groups[i], most);
    out[i] = most;
  }
  return out;
}

PageJson details_json(const PageInput& in, const FrameTrace& trace, std::span<const glm::ivec2> pixels) {
  const std::vector<PixelHistory> histories = pixel_histories(in.description, in.scene, trace, pixels, in.workers);
  const PixelBlock block = detailed_block(trace.width, trace.height, in.pixel);
  const auto group_of = [&](glm::ivec2 p) { return p == in.pixel ? 0u : block.contains(p) ? 1u : 2u; };
  std::array<PixelGroup, kDetailGroups> groups;
  for (const PixelHistory& h : histories) groups[group_of(h.pixel)].push_back(&h);
  const std::array<uint32_t, kDetailGroups> most = details_per_pixel(groups, kMaxPageValues);
  Details details;
  for (const PixelHistory& h : histories) details.add(h, most[group_of(h.pixel)]);
  PageJson json = details.json();
  json["most"] = most;
  return json;
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
  const PixelBlock block = detailed_block(width, height, center);
  std::vector<glm::ivec2> pixels;
  const bool all = width * height <= kMaxCompletePixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_example = x == center.x && y == center.y;
      if (all || is_example || block.contains({x, y}) || (x % kDetailStep == 0 && y % kDetailStep == 0)) pixels.emplace_back(x, y);
    }
  }
  return pixels;
}

PageJson histories_json(const PageInput& in, const FrameTrace& trace) {
  const uint32_t most = fragments_per_pixel(trace, kMaxPageFragments);
  const std::vector<glm::ivec2> detailed = detailed_pixels(trace.width, trace.height, in.pixel);
  FragmentColumns columns;
  std::vector<uint8_t> counts;
  std::vector<uint32_t> others;
  auto next = detailed.begin();
  for (int y = 0; y < trace.height; ++y) {
    for (int x = 0; x < trace.width; ++x) {
      const std::span<const TracedFragment> fragments = trace.at({x, y});
      const bool is_detailed = next != detailed.end() && *next == glm::ivec2(x, y);
      if (is_detailed) ++next;
      const std::vector<uint32_t> kept = kept_fragments(fragments, is_detailed ? FrameTrace::kMaxFragments : most);
      for (const uint32_t i : kept) columns.add(fragments[i], i);
      counts.push_back(static_cast<uint8_t>(kept.size()));
      others.push_back(trace.count({x, y}) - static_cast<uint32_t>(kept.size()));
    }
  }
  PageJson outcomes = PageJson::array();
  for (std::size_t i = 0; i < kFragmentOutcomes; ++i) outcomes.push_back(outcome_text(static_cast<FragmentOutcome>(i)));
  return {{"most", most},
          {"stored_as", storage_text(trace.format)},
          {"outcomes", outcomes},
          {"counts", packed_planes(std::span<const uint8_t>(counts))},
          {"others", packed_planes(std::span<const uint32_t>(others))},
          {"fragments", columns.json()},
          {"details", details_json(in, trace, detailed)}};
}

}  // namespace halfspace
