// The solver against the certified nonlinear problems of NIST's Statistical Reference Datasets: 27 problems,
// both starts.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <unsupported/Eigen/AutoDiff>
#include <vector>

#include "engine/fit/least_squares.h"

namespace patchlab {
namespace {

constexpr int most_parameters = 9;
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, most_parameters, 1>>;
using Parameters = std::vector<Dual>;
using Row = std::vector<double>;  // y x | y x1 x2

Dual power(const Dual& base, const Dual& exponent) { return exp(Dual(exponent * log(base))); }
Dual square(const Dual& a) { return a * a; }
Dual inverse_tangent(const Dual& a) {
  return Dual(std::atan(a.value()), a.derivatives() / (1.0 + a.value() * a.value()));
}

Dual gauss(const Parameters& b, double x) {
  return b[0] * exp(Dual(-b[1] * x)) + b[2] * exp(Dual(-square(Dual((x - b[3]) / b[4])))) +
         b[5] * exp(Dual(-square(Dual((x - b[6]) / b[7]))));
}
Dual lanczos(const Parameters& b, double x) {
  return b[0] * exp(Dual(-b[1] * x)) + b[2] * exp(Dual(-b[3] * x)) + b[4] * exp(Dual(-b[5] * x));
}
Dual chwirut(const Parameters& b, double x) { return exp(Dual(-b[0] * x)) / (b[1] + b[2] * x); }
Dual cubic_ratio(const Parameters& b, double x) {
  return (b[0] + x * (b[1] + x * (b[2] + x * b[3]))) / (1.0 + x * (b[4] + x * (b[5] + x * b[6])));
}
Dual wave(const Dual& cosine, const Dual& sine, const Dual& period, double x) {
  const Dual angle = 2.0 * std::numbers::pi * x / period;
  return cosine * cos(angle) + sine * sin(angle);
}

struct Problem {
  const char* name;
  Dual (*model)(const Parameters& b, const Row& row);
};
const Problem problems[] = {
    {"Bennett5", [](const Parameters& b,
                    const Row& r) { return Dual(b[0] * power(Dual(b[1] + r[1]), Dual(-1.0 / b[2]))); }},
    {"BoxBOD",
     [](const Parameters& b, const Row& r) { return Dual(b[0] * (1.0 - exp(Dual(-b[1] * r[1])))); }},
    {"Chwirut1", [](const Parameters& b, const Row& r) { return chwirut(b, r[1]); }},
    {"Chwirut2", [](const Parameters& b, const Row& r) { return chwirut(b, r[1]); }},
    {"DanWood",
     [](const Parameters& b, const Row& r) { return Dual(b[0] * exp(Dual(b[1] * std::log(r[1])))); }},
    {"Eckerle4",
     [](const Parameters& b, const Row& r) {
       return Dual(b[0] / b[1] * exp(Dual(-0.5 * square(Dual((r[1] - b[2]) / b[1])))));
     }},
    {"ENSO",
     [](const Parameters& b, const Row& r) {
       const Dual year(12.0, Dual::DerType::Zero());
       return Dual(b[0] + wave(b[1], b[2], year, r[1]) + wave(b[4], b[5], b[3], r[1]) +
                   wave(b[7], b[8], b[6], r[1]));
     }},
    {"Gauss1", [](const Parameters& b, const Row& r) { return gauss(b, r[1]); }},
    {"Gauss2", [](const Parameters& b, const Row& r) { return gauss(b, r[1]); }},
    {"Gauss3", [](const Parameters& b, const Row& r) { return gauss(b, r[1]); }},
    {"Hahn1", [](const Parameters& b, const Row& r) { return cubic_ratio(b, r[1]); }},
    {"Kirby2",
     [](const Parameters& b, const Row& r) {
       const double x = r[1];
       return Dual((b[0] + x * (b[1] + x * b[2])) / (1.0 + x * (b[3] + x * b[4])));
     }},
    {"Lanczos1", [](const Parameters& b, const Row& r) { return lanczos(b, r[1]); }},
    {"Lanczos2", [](const Parameters& b, const Row& r) { return lanczos(b, r[1]); }},
    {"Lanczos3", [](const Parameters& b, const Row& r) { return lanczos(b, r[1]); }},
    {"MGH09",
     [](const Parameters& b, const Row& r) {
       const double x = r[1];
       return Dual(b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3]));
     }},
    {"MGH10", [](const Parameters& b, const Row& r) { return Dual(b[0] * exp(Dual(b[1] / (r[1] + b[2])))); }},
    {"MGH17",
     [](const Parameters& b, const Row& r) {
       return Dual(b[0] + b[1] * exp(Dual(-r[1] * b[3])) + b[2] * exp(Dual(-r[1] * b[4])));
     }},
    {"Misra1a",
     [](const Parameters& b, const Row& r) { return Dual(b[0] * (1.0 - exp(Dual(-b[1] * r[1])))); }},
    {"Misra1b",
     [](const Parameters& b, const Row& r) {
       return Dual(b[0] * (1.0 - 1.0 / square(Dual(1.0 + b[1] * r[1] / 2.0))));
     }},
    {"Misra1c", [](const Parameters& b,
                   const Row& r) { return Dual(b[0] * (1.0 - 1.0 / sqrt(Dual(1.0 + 2.0 * b[1] * r[1])))); }},
    {"Misra1d",
     [](const Parameters& b, const Row& r) { return Dual(b[0] * b[1] * r[1] / (1.0 + b[1] * r[1])); }},
    {"Nelson",
     [](const Parameters& b, const Row& r) { return Dual(b[0] - b[1] * r[1] * exp(Dual(-b[2] * r[2]))); }},
    {"Rat42",
     [](const Parameters& b, const Row& r) { return Dual(b[0] / (1.0 + exp(Dual(b[1] - b[2] * r[1])))); }},
    {"Rat43",
     [](const Parameters& b, const Row& r) {
       return Dual(b[0] / power(Dual(1.0 + exp(Dual(b[1] - b[2] * r[1]))), Dual(1.0 / b[3])));
     }},
    {"Roszman1",
     [](const Parameters& b, const Row& r) {
       return Dual(b[0] - b[1] * r[1] - inverse_tangent(Dual(b[2] / (r[1] - b[3]))) / std::numbers::pi);
     }},
    {"Thurber", [](const Parameters& b, const Row& r) { return cubic_ratio(b, r[1]); }},
};

struct Dataset {
  std::vector<StepVector> starts;
  StepVector certified;
  double residual_sum = 0.0;
  std::vector<Row> rows;
};

std::filesystem::path folder() { return std::filesystem::path(PATCHLAB_SOURCE_DIR) / "../shared/nist"; }

Dataset read_dataset(const std::string& name) {
  std::ifstream in(folder() / (name + ".dat"));
  Dataset data;
  std::vector<std::array<double, 3>> parameters;
  bool in_data = false;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string first, equals;
    if (in_data) {
      Row row;
      for (double value; words >> value;) row.push_back(value);
      if (!row.empty()) data.rows.push_back(row);
    } else if (line.rfind("Data:", 0) == 0) {
      in_data = static_cast<bool>(words >> first >> equals) && equals == "y";
    } else if (line.rfind("Residual Sum of Squares:", 0) == 0) {
      data.residual_sum = std::stod(line.substr(line.find(':') + 1));
    } else if (words >> first >> equals && equals == "=" && first.size() == 2 && first[0] == 'b') {
      std::array<double, 3> values{};
      words >> values[0] >> values[1] >> values[2];
      parameters.push_back(values);
    }
  }
  const auto n = static_cast<Eigen::Index>(parameters.size());
  data.starts.assign(2, StepVector(n));
  data.certified.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& values = parameters[static_cast<std::size_t>(i)];
    data.starts[0][i] = values[0];
    data.starts[1][i] = values[1];
    data.certified[i] = values[2];
  }
  return data;
}

class NistProblem {
 public:
  using State = StepVector;
  NistProblem(const Problem& problem, const Dataset& data) : problem_(problem), data_(data) {}

  NormalEquations evaluate(const StepVector& b) const {
    const Eigen::Index n = b.size();
    NormalEquations equations{0.0, StepMatrix::Zero(n, n), StepVector::Zero(n)};
    Parameters dual;
    for (Eigen::Index i = 0; i < n; ++i) dual.emplace_back(b[i], most_parameters, i);
    const bool logarithm = std::string(problem_.name) == "Nelson";
    for (const Row& row : data_.rows) {
      const Dual model = problem_.model(dual, row);
      const double F = model.value() - (logarithm ? std::log(row[0]) : row[0]);
      const StepVector F_p = model.derivatives().head(n);
      equations.cost += F * F;
      equations.A += F_p * F_p.transpose();
      equations.b += F * F_p;
    }
    return equations;
  }
  StepVector retract(const StepVector& b, const StepVector& step) const { return b + step; }

 private:
  const Problem& problem_;
  const Dataset& data_;
};

double digits(double value, double certified) {
  const double error = std::abs(value - certified) / std::abs(certified);
  return error == 0.0 ? 15.0 : std::min(15.0, -std::log10(error));
}

class Nist : public testing::TestWithParam<Problem> {};

TEST_P(Nist, BothStartsReachFourCertifiedDigits) {
  if (!std::filesystem::exists(folder())) GTEST_SKIP() << "no reference data beside the project";
  const Dataset data = read_dataset(GetParam().name);
  ASSERT_FALSE(data.rows.empty());
  ASSERT_FALSE(data.starts[0].size() == 0);
  const NistProblem problem(GetParam(), data);
  for (const StepVector& start : data.starts) {
    StepVector b = start;
    LeastSquaresOptions options;
    options.max_iterations = 5000;
    options.stop = 1e-14 * data.residual_sum;
    const LeastSquaresSummary summary = minimise(problem, b, options);
    double least = 15.0;
    for (Eigen::Index i = 0; i < b.size(); ++i) least = std::min(least, digits(b[i], data.certified[i]));
    EXPECT_GE(least, 4.0) << "from " << start.transpose() << " to " << b.transpose() << " in "
                          << summary.iterations << " iterations, sum of squares " << summary.at_solution.cost;
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, Nist, testing::ValuesIn(problems),
                         [](const auto& case_) { return std::string(case_.param.name); });

}  // namespace
}  // namespace patchlab
