#include "tests/bench/calibration/report.h"

#include <cmath>

#include "tests/bench/calibration/plots.h"
#include "tests/bench/calibration/words.h"
#include "tests/support/nees.h"

namespace patchlab::calibration {
namespace {

using test::BatteryRow;
using Cells = std::vector<std::string>;

constexpr double confidence = 0.99;

std::string line(const Cells& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

// The first column is words, the others are numbers.
std::string head(const Cells& titles) {
  std::string rule = "|---|";
  for (std::size_t i = 1; i < titles.size(); ++i) rule += "---:|";
  std::string text = "\n";
  return text.append(line(titles)).append(rule).append("\n");
}

std::string share(int hits, int trials) {
  return percent(static_cast<double>(hits) / trials, hits == trials ? 0 : 1);
}
std::string covered(int hits, int trials) {
  return share(hits, trials) + " (" + percent(test::share_interval(hits, trials, confidence)) + ")";
}
std::string mean_and_median(const std::vector<double>& values) {
  return ratio(test::mean(values)) + " (" + ratio(test::median(values)) + ")";
}
std::string mean_and_deviation(const std::vector<double>& values) {
  return fixed(test::mean(values), 2) + " ± " + fixed(test::deviation(values), 2);
}

std::string introduction(const Study& study) {
  const int trials = study.settings.trials;
  const test::Band band = test::binomial_band(trials, 0.95, 1.0 - confidence);
  return "# Is the covariance true?\n\n"
         "Simulated scans of random patches are fitted, and the error of each fit is held against its own covariance Σ.\n"
         "If Σ is true, NEES = e' Σ⁻¹ e follows chi-square: its mean over the degrees of freedom is 1, and the truth lies\n"
         "inside the 95 % ellipsoid in 95 % of the trials. Written by `tests/bench/calibration`:\n\n"
         "    build/release/bin/calibration --trials " +
         std::to_string(trials) + " --seed " + std::to_string(study.settings.seed) + " --points " +
         std::to_string(study.settings.points) + " --noise " +
         (study.settings.noise == test::NoiseMode::linear ? "linear" : "sensor") + " -o FOLDER\n\n" +
         words(study.settings) +
         ".\n\n"
         "**Scenes.** Patches of 5 to 20 cm, curvature radius 5 cm to 1 m, 0.7 to 2 m from a Kinect, tilted by 5 to 55°,\n"
         "wholly visible, sag at least 1.5 standard deviations of the range noise, concave and convex in turn. The region of\n"
         "a paraboloid is centred about its vertex as the prior of the fit says (5 % of its size). Every trial is a new\n"
         "patch. The type is forced by name except where it says so.\n\n"
         "**Methods.** `calibrated` is the default of `patchlab fit`; `paper` is the nine steps as printed, with the errata\n"
         "that make them computable (500 iterations at most; bounds for a containment of 0.95).\n\n"
         "**Reading.** Intervals in brackets are 99 % confidence (Clopper and Pearson). With " +
         std::to_string(trials) + " trials a true 95 %\nellipsoid covers " +
         percent(test::Band{band.low / trials, band.high / trials}) +
         " in 99 of 100 runs. A fit that was refused or gave another type counts as not\ncovered.\n";
}

std::string surface_table(const std::string& title, const std::vector<BatteryRow>& rows) {
  std::string text = "\n### " + title + "\n" +
                     head({"type", "converged", "iterations", "χ²/dof", "NEES/dof mean (median)",
                           "inside 95 % (99 % interval)"});
  for (const BatteryRow& row : rows) {
    text += line({words(*row.type), share(row.converged, row.trials), fixed(test::mean(row.iterations), 1),
                  fixed(test::mean(row.chi2_per_dof), 3), mean_and_median(row.surface_nees),
                  covered(row.surface_covered, row.trials)});
  }
  return text;
}

std::string surface_section(const Study& study) {
  return "\n## The surface\n\nThe unbounded surface alone, in what its type determines: no boundary, no gauge.\n\n![Share of "
         "trials inside the ellipsoid of each probability, surface](" +
         std::string(surface_probability_file) + ")\n" +
         surface_table("calibrated", study.battery.calibrated) + surface_table("paper", study.battery.paper) +
         "\nIterations count every start (cylinders have two) and every refit.\n";
}

std::string full_section(const Study& study) {
  std::string text =
      "\n## All parameters, with the bounds\n\nThe error of the whole parameter vector in the patch's own axes.\n\n![Share "
      "of trials inside the ellipsoid of each probability, all parameters](" +
      std::string(full_probability_file) + ")\n\n![Coverage of the 95 % ellipsoid](" +
      std::string(coverage_file) + ")\n" +
      head({"type", "calibrated: NEES/dof mean (median)", "inside 95 % (99 % interval)",
            "paper: NEES/dof mean (median)", "inside 95 % (99 % interval)"});
  for (std::size_t i = 0; i < study.battery.calibrated.size(); ++i) {
    const BatteryRow &ours = study.battery.calibrated[i], &theirs = study.battery.paper[i];
    text += line({words(*ours.type), mean_and_median(ours.full_nees), covered(ours.full_covered, ours.trials),
                  mean_and_median(theirs.full_nees), covered(theirs.full_covered, theirs.trials)});
  }
  return text + "\n∞: the covariance is singular and rules the truth out.\n";
}

std::string bounds_section(const Study& study) {
  std::string text =
      "\n## Bounds\n\nd / d_true over every length of the boundary, mean ± standard deviation of one fit.\n\n![Bounds "
      "against the truth](" +
      std::string(bounds_file) + ")\n" + head({"type", "calibrated", "paper"});
  for (std::size_t i = 0; i < study.battery.calibrated.size(); ++i) {
    const BatteryRow &ours = study.battery.calibrated[i], &theirs = study.battery.paper[i];
    text +=
        line({words(*ours.type), mean_and_deviation(ours.size_ratio), mean_and_deviation(theirs.size_ratio)});
  }
  return text;
}

// Error over predicted standard deviation, of one component, over the trials where both are finite.
std::vector<double> normalised(const BatteryRow& row, Eigen::Index component) {
  std::vector<double> z;
  for (std::size_t i = 0; i < row.surface_errors.size(); ++i) {
    const double value = row.surface_errors[i][component] / row.surface_sigmas[i][component];
    if (std::isfinite(value)) z.push_back(value);
  }
  return z;
}

std::string parameter_section(const Study& study) {
  std::string text =
      "\n## Parameter by parameter\n\nThe surface's own parameters: sd is the scatter of error / predicted standard "
      "deviation (1 when true), bias its\nmean (0 when true). κ curvature, w and tilt rotation, n normal, t "
      "translation, in the patch's axes.\n" +
      head({"type", "parameter", "calibrated: sd", "bias", "paper: sd", "bias"});
  for (std::size_t i = 0; i < study.battery.calibrated.size(); ++i) {
    const BatteryRow &ours = study.battery.calibrated[i], &theirs = study.battery.paper[i];
    const std::vector<std::string> names = test::surface_error_names(ours.type->surface);
    for (std::size_t j = 0; j < names.size(); ++j) {
      const std::vector<double> z = normalised(ours, static_cast<Eigen::Index>(j)),
                                z_paper = normalised(theirs, static_cast<Eigen::Index>(j));
      text += line({words(*ours.type), "`" + names[j] + "`", ratio(test::deviation(z)),
                    with_sign(test::mean(z), 2), ratio(test::deviation(z_paper)),
                    with_sign(test::mean(z_paper), 2)});
    }
  }
  return text;
}

int right(const BatteryRow& row) { return row.chosen[static_cast<std::size_t>(row.type->surface)]; }

std::string choice_line(const std::string& truth, const BatteryRow& row) {
  Cells cells = {truth};
  for (const SurfaceType surface : paraboloids) {
    const int hits = row.chosen[static_cast<std::size_t>(surface)];
    const std::string cell = hits == 0 ? "" : share(hits, row.trials);
    cells.push_back(surface == row.type->surface ? "**" + share(hits, row.trials) + "**" : cell);
  }
  return line(cells);
}

std::string choice_table(const TypeChoice& choice) {
  Cells titles = {"truth"};
  for (const SurfaceType surface : paraboloids) titles.push_back(words(surface));
  std::string rows;
  int hits = 0, trials = 0;
  for (const BatteryRow& row : choice.rows) {
    rows += choice_line(words(row.type->surface), row);
    hits += right(row);
    trials += row.trials;
  }
  const int hits_apart = hits - right(choice.rows.front()) + right(choice.apart);
  return "\n### " + std::string(name(choice.method)) + ", N = " + std::to_string(choice.points) + ": " +
         share(hits, trials) + " right, " + share(hits_apart, trials) + " where curvatures are apart\n" +
         head(titles) + rows + choice_line("elliptic, curvatures apart", choice.apart);
}

std::string choice_section(const Study& study) {
  std::string text =
      "\n## Choice of type\n\nThe type is not forced: step 3 chooses among the five paraboloids, by BIC over refitted "
      "models (`calibrated`) or by\na threshold on the curvatures, 0.1 1/m (`paper`). Rows are the truth, columns what "
      "was chosen. An elliptic paraboloid\nwhose curvatures differ by less than the points can tell is rightly described as circular; "
      "the last row keeps to those\nwhere |κ_x − κ_y| d²/2 is over 1.5 standard deviations of the range noise, d the lesser radius.\n";
  for (const TypeChoice& choice : study.choices) text += choice_table(choice);
  return text;
}

std::string outlier_section(const Study& study) {
  std::string text =
      "\n## A sloppy lasso\n\nA share of the points lies on a plane 2 to 10 cm behind one side. Median surface "
      "NEES/dof, and the share of trials\ninside the 99 % ellipsoid; method `calibrated`.\n" +
      head({"type", "outliers", "plain: median NEES/dof", "inside 99 %", "robust: median NEES/dof",
            "inside 99 %"});
  for (std::size_t i = 0; i + 1 < study.outliers.size(); i += 2) {
    const OutlierCell &plain = study.outliers[i], &robust = study.outliers[i + 1];
    const auto inside = [](const BatteryRow& row) {
      return share(test::inside(row.surface_nees, row.surface_dof, 0.99), row.trials);
    };
    text += line({words(plain.row.type->surface), percent(plain.share, 0),
                  ratio(test::median(plain.row.surface_nees)), inside(plain.row),
                  ratio(test::median(robust.row.surface_nees)), inside(robust.row)});
  }
  return text +
         "\nOn curved surfaces outliers within about four standard deviations of the continued surface cannot be told\n"
         "apart from it: there the covariance stays optimistic, and the fit says so.\n";
}

std::string start_section(const Study& study) {
  std::string text =
      "\n## Where the fit starts\n\nCircular cylinders from any in-plane start: the x axis of step 1's plane is turned "
      "from the true axis by the angle.\nSuccess: converged, the axis within 20° of the true one, the sign of the "
      "curvature right.\n\n![Success against the angle of the start](" +
      std::string(starts_file) + ")\n" +
      head({"angle", "calibrated (99 % interval)", "paper (99 % interval)"});
  for (const StartCell& cell : study.starts) {
    text += line({fixed(cell.degrees, 0) + "°", covered(cell.calibrated, cell.trials),
                  covered(cell.paper, cell.trials)});
  }
  return text;
}

}  // namespace

std::string report(const Study& study) {
  return introduction(study) + surface_section(study) + full_section(study) + bounds_section(study) +
         choice_section(study) + outlier_section(study) + start_section(study) + parameter_section(study);
}

}  // namespace patchlab::calibration
