// SPDX-License-Identifier: Apache-2.0
//
// The tables of srgb.h, computed at compile time. The tables need decode(v) rounded to 24 bits, and double arithmetic has a relative
// error of about 2^-50. This is sufficient unless an exact value is very close to a rounding boundary. A test with long double checks that:
// the closest value is at a relative distance of 2^-35.
#include "halfspace/core/srgb.h"

namespace halfspace::HS_LANES {

namespace {

/// Returns a^2.4 for 0 < a <= 1: the fifth root of a^12, by Newton's method from above.
constexpr double power_of_2_4(double a) {
  const double a2 = a * a, a4 = a2 * a2, a12 = a4 * a4 * a4;
  double y = 1.0;
  for (int i = 0; i < 60; ++i) {  // first shrinks by 4/5 per step (a^2.4 > 1/900: 31 steps), then converges quadratically
    const double y2 = y * y;
    y -= (y2 * y2 * y - a12) / (5.0 * y2 * y2);
  }
  return y;
}

constexpr double decode(double v) { return v <= 0.04045 ? v / 12.92 : power_of_2_4((v + 0.055) / 1.055); }

/// Returns the bits of the smallest float that is not below x, for x > 0.
constexpr int32_t bits_at_or_above(double x) {
  const float f = static_cast<float>(x);
  return std::bit_cast<int32_t>(f) + (static_cast<double>(f) < x ? 1 : 0);
}

constexpr std::array<float, 256> make_decode_table() {
  std::array<float, 256> table{};
  for (int c = 0; c < 256; ++c) table[static_cast<std::size_t>(c)] = static_cast<float>(decode(c / 255.0));
  return table;
}

constexpr detail::SrgbPairs make_pairs() {
  const std::array<float, 256> linear = make_decode_table();
  detail::SrgbPairs pairs{};
  for (std::size_t c = 0; c < linear.size(); ++c) {
    pairs.first[c][0] = pairs.second[c][1] = linear[c];
    pairs.alpha[c][1] = static_cast<float>(c);
  }
  return pairs;
}

/// Returns the bits of the first float that encodes to the 8-bit value c, i.e. that is nearer to c than to c − 1.
constexpr int32_t threshold_bits(int c) { return bits_at_or_above(decode((c - 0.5) / 255.0)); }

struct EncodeTable {
  std::array<int32_t, detail::kSrgbBuckets> entries{};
  bool one_threshold_a_bucket = true;
};

constexpr EncodeTable make_encode_table() {
  EncodeTable table;
  int code = 0;
  int32_t next = threshold_bits(1);
  for (int b = 0; b < detail::kSrgbBuckets; ++b) {
    const int32_t begin = detail::kSrgbFirstBits + (b << 16);
    const int32_t end = begin + 0x10000;
    int32_t carry = 0;  // makes the low bits of the threshold reach 2^16; 0 never carries
    if (code < 255 && next < end) carry = end - next;
    table.entries[static_cast<std::size_t>(b)] = (code << 16) + carry;
    if (carry == 0) continue;
    ++code;
    if (code < 255) next = threshold_bits(code + 1);
    if (code < 255 && next < end) table.one_threshold_a_bucket = false;
  }
  return table;
}

constexpr EncodeTable kTable = make_encode_table();
static_assert(kTable.one_threshold_a_bucket);

}  // namespace

alignas(64) constexpr std::array<float, 256> kSrgbToLinear = make_decode_table();
alignas(64) constexpr detail::SrgbPairs detail::kSrgbPairs = make_pairs();
constexpr std::array<int32_t, detail::kSrgbBuckets> detail::kSrgbEncode = kTable.entries;

}  // namespace halfspace::HS_LANES
