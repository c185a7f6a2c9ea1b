// SPDX-License-Identifier: Apache-2.0
//
// Cases of logic operations (OpenGL 4.6, section 17.3.9) on the codes of normalized formats and on integers.
#include <cmath>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "conformance/outputs.h"
#include "conformance/shaders.h"

namespace halfspace::conformance {

namespace {

// In the order of LogicOp, with table 17.3: what becomes of a bit of the source s and one of the destination d.
struct Operation {
  const char* name;
  bool (*combine)(bool s, bool d);
};
constexpr Operation kOperations[] = {{"clear", [](bool, bool) { return false; }},
                                     {"and", [](bool s, bool d) { return s && d; }},
                                     {"and_reverse", [](bool s, bool d) { return s && !d; }},
                                     {"copy", [](bool s, bool) { return s; }},
                                     {"and_inverted", [](bool s, bool d) { return !s && d; }},
                                     {"noop", [](bool, bool d) { return d; }},
                                     {"xor", [](bool s, bool d) { return s != d; }},
                                     {"or", [](bool s, bool d) { return s || d; }},
                                     {"nor", [](bool s, bool d) { return !(s || d); }},
                                     {"equiv", [](bool s, bool d) { return s == d; }},
                                     {"invert", [](bool, bool d) { return !d; }},
                                     {"or_reverse", [](bool s, bool d) { return s || !d; }},
                                     {"copy_inverted", [](bool s, bool) { return !s; }},
                                     {"or_inverted", [](bool s, bool d) { return !s || d; }},
                                     {"nand", [](bool s, bool d) { return !(s && d); }},
                                     {"set", [](bool, bool) { return true; }}};

// Sources are drawn over destinations, farther to the right and upwards.
constexpr int kRight = 3, kUp = 2;

// Rounds the colors to codes, so that the operation combines the same codes in all renderers.
void use_codes(ColorFormat format, Drawing& d) {
  for (Vertex& v : d.vertices) {
    for (int k = 0; k < texel_info(format).channels; ++k) {
      const float largest = std::ldexp(1.0f, channel_bits(format, k)) - 1.0f;
      v.color[k] = std::round(std::fmin(std::fmax(v.color[k], 0.0f), 1.0f) * largest) / largest;
    }
  }
}

Picture combined(const std::vector<ColorFormat>& formats, const OutputTypes& types, std::size_t op, int samples) {
  Picture p = with_outputs(formats, types, 21);
  p.samples = samples;
  p.draws.push_back(with_outputs(formats, types, 22).draws[0]);
  for (Drawing& d : p.draws) {
    if (!is_integer(formats[0])) use_codes(formats[0], d);
    d.state.depth.test = false;
  }
  Drawing& source = p.draws[1];
  for (Vertex& v : source.vertices) {
    v.pos_clip.x += 2.0f * kRight / static_cast<float>(p.width);
    v.pos_clip.y += 2.0f * kUp / static_cast<float>(p.height);
  }
  source.state.logic_op = static_cast<LogicOp>(op);
  if (op % 3 == 1) source.state.color_mask = {true, false, true, false};
  return p;
}

// The picture of one of the draws alone, without an operation.
Seen alone(const Picture& p, std::size_t number) {
  Picture single = p;
  single.draws = {p.draws[number]};
  single.draws[0].state.logic_op.reset();
  single.draws[0].state.color_mask = {};
  return draw(single);
}

// Returns bit i of a texel. Texels are little endian.
bool bit(std::span<const std::byte> texel, int i) {
  return (texel[static_cast<std::size_t>(i / 8)] >> (i % 8) & std::byte{1}) != std::byte{0};
}

std::string wrong_bit(const Picture& p, std::size_t attachment, std::span<const std::byte> source, std::span<const std::byte> destination,
                      std::span<const std::byte> got) {
  const DrawState& s = p.draws[1].state;
  const ColorFormat format = p.colors[attachment];
  const TexelInfo& info = texel_info(format);
  for (int k = 0; k < info.channels; ++k) {
    const int first = info.bits == 0 ? channel_shift(format, k) : k * info.bits;
    for (int i = first; i < first + channel_bits(format, k); ++i) {
      const bool d = bit(destination, i), is_changed = !source.empty() && s.color_mask[k];
      const bool expected = is_changed ? kOperations[static_cast<std::size_t>(*s.logic_op)].combine(bit(source, i), d) : d;
      if (bit(got, i) != expected) return "attachment " + std::to_string(attachment) + ": bit " + std::to_string(i) + " is wrong";
    }
  }
  return {};
}

std::string combines_the_bits(const Picture& p, const Seen& seen) {
  const Seen destination = alone(p, 0), source = alone(p, 1);
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const int from_left = x - kRight, from_bottom = y - kUp;
    const bool has_source =
        from_left >= 0 && from_bottom >= 0 && from_left % kOutputCell < kOutputSize && from_bottom % kOutputCell < kOutputSize;
    for (std::size_t i = 0; i < p.colors.size(); ++i) {
      std::string wrong = wrong_bit(p, i, has_source ? source.texel_bytes(x, y, i) : std::span<const std::byte>(),
                                    destination.texel_bytes(x, y, i), seen.texel_bytes(x, y, i));
      if (!wrong.empty()) return wrong;
    }
    return {};
  });
}

}  // namespace

Cases logic_ops_cases() {
  using enum TexelFormat;
  constexpr ColorFormat kCombined[] = {rg8,   rgba8, rgba16,  rgb565,   rgba4,    rgb10_a2,  rgba8i,
                                       rg16i, r32i,  rgba8ui, rgba16ui, rgba32ui, rgb10_a2ui};
  Cases cases;
  for (std::size_t op = 0; op < std::size(kOperations); ++op) {
    const std::string name = kOperations[op].name;
    const bool inverts = op >= 8 && op < 15;  // 0 and 0 become 1, but not all bits
    const auto add = [&](const std::string& of, const std::vector<ColorFormat>& formats, const OutputTypes& types, int samples) {
      const char* not_by_mesa = inverts && formats[0] == rgb10_a2ui ? "llvmpipe clamps inverted integers of 10 bits" : nullptr;
      cases.push_back({name + "_" + of, [=] { return combined(formats, types, op, samples); }, combines_the_bits, false, not_by_mesa});
    };
    for (const ColorFormat f : kCombined) add(std::string(texel_info(f).name), {f}, all_of_type(color_type(f)), 1);
    add("multisample", {rgba8}, all_of_type(ColorType::real), 4);
    add("three_attachments", {rgba8, rgba16i, rgba8ui}, kOutputTypes[3], 1);
  }
  return cases;
}

}  // namespace halfspace::conformance
