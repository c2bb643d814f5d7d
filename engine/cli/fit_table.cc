#include "engine/cli/fit_table.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace patchlab {
namespace {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  char text[256];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string words(std::string_view name) {
  std::string text(name);
  std::ranges::replace(text, '_', ' ');
  return text;
}

const char* unit(const std::string& parameter) {
  if (parameter.starts_with("kappa")) return "1/m";
  return parameter.starts_with("r_") || parameter == "gamma" ? "rad" : "m";
}

// With two digits of the standard deviation, and the value to the same decimal.
std::string row(const std::string& name, double value, double sigma, const char* unit) {
  const double digit = std::floor(std::log10(sigma));
  const int decimals =
      sigma > 0.0 && std::isfinite(sigma) ? std::clamp(1 - static_cast<int>(digit), 0, 12) : 6;
  return format("  %-12s %12.*f ± %-10.*f %s\n", name.c_str(), decimals, value, decimals, sigma, unit);
}

std::string parameter_rows(const Patch& patch) {
  std::string text;
  const std::vector<std::string> names = parameter_names(*patch.type);
  for (Eigen::Index i = 0; i < patch.parameters.size(); ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    text += row(name, patch.parameters[i], std::sqrt((*patch.covariance)(i, i)), unit(name));
  }
  const bool round =
      patch.type->surface == SurfaceType::sphere || patch.type->surface == SurfaceType::circular_cylinder;
  if (round) {
    const Eigen::Index at = patch.type->curvature_at();
    const double kappa = patch.parameters[at];
    text +=
        row("radius", 1.0 / std::abs(kappa), std::sqrt((*patch.covariance)(at, at)) / (kappa * kappa), "m");
  }
  if (near_singular(patch))
    text += "  (r_x r_y are nearly singular here; covariance_local of the JSON holds)\n";
  return text;
}

std::string report_rows(const FitReport& report) {
  std::string text = format("  chi2 / dof   %.1f / %d, p = %.2g\n", report.chi2, report.dof, report.p_value);
  text += format("  points       %zu, %zu outliers", report.points, report.outliers.size());
  text += report.edge_points > 0 ? format(", %zu at depth edges bound only\n", report.edge_points) : "\n";
  text += format("  residual     %.2f mm rms, coverage %.0f %%\n", 1e3 * report.residual_rms,
                 100.0 * report.coverage);
  text += "  verdict      " + report.verdict + "\n";
  for (std::size_t i = 1; i < report.reasons.size(); ++i) {  // the verdict holds the first
    text += "  reason       " + report.reasons[i].sentence + "\n";
  }
  for (const Finding& warning : report.warnings) text += "  warning      " + warning.sentence + "\n";
  if (report.candidates.size() < 2) return text;
  text += "  compared     chi2 + p ln N; the least is taken\n";
  for (const Candidate& candidate : report.candidates) {
    text += format("    %-24s %10.1f  %s\n", words(name(candidate.surface)).c_str(), candidate.bic,
                   candidate.reason.c_str());
  }
  return text;
}

}  // namespace

std::string fit_table(const Document& document, const PatchEntry& patch) {
  const ScanEntry& scan = *find_scan(document, patch.scan);
  const PatchTypeRow& type = *patch.fit->patch.type;
  const FitReport& report = patch.fit->report;
  std::string text = patch.name + ": " + words(name(type.surface)) + ", " + words(name(type.boundary)) +
                     "; " + scan.name + ", " + patch.region + "; " + std::string(name(report.method)) +
                     (report.robust ? " robust" : "") + " fit, noise " + scan.noise.specification +
                     (scan.noise.assumed ? " (assumed)" : "") + "\n";
  return text + parameter_rows(patch.fit->patch) + report_rows(report);
}

}  // namespace patchlab
