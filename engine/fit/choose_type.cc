#include "engine/fit/choose_type.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace patchlab {
namespace {

struct RequestRow {
  SurfaceRequest request;
  std::vector<ModelKind> models;
};

const std::vector<ModelKind>& models_of(SurfaceRequest request) {
  using enum ModelKind;
  static const std::array<RequestRow, 9> rows = {{
      {SurfaceRequest::automatic,
       {plane, sphere, circular_paraboloid, circular_cylinder, cylindric_paraboloid, paraboloid}},
      {SurfaceRequest::paraboloid, {plane, circular_paraboloid, cylindric_paraboloid, paraboloid}},
      {SurfaceRequest::elliptic_paraboloid, {paraboloid}},
      {SurfaceRequest::hyperbolic_paraboloid, {paraboloid}},
      {SurfaceRequest::cylindric_paraboloid, {cylindric_paraboloid}},
      {SurfaceRequest::circular_paraboloid, {circular_paraboloid}},
      {SurfaceRequest::plane, {plane}},
      {SurfaceRequest::sphere, {sphere}},
      {SurfaceRequest::circular_cylinder, {circular_cylinder}},
  }};
  return rows[static_cast<std::size_t>(request)].models;
}

std::size_t needed(ModelKind kind) {
  return static_cast<std::size_t>(surface_model(kind).effective_parameters) + 1;
}

std::string spoken(SurfaceType surface) {
  std::string text(name(surface));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

double curvature_sigma(const SurfaceFit& fit) { return std::sqrt(chart_covariance(fit)(0, 0)); }

// Why this candidate is not (or is) what the points ask for, against the best one.
std::string reason(const SurfaceFit& fit, const SurfaceFit& best, double difference) {
  constexpr double undecided = 6.0;  // BIC difference below which evidence is weak
  const std::string mine = spoken(surface_type(fit)), chosen = spoken(surface_type(best));
  if (&fit == &best) return "least chi-square for its number of parameters";
  if (difference < undecided) {
    std::string text = mine + " and " + chosen + " cannot be told apart here";
    const SurfaceFit& curved = best.model.curvatures == 1 ? best : fit;
    if (curved.model.curvatures == 1) {
      text += ": curvature " + number(curved.state.k[0]) + " +- " + number(curvature_sigma(curved)) + " 1/m";
    }
    return text;
  }
  const double higher = fit.cost - best.cost;
  if (higher > difference * 0.5) return "chi-square is " + number(higher) + " higher";
  return "its further parameters lower chi-square by " + number(std::max(-higher, 0.0)) + " only";
}

}  // namespace

std::size_t least_points(SurfaceRequest request) {
  std::size_t least = needed(models_of(request).front());
  for (const ModelKind kind : models_of(request)) least = std::min(least, needed(kind));
  return least;
}

std::vector<ModelKind> candidate_models(SurfaceRequest request, std::size_t points) {
  std::vector<ModelKind> kinds;
  for (const ModelKind kind : models_of(request)) {
    if (points >= needed(kind)) kinds.push_back(kind);
  }
  return kinds;
}

double bic(const SurfaceFit& fit, std::size_t points) {
  return fit.cost + fit.model.effective_parameters * std::log(static_cast<double>(points));
}

SurfaceType surface_type(const SurfaceFit& fit) {
  if (fit.model.kind != ModelKind::paraboloid) return fit.model.surface;
  return fit.state.k[0] * fit.state.k[1] >= 0.0 ? SurfaceType::elliptic_paraboloid
                                                : SurfaceType::hyperbolic_paraboloid;
}

Choice choose(const std::vector<SurfaceFit>& fits, std::size_t points) {
  std::vector<std::size_t> order(fits.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return bic(fits[a], points) < bic(fits[b], points); });
  Choice choice{order.front(), {}};
  const SurfaceFit& best = fits[choice.best];
  for (const std::size_t i : order) {
    const SurfaceFit& fit = fits[i];
    const double value = bic(fit, points);
    choice.candidates.push_back({surface_type(fit), fit.chi2,
                                 static_cast<int>(points) - fit.model.effective_parameters, value,
                                 i == choice.best, reason(fit, best, value - bic(best, points))});
  }
  return choice;
}

}  // namespace patchlab
