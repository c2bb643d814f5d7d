#include "engine/fit/robust_fits.h"

#include <algorithm>

#include "engine/fit/initial_surface.h"
#include "engine/fit/robust.h"

namespace patchlab {
namespace {

struct ScaledFit {
  SurfaceFit fit;
  double scale;
};

void weigh_alike(Samples& samples) { std::fill(samples.robust.begin(), samples.robust.end(), 1.0); }

// Every so-manieth keeps its weight, so that at most `most` do.
void thin(Samples& samples, std::size_t most) {
  const std::size_t every = (samples.size() + most - 1) / most;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % every != 0) samples.robust[i] = 0.0;
  }
}

SurfaceFit tukey_fit(const Samples& all, const SurfaceFit& begin, double scale) {
  SurfaceFitOptions tukey;
  tukey.robust = true;
  tukey.robust_scale = scale;
  SurfaceFit fit = fit_surface(all, begin.model, begin.state, tukey, begin.prior);
  fit.iterations += begin.iterations;
  return fit;
}

ScaledFit falling(const Samples& all, const SurfaceFit& begin) {
  constexpr int passes = 12;
  constexpr double falls = 0.95;
  ScaledFit best{begin, std::max(residual_scale(all, begin), 1.0)};
  for (int pass = 0; pass < passes; ++pass) {
    best.fit = tukey_fit(all, best.fit, best.scale);
    const double scale = std::max(residual_scale(all, best.fit), 1.0);
    if (!(scale < falls * best.scale)) break;
    best.scale = scale;
  }
  return best;
}

}  // namespace

RobustFits fit_models_robustly(Samples& samples, const std::vector<ModelKind>& kinds,
                               const ModelStart& start) {
  RobustFits robust{fit_models(samples, kinds, start), robust_scale(samples, start.two_jet)};
  weigh_alike(samples);
  for (SurfaceFit& fit : robust.fits) fit = tukey_fit(samples, fit, robust.scale);
  return robust;
}

RobustFits fit_models_falling(Samples& samples, const std::vector<ModelKind>& kinds,
                              const ModelStart& start) {
  constexpr std::size_t enough = 5000;
  thin(samples, enough);
  const std::vector<SurfaceFit> of_half = fit_models(samples, kinds, start);
  weigh_alike(samples);
  thin(samples, enough);
  const std::vector<SurfaceFit> of_all =
      fit_models(samples, kinds, {quadratic_fit(samples, initial_plane(samples)), start.kept});
  std::vector<ScaledFit> lowest;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const ScaledFit a = falling(samples, of_half[i]), b = falling(samples, of_all[i]);
    lowest.push_back(b.scale < a.scale ? b : a);
  }
  weigh_alike(samples);
  const auto lower = [](const ScaledFit& a, const ScaledFit& b) { return a.scale < b.scale; };
  RobustFits robust{{}, std::min_element(lowest.begin(), lowest.end(), lower)->scale};
  for (const ScaledFit& each : lowest) robust.fits.push_back(tukey_fit(samples, each.fit, robust.scale));
  return robust;
}

}  // namespace patchlab
