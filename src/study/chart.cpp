// SPDX-License-Identifier: Apache-2.0
#include "halfspace/study/chart.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace halfspace {

namespace {

// Size of the image and bounds of the plot area in it, in pixels.
constexpr int kWidth = 1000, kHeight = 660;
constexpr double kLeft = 90, kRight = 970, kBottom = 130, kTop = 580;
constexpr double kCharacter = 6.8;  // mean character width of the 11 px label font

// From Okabe and Ito, "Color universal design", 2008: distinguishable with all types of color vision, on white and on black.
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6bb1", "#7f7f7f"};

// A logarithmic axis.
struct Axis {
  double low, high;  // log10
  double at(double value) const { return (std::log10(value) - low) / (high - low); }
};

Axis axis_of(const std::vector<double>& values) {
  const auto [minimum, maximum] = std::ranges::minmax(values);
  const double low = std::log10(minimum), high = std::log10(maximum), margin = std::max(0.08 * (high - low), 0.15);
  return {low - margin, high + margin};
}

// Sets the tick labels. An axis that spans less than 2.5 decades is labeled at 1, 2 and 5 times each power of ten, a longer one at the
// powers of ten.
std::string ticks_of(const char* name, const Axis& axis) {
  if (axis.high - axis.low >= 2.5) return fmt::format("set format {} '10^{{%L}}'\n", name);
  std::string list;
  for (int power = static_cast<int>(std::floor(axis.low)); power <= axis.high; ++power) {
    for (const int factor : {1, 2, 5}) list += fmt::format("{0}'{1:g}' {1:g}", list.empty() ? "" : ", ", factor * std::pow(10.0, power));
  }
  return fmt::format("set {}tics ({})\n", name, list);
}

// Quotes text as a single-quoted gnuplot string.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "''" : std::string(1, c);
  return out + "'";
}

struct Plot {
  const Study& study;
  std::vector<double> errors;  // clamped to at least the error of the truth
  std::vector<std::string> groups;
  Axis x, y;
};

Plot make_plot(const Study& study) {
  Plot plot{study, {}, {}, {}, {}};
  std::vector<double> times;
  for (const Variant& v : study.variants) {
    plot.errors.push_back(std::max({v.error, study.truth.error, 1e-30}));
    times.insert(times.end(), {v.time.median_ms, v.time.low_ms, v.time.high_ms});
    if (std::ranges::find(plot.groups, v.group) == plot.groups.end()) plot.groups.push_back(v.group);
  }
  plot.x = axis_of(plot.errors);
  plot.y = axis_of(times);
  return plot;
}

// Writes one gnuplot data block per group, and one for the Pareto front.
std::string data_blocks(const Plot& plot, const std::vector<bool>& on_front) {
  std::string text;
  for (std::size_t g = 0; g < plot.groups.size(); ++g) {
    text += fmt::format("$group{} << EOD\n", g);
    for (std::size_t i = 0; i < plot.errors.size(); ++i) {
      const Variant& v = plot.study.variants[i];
      if (v.group != plot.groups[g]) continue;
      text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}\n", plot.errors[i], v.time.median_ms, v.time.low_ms, v.time.high_ms);
    }
    text += "EOD\n";
  }
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < on_front.size(); ++i)
    if (on_front[i]) front.push_back(i);
  std::ranges::sort(front, {}, [&](std::size_t i) { return plot.errors[i]; });
  text += "$front << EOD\n";
  for (const std::size_t i : front) text += fmt::format("{:.9g} {:.9g}\n", plot.errors[i], plot.study.variants[i].time.median_ms);
  return text + "EOD\n";
}

std::string label_lines(const Plot& plot) {
  std::vector<glm::dvec2> points;
  std::vector<double> widths;
  for (std::size_t i = 0; i < plot.errors.size(); ++i) {
    const Variant& v = plot.study.variants[i];
    points.emplace_back(kLeft + plot.x.at(plot.errors[i]) * (kRight - kLeft), kBottom + plot.y.at(v.time.median_ms) * (kTop - kBottom));
    widths.push_back(kCharacter * static_cast<double>(v.name.size()));
  }
  const std::vector<LabelPlace> places = place_labels(points, widths, {kLeft, kBottom, kRight, kTop});
  std::string text;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const LabelPlace& p = places[i];
    const auto on_screen = [](double x, double y) { return fmt::format("screen {:.5f}, screen {:.5f}", x / kWidth, y / kHeight); };
    text += fmt::format("set label {} at {} {} font ',11' textcolor rgb ink front noenhanced\n", quoted(plot.study.variants[i].name),
                        on_screen(p.x, p.y),
                        p.anchor > 0   ? "left"
                        : p.anchor < 0 ? "right"
                                       : "center");
    if (p.far)
      text += fmt::format("set arrow from {} to {} nohead linecolor rgb faint linewidth 0.7 back\n", on_screen(points[i].x, points[i].y),
                          on_screen(p.x, p.y));
  }
  return text;
}

std::string plot_command(const Plot& plot) {
  std::string text = "plot $front using 1:2 with lines linecolor rgb ink linewidth 1.5 dashtype 2 title 'Pareto front'";
  for (std::size_t g = 0; g < plot.groups.size(); ++g)
    text += fmt::format(
        ", \\\n     $group{} using 1:2:3:4 with yerrorbars linecolor rgb '{}' pointtype 7 pointsize 0.9 linewidth 1.2 title {} noenhanced",
        g, kColors[g % std::size(kColors)], quoted(plot.groups[g]));
  return text + "\n";
}

// Commands shared by the light and dark versions: margins, axes, titles.
std::string frame_lines(const Plot& plot) {
  const Study& s = plot.study;
  const auto share = [](double pixels, int whole) { return fmt::format("{:.5f}", pixels / whole); };
  return "set lmargin at screen " + share(kLeft, kWidth) + "\nset rmargin at screen " + share(kRight, kWidth) + "\nset bmargin at screen " +
         share(kBottom, kHeight) + "\nset tmargin at screen " + share(kTop, kHeight) + "\nset logscale xy\nset mxtics 10\nset mytics 10\n" +
         ticks_of("x", plot.x) + ticks_of("y", plot.y) +
         "set grid xtics ytics linecolor rgb faint linewidth "
         "0.5\n" +
         fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", std::pow(10.0, plot.x.low), std::pow(10.0, plot.x.high),
                     std::pow(10.0, plot.y.low), std::pow(10.0, plot.y.high)) +
         "set border 3 linecolor rgb ink\nset tics nomirror textcolor rgb ink\n" +  //
         "set xlabel " + quoted(s.error_name) + " noenhanced textcolor rgb ink\nset ylabel " + quoted("ms, " + s.time_name) +
         " noenhanced textcolor rgb ink\n" +  //
         "set label " + quoted(s.title) +
         fmt::format(" at screen {:.5f}, screen 0.963 font ',16' textcolor rgb ink noenhanced\n", kLeft / kWidth) +  //
         "set label " + quoted(s.setting) +
         fmt::format(" at screen {:.5f}, screen 0.927 font ',11' textcolor rgb ink noenhanced\n", kLeft / kWidth) +  //
         "set label " + quoted(fmt::format("reference: {}; error {:.1e} ({})", s.truth.method, s.truth.error, s.truth.error_method)) +
         fmt::format(" at screen {:.5f}, screen 0.900 font ',11' textcolor rgb ink noenhanced\n", kLeft / kWidth) +
         "set key at screen 0.5, screen 0.055 center center horizontal textcolor rgb ink\n";
}

std::string terminal_lines(const std::string& terminal, const std::string& file, const char* ink, const char* faint, const char* ground) {
  return "reset\nset terminal " + terminal + fmt::format(" size {},{} font 'sans,12' background rgb '{}'\n", kWidth, kHeight, ground) +
         "set output " + quoted(file) + fmt::format("\nink = '{}'\nfaint = '{}'\n", ink, faint);
}

}  // namespace

std::string chart_script(const Study& study, const std::vector<bool>& on_front) {
  const Plot plot = make_plot(study);
  const std::string drawing = frame_lines(plot) + label_lines(plot) + plot_command(plot) + "unset output\n";
  return "set encoding utf8\n" + data_blocks(plot, on_front) + terminal_lines("svg", study.name + ".svg", "#222222", "#c8c8c8", "#ffffff") +
         drawing + terminal_lines("svg", study.name + "-dark.svg", "#e6e6e6", "#4a4a4a", "#16181c") + drawing +
         terminal_lines("pngcairo", study.name + ".png", "#222222", "#c8c8c8", "#ffffff") + drawing;
}

}  // namespace halfspace
