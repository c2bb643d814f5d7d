#include "viewer/panel/parameter_rows.h"

#include <algorithm>
#include <cmath>

#include "engine/patch/marginals.h"
#include "viewer/panel/numbers.h"

namespace patchlab::viewer {

namespace {

constexpr double radius_is_known = 3.0;  // |kappa| / sigma below which 1/|kappa| says nothing

ParameterRow value_row(const std::string& name, double value, double sigma, Dimension dimension) {
  if (sigma == 0.0) return {name, quantity(value, dimension), "exact", 0.0, "of its value"};
  const Measured text = measured(value, sigma, dimension);
  return {name, text.value, text.sigma, sigma / std::abs(value), "of its value"};
}

void add_shape(const Patch& patch, const PatchVector& sigma, std::vector<ParameterRow>& rows) {
  const PatchTypeRow& type = *patch.type;
  const std::vector<std::string> names = local_names(type);
  for (int i = 0; i < type.curvature_size; ++i) {
    const int at = type.curvature_at() + i;
    const double kappa = patch.parameters[at], s = sigma[at];
    const std::string symbol = local_words(names[static_cast<std::size_t>(at)]);
    if (std::abs(kappa) > radius_is_known * s) {
      rows.push_back(value_row("radius 1/|" + symbol + "|", 1.0 / std::abs(kappa), s / (kappa * kappa),
                               Dimension::length));
    }
    rows.push_back(value_row(symbol, kappa, s, Dimension::curvature));
  }
  for (int i = 0; i < type.boundary_size; ++i) {
    const bool is_angle = names[static_cast<std::size_t>(i)] == "gamma";
    rows.push_back(value_row((is_angle ? "" : "outline ") + local_words(names[static_cast<std::size_t>(i)]),
                             patch.parameters[i], sigma[i], is_angle ? Dimension::angle : Dimension::length));
  }
}

void add_pose(const Patch& patch, const PatchVector& sigma, std::vector<ParameterRow>& rows) {
  const PatchTypeRow& type = *patch.type;
  const char* turns[] = {"tilt x", "tilt y", "spin"};
  for (int i = 0; i < type.rotation_size; ++i) {
    const double s = sigma[type.rotation_at() + i];
    rows.push_back({turns[i], "", sigma_text(s, Dimension::angle), s, "of a radian"});
  }
  const double size = extent(boundary(patch)).maxCoeff();
  const auto t = sigma.segment<3>(type.position_at());
  rows.push_back(
      {"centre along normal", "", sigma_text(t.z(), Dimension::length), t.z() / size, "of the patch's size"});
  const double widest = std::max(t.x(), t.y());
  const std::string y = sigma_text(t.y(), Dimension::length).substr(std::string("± ").size());
  rows.push_back({"centre in plane", "", sigma_text(t.x(), Dimension::length) + ", " + y, widest / size,
                  "of the patch's size"});
}

}  // namespace

std::vector<ParameterRow> parameter_rows(const Patch& patch) {
  const bool known = patch.covariance_local.has_value();
  const PatchVector sigma =
      known ? sigmas(*patch.covariance_local) : PatchVector(PatchVector::Zero(patch.type->size()));
  std::vector<ParameterRow> rows;
  add_shape(patch, sigma, rows);
  if (known) add_pose(patch, sigma, rows);
  if (!known) {
    for (ParameterRow& row : rows) row.sigma.clear();
  }
  return rows;
}

double bar_length(double share) {
  if (!(share > 0)) return 0.0;
  return std::clamp((std::log10(share) + 4.0) / 4.0, 0.0, 1.0);
}

std::string local_words(const std::string& local_name) {
  constexpr struct {
    const char* name;
    const char* words;
  } table[] = {{"kappa", "κ"},
               {"kappa_x", "κ_x"},
               {"kappa_y", "κ_y"},
               {"gamma", "γ"},
               {"tilt_x", "tilt x"},
               {"tilt_y", "tilt y"},
               {"w_x", "tilt x"},
               {"w_y", "tilt y"},
               {"w_z", "spin"},
               {"t_x", "centre along x"},
               {"t_y", "centre along y"},
               {"t_z", "centre along normal"}};
  for (const auto& row : table)
    if (local_name == row.name) return row.words;
  return local_name;
}

StrongestPair strongest_pair(const Patch& patch, const PatchMatrix& correlations) {
  StrongestPair pair;
  const std::vector<std::string> names = local_names(*patch.type);
  for (Eigen::Index i = 0; i < correlations.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (std::abs(correlations(i, j)) <= std::abs(pair.correlation)) continue;
      pair = {local_words(names[static_cast<std::size_t>(j)]),
              local_words(names[static_cast<std::size_t>(i)]), correlations(i, j)};
    }
  }
  return pair;
}

}  // namespace patchlab::viewer
