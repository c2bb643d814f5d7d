// What the calibration report measures: every study of it, run and kept as numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/bench/calibration/starts.h"
#include "tests/support/battery.h"

namespace patchlab::calibration {

struct Settings {
  int trials = 400;  // a type, and a cell of every table
  std::uint64_t seed = 1;
  int points = 300;
  test::NoiseMode noise = test::NoiseMode::linear;
  int threads = 1;  // changes no number
};

// The types forced by name, each method, in the order of Table I.
struct Battery {
  std::vector<test::BatteryRow> calibrated, paper;
};

// The five paraboloids, the plane among them, when step 3 chooses.
struct TypeChoice {
  FitMethod method;
  int points;
  std::vector<test::BatteryRow> rows;
  test::BatteryRow apart;  // elliptic, its curvatures further apart than the noise: not nearly circular
};

// A sloppy lasso: a share of the points lies on a plane behind one side.
struct OutlierCell {
  double share;
  bool robust;
  test::BatteryRow row;
};

struct Study {
  Settings settings;
  Battery battery;
  std::vector<TypeChoice> choices;
  std::vector<OutlierCell> outliers;  // by type, then share, then robust off and on
  std::vector<StartCell> starts;      // by angle
};

// `say` is told of every stage.
Study run_study(const Settings& settings, const std::function<void(const std::string&)>& say);

}  // namespace patchlab::calibration
