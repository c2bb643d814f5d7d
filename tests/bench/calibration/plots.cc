#include "tests/bench/calibration/plots.h"

#include <algorithm>
#include <cmath>

#include "tests/bench/calibration/svg.h"
#include "tests/bench/calibration/words.h"

namespace patchlab::calibration {
namespace {

using test::Band;
using test::BatteryRow;

constexpr double shade_confidence = 0.99;

struct Method {
  std::string_view label, fill;
  const std::vector<BatteryRow>* rows;
  double stroke;  // px; the later is drawn over the earlier, which shows beside it where they agree
};
std::array<Method, 2> methods(const Study& study) {
  return {{{"paper, as printed", colour::vermillion, &study.battery.paper, 4.0},
           {"calibrated", colour::blue, &study.battery.calibrated, 2.0}}};
}

// Heading, what was run, and the legend, at the top of every plot.
Svg sheet(double width, double height, const std::string& title, const std::string& subtitle,
          const Study& study) {
  Svg svg(width, height, title);
  svg.text({20.0, 28.0}, title, {.size = 16.0, .bold = true});
  svg.text({20.0, 48.0}, subtitle, {.fill = colour::faint});
  svg.text({20.0, height - 14.0}, words(study.settings), {.size = 12.0, .fill = colour::faint});
  double x = width - 130.0;
  for (const Method& method : methods(study)) {
    svg.dot({x, 23.5}, 5.0, method.fill);
    svg.text({x + 11.0, 28.0}, method.label);
    x -= 98.0;
  }
  return svg;
}

struct NeesOf {
  std::vector<double> BatteryRow::*values;
  int BatteryRow::*dof;
};

struct Panel {
  Scale x, y;
};

void draw_probability_axes(Svg& svg, const Panel& panel, const std::string& title, bool label_y,
                           bool label_x) {
  for (const double tick : {0.0, 0.5, 1.0}) {
    svg.line({panel.x(tick), panel.y(0.0)}, {panel.x(tick), panel.y(1.0)}, colour::rule);
    svg.line({panel.x(0.0), panel.y(tick)}, {panel.x(1.0), panel.y(tick)}, colour::rule);
    const std::string label = fixed(100.0 * tick, 0);
    if (label_x) {
      svg.text({panel.x(tick), panel.y(0.0) + 17.0}, label, {.size = 12.0, .anchor = Anchor::middle});
    }
    if (label_y)
      svg.text({panel.x(0.0) - 6.0, panel.y(tick) + 4.0}, label, {.size = 12.0, .anchor = Anchor::end});
  }
  svg.text({panel.x(0.0), panel.y(1.0) - 8.0}, title, {.bold = true});
}

// Where a true covariance stays at each probability, in 99 of 100 runs.
void draw_probability_band(Svg& svg, const Panel& panel, int trials) {
  std::vector<Point> low, outline;
  for (int i = 0; i <= 100; ++i) {
    const double p = 0.01 * i;
    const Band band =
        i % 100 == 0 ? Band{p * trials, p * trials} : test::binomial_band(trials, p, 1.0 - shade_confidence);
    low.push_back({panel.x(p), panel.y(band.low / trials)});
    outline.push_back({panel.x(p), panel.y(band.high / trials)});
  }
  outline.insert(outline.end(), low.rbegin(), low.rend());
  svg.area(outline, colour::band);
  svg.line({panel.x(0.0), panel.y(0.0)}, {panel.x(1.0), panel.y(1.0)}, colour::faint);
}

void draw_probability_curve(Svg& svg, const Panel& panel, const BatteryRow& row, const NeesOf& nees,
                            const Method& method) {
  std::vector<Point> curve;
  for (int i = 0; i <= 100; ++i) {
    const double p = std::min(0.01 * i, 0.9999);
    const int hits = test::inside(row.*nees.values, row.*nees.dof, p);
    curve.push_back({panel.x(0.01 * i), panel.y(static_cast<double>(hits) / row.trials)});
  }
  svg.polyline(curve, method.fill, method.stroke);
}

std::string probability_plot(const Study& study, const std::string& title, const NeesOf& nees) {
  constexpr double side = 148.0, pitch_x = 178.0, pitch_y = 192.0, left = 72.0, top = 92.0;
  Svg svg = sheet(
      960.0, 532.0, title,
      "Share of trials whose truth lies inside the ellipsoid of each probability. True: on the diagonal; "
      "grey: 99 % of runs.",
      study);
  for (std::size_t i = 0; i < study.battery.calibrated.size(); ++i) {
    const double x = left + pitch_x * static_cast<double>(i % 5),
                 y = top + pitch_y * static_cast<double>(i / 5);
    const Panel panel{{0.0, 1.0, x, x + side}, {0.0, 1.0, y + side, y}};
    draw_probability_band(svg, panel, study.settings.trials);
    draw_probability_axes(svg, panel, words(*study.battery.calibrated[i].type), i % 5 == 0, i >= 5);
    for (const Method& method : methods(study)) {
      draw_probability_curve(svg, panel, (*method.rows)[i], nees, method);
    }
  }
  svg.text({left + 2.0 * pitch_x + 0.5 * side, top + pitch_y + side + 38.0}, "stated probability (%)",
           {.anchor = Anchor::middle});
  svg.text({34.0, top + 0.5 * (pitch_y + side)}, "trials inside (%)",
           {.anchor = Anchor::middle, .upwards = true});
  return svg.finished();
}

constexpr double row_pitch = 32.0;

void label_rows(Svg& svg, const Study& study, double right, double top) {
  for (std::size_t i = 0; i < study.battery.calibrated.size(); ++i) {
    svg.text({right, top + row_pitch * (static_cast<double>(i) + 0.5) + 4.5},
             words(*study.battery.calibrated[i].type), {.anchor = Anchor::end});
  }
}

struct CoverageOf {
  std::string title;
  int BatteryRow::*covered;
};

void draw_coverage(Svg& svg, const Study& study, const CoverageOf& what, const Scale& x, double top) {
  const int trials = study.settings.trials;
  const double bottom = top + row_pitch * static_cast<double>(study.battery.calibrated.size());
  const Band band = test::binomial_band(trials, 0.95, 1.0 - shade_confidence);
  svg.box({x(band.low / trials), top}, x(band.high / trials) - x(band.low / trials), bottom - top,
          colour::band);
  for (int tick = 0; tick <= 100; tick += 20) {
    svg.line({x(0.01 * tick), top}, {x(0.01 * tick), bottom}, colour::rule);
    svg.text({x(0.01 * tick), bottom + 17.0}, std::to_string(tick), {.size = 12.0, .anchor = Anchor::middle});
  }
  double offset = 16.0;
  for (const Method& method : methods(study)) {
    for (std::size_t i = 0; i < method.rows->size(); ++i) {
      const double share = static_cast<double>((*method.rows)[i].*what.covered) / trials;
      svg.box({x(0.0), top + row_pitch * static_cast<double>(i) + offset}, std::max(x(share) - x(0.0), 1.5),
              9.0, method.fill);
    }
    offset -= 10.0;
  }
  svg.line({x(0.95), top - 4.0}, {x(0.95), bottom}, colour::ink, 1.5);
  svg.text({x(0.95), top - 9.0}, "95", {.size = 12.0, .anchor = Anchor::middle});
  svg.text({x(0.0), top - 9.0}, what.title, {.bold = true});
}

void draw_sizes(Svg& svg, const Method& method, const Scale& x, double top, double offset) {
  for (std::size_t i = 0; i < method.rows->size(); ++i) {
    const std::vector<double>& sizes = (*method.rows)[i].size_ratio;
    if (sizes.size() < 2) continue;
    const double y = top + row_pitch * (static_cast<double>(i) + 0.5) + offset;
    const double centre = test::mean(sizes), reach = test::deviation(sizes);
    const auto held = [&](double value) { return x(std::clamp(value, x.from, x.to)); };
    svg.line({held(centre - reach), y}, {held(centre + reach), y}, method.fill, 2.0);
    if (centre <= x.to) svg.dot({held(centre), y}, 4.5, method.fill);
  }
}

// Where the axis of sizes ends, in fifths: past every mean and deviation, but not further than 3.
int last_fifth(const Study& study) {
  double largest = 1.4;
  for (const Method& method : methods(study)) {
    for (const BatteryRow& row : *method.rows) {
      if (row.size_ratio.size() < 2) continue;
      largest = std::max(largest, test::mean(row.size_ratio) + test::deviation(row.size_ratio));
    }
  }
  return static_cast<int>(std::ceil(5.0 * std::min(largest, 3.0)));
}

void draw_starts(Svg& svg, const Study& study, const Panel& panel, std::string_view stroke,
                 int StartCell::*hits) {
  std::vector<Point> curve;
  for (const StartCell& cell : study.starts) {
    const Band band = test::share_interval(cell.*hits, cell.trials, shade_confidence);
    const double x = panel.x(cell.degrees), y = panel.y(static_cast<double>(cell.*hits) / cell.trials);
    svg.line({x, panel.y(band.low)}, {x, panel.y(band.high)}, stroke, 1.5);
    svg.dot({x, y}, 4.0, stroke);
    curve.push_back({x, y});
  }
  svg.polyline(curve, stroke, 2.0);
}

}  // namespace

std::string surface_probability_plot(const Study& study) {
  return probability_plot(study, "Is the covariance of the surface true?",
                          {&BatteryRow::surface_nees, &BatteryRow::surface_dof});
}

std::string full_probability_plot(const Study& study) {
  return probability_plot(study, "Is the covariance of all parameters true?",
                          {&BatteryRow::full_nees, &BatteryRow::full_dof});
}

std::string coverage_plot(const Study& study) {
  constexpr double top = 92.0, left = 170.0, width = 350.0, gap = 40.0;
  Svg svg = sheet(
      960.0, 482.0, "Coverage of the 95 % ellipsoid",
      "Share of trials whose truth lies inside; grey: where a true ellipsoid stays in 99 % of runs.", study);
  label_rows(svg, study, left - 12.0, top);
  draw_coverage(svg, study, {"surface", &BatteryRow::surface_covered}, {0.0, 1.0, left, left + width}, top);
  draw_coverage(svg, study, {"all parameters, with the bounds", &BatteryRow::full_covered},
                {0.0, 1.0, left + width + gap, left + 2.0 * width + gap}, top);
  svg.text({left + width + 0.5 * gap, 448.0}, "trials inside the 95 % ellipsoid (%)",
           {.anchor = Anchor::middle});
  return svg.finished();
}

std::string bounds_plot(const Study& study) {
  constexpr double top = 78.0, left = 170.0;
  constexpr int first = 3;  // fifths
  const int last = last_fifth(study);
  const double bottom = top + row_pitch * static_cast<double>(study.battery.calibrated.size());
  const Scale x{0.2 * first, 0.2 * last, left, 920.0};
  Svg svg = sheet(
      960.0, 470.0, "Bounds against the truth",
      "Every length of the boundary over its true one: mean, and the standard deviation of one fit.", study);
  label_rows(svg, study, left - 12.0, top);
  for (int tick = first; tick <= last; ++tick) {
    const double value = 0.2 * tick;
    svg.line({x(value), top}, {x(value), bottom}, tick == 5 ? colour::ink : colour::rule,
             tick == 5 ? 1.5 : 1.0);
    svg.text({x(value), bottom + 17.0}, fixed(value, 1), {.size = 12.0, .anchor = Anchor::middle});
  }
  double offset = 5.0;
  for (const Method& method : methods(study)) {
    draw_sizes(svg, method, x, top, offset);
    offset -= 10.0;
  }
  svg.text({0.5 * (left + 920.0), bottom + 38.0}, "d / d_true", {.anchor = Anchor::middle});
  return svg.finished();
}

std::string starts_plot(const Study& study) {
  const Panel panel{{0.0, 90.0, 80.0, 690.0}, {0.0, 1.0, 300.0, 80.0}};
  Svg svg = sheet(720.0, 372.0, "Circular cylinder: success from any start",
                  "Fits that end at the true axis; bars: 99 % interval.", study);
  for (int tick = 0; tick <= 100; tick += 25) {
    svg.line({panel.x(0.0), panel.y(0.01 * tick)}, {panel.x(90.0), panel.y(0.01 * tick)}, colour::rule);
    svg.text({72.0, panel.y(0.01 * tick) + 4.0}, std::to_string(tick), {.size = 12.0, .anchor = Anchor::end});
  }
  for (const StartCell& cell : study.starts) {
    svg.text({panel.x(cell.degrees), 318.0}, fixed(cell.degrees, 0),
             {.size = 12.0, .anchor = Anchor::middle});
  }
  draw_starts(svg, study, panel, colour::vermillion, &StartCell::paper);
  draw_starts(svg, study, panel, colour::blue, &StartCell::calibrated);
  svg.text({385.0, 338.0}, "angle between the start's x axis and the true axis (degrees)",
           {.anchor = Anchor::middle});
  svg.text({30.0, 190.0}, "success (%)", {.anchor = Anchor::middle, .upwards = true});
  return svg.finished();
}

}  // namespace patchlab::calibration
