// SPDX-License-Identifier: Apache-2.0
//
// Compares ways to convert light to 8-bit sRGB with a tone curve: exact, with a polynomial, with tables, and with a plain gamma curve.
#include <fmt/format.h>

#include <cmath>

#include "halfspace/core/srgb.h"
#include "halfspace/shading/values/tone.h"
#include "study/study.h"

namespace halfspace {

namespace {

// Narkowicz's ACES curve followed by the sRGB encoding; see shading/values/tone.h. Returns the 8-bit value before rounding.
template <class T>
T exact_code(T x) {
  const T y = std::min(x * (T(2.51L) * x + T(0.03L)) / (x * (T(2.43L) * x + T(0.59L)) + T(0.14L)), T(1));
  return 255 * (y <= T(0.0031308L) ? T(12.92L) * y : T(1.055L) * std::pow(y, 1 / T(2.4L)) - T(0.055L));
}

constexpr float kMaxCount = 8.0f;  // largest amount of light in the study

// A lookup table for the entire conversion from linear light to encoded values, sampled uniformly in light and interpolated linearly.
struct CurveTable {
  std::vector<float> codes;
  explicit CurveTable(int size) {
    for (int i = 0; i < size + 2; ++i)
      codes.push_back(static_cast<float>(exact_code(static_cast<double>(i) * static_cast<double>(kMaxCount) / size)));
  }
  HS_INLINE Int at(Real x) const {
    const Real place = x * Real(static_cast<float>(codes.size() - 2) / kMaxCount);
    const Int i = truncate_to_int(place);
    const Real low = gather(codes.data(), i), high = gather(codes.data() + 1, i);
    return round_to_int(fma(place - to_real<Real>(i), high - low, low));
  }
};

HS_INLINE Real curve(Real x) { return min(tone_curve(ToneCurve::aces, x, 4.0f), Real(1.0f)); }

struct Lights {
  std::vector<float> light;
  std::vector<int> codes;  // the correct results
};
Lights make_lights(int count) {
  Lights out;
  for (int i = 0; i < count; ++i) {  // uniform in the square root of light, which is closer to perception
    const double s = (i + 0.5) / count;
    out.light.push_back(static_cast<float>(s * s * static_cast<double>(kMaxCount)));
    out.codes.push_back(static_cast<int>(std::lround(exact_code(static_cast<long double>(out.light.back())))));
  }
  return out;
}

template <class F>
Variant evaluated(const std::string& name, const std::string& group, const Lights& lights, const F& encode, const StudyOptions& options) {
  std::vector<int32_t> codes(lights.light.size());
  Variant v{.name = name,
            .group = group,
            .parameters = {{"values", static_cast<double>(codes.size())}},
            .time = time_of(
                [&] {
                  for (std::size_t i = 0; i < codes.size(); i += kLanes) store(&codes[i], encode(load<Real>(&lights.light[i])));
                },
                options)};
  int64_t wrong = 0, sum = 0;
  int largest = 0;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const int e = std::abs(codes[i] - lights.codes[i]);
    wrong += e != 0;
    sum += e;
    largest = std::max(largest, e);
  }
  const auto n = static_cast<double>(codes.size());
  v.error = static_cast<double>(sum) / n;
  v.measures = {{"wrong_fraction", static_cast<double>(wrong) / n}, {"largest", static_cast<double>(largest)}};
  return v;
}

}  // namespace

Study study_tone(const StudyOptions& options, const Workers&) {
  const int count = options.quick ? 1 << 16 : 1 << 20;
  const Lights lights = make_lights(count);
  Study study{
      .name = "tone",
      .title = "Tone curve and sRGB encoding",
      .setting = fmt::format("{} channels of light from 0 to 8, ACES curve, 8-bit sRGB values, {} lanes", count, kLanes),
      .error_name = fmt::format("mean error in 8-bit steps (zero is plotted at {:.0e})", 0.1 / count),
      .time_name = fmt::format("{} channels on one thread", count),
      .truth = {"curve and power in long double, rounded", 0.1 / count, "one channel wrong by a tenth of an 8-bit step"},
  };
  study.variants.push_back(evaluated(
      "double pow", "scalar", lights,
      [](Real x) {
        Int codes(0);
        for (int k = 0; k < kLanes; ++k) set_lane(codes, k, static_cast<int32_t>(std::lround(exact_code(static_cast<double>(lane(x, k))))));
        return codes;
      },
      options));
  study.variants.push_back(evaluated(
      "curve, encoder's table (used here)", "curve by formula", lights, [](Real x) { return linear_to_srgb(curve(x)); }, options));
  study.variants.push_back(evaluated(
      "curve, polynomial power", "curve by formula", lights,
      [](Real x) { return round_to_int(encode_srgb(DisplayLight<Real>{vec3<Real>(curve(x))}).rgb.x * Real(255.0f)); }, options));
  study.variants.push_back(evaluated(
      "curve, gamma 2.2", "curve by formula", lights, [](Real x) { return round_to_int(pow(curve(x), Real(1.0f / 2.2f)) * Real(255.0f)); },
      options));
  study.variants.push_back(evaluated(
      "curve, gamma 2 (root)", "curve by formula", lights, [](Real x) { return round_to_int(sqrt(curve(x)) * Real(255.0f)); }, options));
  for (const int size : {256, 1024, 4096, 65536}) {
    const CurveTable table(size);
    study.variants.push_back(evaluated(
        fmt::format("table of {}", size), "one table for everything", lights, [&](Real x) { return table.at(x); }, options));
  }
  return study;
}

}  // namespace halfspace
