#include "tests/bench/calibration/study.h"

#include "tests/bench/calibration/words.h"

namespace patchlab::calibration {
namespace {

using test::BatteryOptions;
using test::BatteryRow;
using Say = std::function<void(const std::string&)>;

BatteryOptions options_of(const Settings& settings) {
  BatteryOptions options;
  options.trials = settings.trials;
  options.seed = settings.seed;
  options.threads = settings.threads;
  options.scenario.points = static_cast<std::size_t>(settings.points);
  options.scenario.noise = settings.noise;
  return options;
}

std::vector<BatteryRow> all_types(const Settings& settings, FitMethod method, const Say& say) {
  BatteryOptions options = options_of(settings);
  options.method = method;
  std::vector<BatteryRow> rows;
  for (const PatchTypeRow& type : patch_types()) {
    say(std::string(name(method)) + ": " + words(type));
    rows.push_back(run_battery(type, options));
  }
  return rows;
}

const PatchTypeRow& row_of(SurfaceType surface) {
  return *find_patch_type(surface, default_boundary(surface));
}

TypeChoice choose(const Settings& settings, FitMethod method, int points, const Say& say) {
  say(std::string(name(method)) + ": choice of type, " + std::to_string(points) + " points");
  BatteryOptions options = options_of(settings);
  options.method = method;
  options.forced = false;
  options.scenario.points = static_cast<std::size_t>(points);
  TypeChoice choice{method, points, {}, {}};
  for (const SurfaceType surface : paraboloids) choice.rows.push_back(run_battery(row_of(surface), options));
  options.scenario.least_apart = options.scenario.least_sag;
  choice.apart = run_battery(row_of(SurfaceType::elliptic_paraboloid), options);
  return choice;
}

std::vector<OutlierCell> outliers_of(const Settings& settings, SurfaceType surface, const Say& say) {
  say("outliers: " + words(row_of(surface)));
  BatteryOptions options = options_of(settings);
  std::vector<OutlierCell> cells;
  for (const double share : {0.0, 0.05, 0.10, 0.20}) {
    for (const bool robust : {false, true}) {
      options.scenario.outliers = share;
      options.robust = robust;
      cells.push_back({share, robust, run_battery(row_of(surface), options)});
    }
  }
  return cells;
}

}  // namespace

Study run_study(const Settings& settings, const Say& say) {
  Study study;
  study.settings = settings;
  study.battery.calibrated = all_types(settings, FitMethod::calibrated, say);
  study.battery.paper = all_types(settings, FitMethod::paper, say);
  for (const int points : {settings.points, 5 * settings.points}) {
    for (const FitMethod method : {FitMethod::calibrated, FitMethod::paper}) {
      study.choices.push_back(choose(settings, method, points, say));
    }
  }
  for (const SurfaceType surface : {SurfaceType::plane, SurfaceType::sphere, SurfaceType::circular_cylinder,
                                    SurfaceType::elliptic_paraboloid}) {
    for (OutlierCell& cell : outliers_of(settings, surface, say)) study.outliers.push_back(std::move(cell));
  }
  say("starts of the cylinder");
  study.starts = cylinder_starts(options_of(settings));
  return study;
}

}  // namespace patchlab::calibration
