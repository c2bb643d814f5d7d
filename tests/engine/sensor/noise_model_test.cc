#include "engine/sensor/noise_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "tests/support/seeded_random.h"

namespace patchlab {
namespace {

using testing::HasSubstr;

NoiseModel model(std::string_view specification) {
  const Result<NoiseModel> parsed = noise_model(specification);
  if (!parsed) ADD_FAILURE() << parsed.error().message;
  return parsed ? *parsed : NoiseModel{};
}

std::string refusal(std::string_view specification) {
  const Result<NoiseModel> parsed = noise_model(specification);
  if (parsed) return "accepted";
  EXPECT_EQ(parsed.error().code, ErrorCode::usage);
  return parsed.error().message;
}

TEST(NoiseModel, StereoParametersAreReadByName) {
  const NoiseModel parsed = model("stereo:disparity=0.1,f=600,baseline=0.05,pointing=0.2");
  const auto& stereo = std::get<StereoNoise>(parsed.kind);
  EXPECT_EQ(stereo.f, 600.0);
  EXPECT_EQ(stereo.baseline, 0.05);
  EXPECT_EQ(stereo.pointing, 0.2);
  EXPECT_EQ(stereo.disparity, 0.1);
  EXPECT_FALSE(parsed.assumed);
  EXPECT_EQ(parsed.specification, "stereo:disparity=0.1,f=600,baseline=0.05,pointing=0.2");
}

TEST(NoiseModel, ParametersLeftOutAreThoseOfTheFirstKinect) {
  for (const char* specification : {"kinect1", "stereo", "stereo:f=525"}) {
    const auto stereo = std::get<StereoNoise>(model(specification).kind);
    EXPECT_EQ(stereo.f, 525.0);
    EXPECT_EQ(stereo.baseline, 0.075);
    EXPECT_EQ(stereo.pointing, 0.35);
    EXPECT_EQ(stereo.disparity, 0.17);
  }
}

TEST(NoiseModel, PlainModelsAreRead) {
  EXPECT_EQ(std::get<IsotropicNoise>(model("isotropic:0.002").kind).sigma, 0.002);
  EXPECT_TRUE(model("from_file").from_file());
  EXPECT_TRUE(model("estimated:0.002").assumed);
}

TEST(NoiseModel, WrongSpecificationsAreUsageErrorsThatSayWhatIsKnown) {
  EXPECT_THAT(refusal("kinect9"), HasSubstr("the models are from_file, stereo, lidar, isotropic"));
  EXPECT_THAT(refusal(""), HasSubstr("the models are"));
  EXPECT_THAT(refusal("stereo:g=1"), HasSubstr("the model takes f, baseline, pointing, disparity"));
  EXPECT_THAT(refusal("stereo:f=1,f=2"), HasSubstr("'f' is given twice"));
  EXPECT_THAT(refusal("kinect1:f=1"), HasSubstr("takes no parameters"));
  for (const char* number : {"", "0", "-1", "nan", "inf", "1e999", "one", "1 ", "1px", "0x1"}) {
    EXPECT_THAT(refusal(std::string("isotropic:") + number), HasSubstr("positive number")) << number;
    EXPECT_THAT(refusal(std::string("stereo:baseline=") + number), HasSubstr("positive number")) << number;
  }
}

// The printed digits of a covariance computed elsewhere: z = 1 m at pixel (200, 100) from the principal
// point.
TEST(StereoNoise, AgreesWithTheWorkedExample) {
  const Eigen::Matrix3d cov = covariance_in_sensor(model("kinect1"), {200.0 / 525, 100.0 / 525, 1.0});
  const Eigen::Matrix3d expected = (Eigen::Matrix3d() << 3.1496e-6, 1.3526e-6, 7.1011e-6,  //
                                    1.3526e-6, 1.1207e-6, 3.5506e-6,                       //
                                    7.1011e-6, 3.5506e-6, 1.86405e-5)
                                       .finished();
  const Eigen::Matrix3d last_digit = Eigen::Matrix3d::Constant(0.5e-10);
  EXPECT_TRUE(((cov - expected).array().abs() <= last_digit.array()).all()) << cov;
  const Eigen::Vector3d sigma = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cov).eigenvalues().cwiseSqrt();
  EXPECT_NEAR(sigma(0), 0.61e-3, 0.005e-3);
  EXPECT_NEAR(sigma(1), 0.67e-3, 0.005e-3);
  EXPECT_NEAR(sigma(2), 4.70e-3, 0.005e-3);
}

// Standard deviations along the ray at 1, 2 and 4 m in the middle of the picture, as printed in the sources'
// units.
TEST(DepthNoise, AgreesWithTheNumbersOfItsSources) {
  const auto depth_sigma = [](const char* specification, double z) {
    return std::sqrt(covariance_in_sensor(model(specification), {0.0, 0.0, z})(2, 2));
  };
  const std::pair<const char*, std::array<double, 3>> table[] = {
      {"kinect1", {0.0043, 0.0173, 0.069}},
      {"khoshelham", {0.0014, 0.0057, 0.0228}},
      {"nguyen", {0.0019, 0.0061, 0.0258}},
      {"realsense_d435", {0.0038, 0.0151, 0.0604}}};
  for (const auto& [name, sigmas] : table) {
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(depth_sigma(name, std::exp2(i)), sigmas[i], 0.00005 + 0.002 * sigmas[i]) << name;
  }
  // 1.5 - 0.5 z + 0.3 z^2 + 0.1 z^1.5 (1/4) mm at z = 4: 1.5 - 2 + 4.8 + 0.2
  EXPECT_NEAR(depth_sigma("kinect2", 4.0), 0.0045, 1e-12);
  EXPECT_NEAR(depth_sigma("azure_kinect", 2.0), 0.017, 1e-12);
}

TEST(DepthNoise, LongAxisIsTheRayWhereDepthErrorsAreLargest) {
  const Eigen::Vector3d point(0.5, -0.3, 2.0);
  for (const char* name : {"khoshelham", "azure_kinect", "realsense_d435"}) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance_in_sensor(model(name), point));
    EXPECT_GT(std::abs(axes.eigenvectors().col(2).dot(point.normalized())), std::cos(0.06)) << name;
  }
}

TEST(LidarNoise, HasItsDeviationsAlongAndAcrossTheRay) {
  const Eigen::Vector3d point(-3.0, 4.0, 12.0);  // 13 m away
  const Eigen::Matrix3d cov = covariance_in_sensor(model("lidar:range=0.02,angle=0.001"), point);
  const Eigen::Vector3d along = point.normalized(), across = along.unitOrthogonal();
  EXPECT_NEAR(std::sqrt(along.dot(cov * along)), 0.02, 1e-12);
  EXPECT_NEAR(std::sqrt(across.dot(cov * across)), 0.013, 1e-12);
  EXPECT_NEAR(along.dot(cov * across), 0.0, 1e-15);
  EXPECT_EQ(std::get<LidarNoise>(model("lidar").kind).range, 0.02);
}

TEST(StereoNoise, IsTheFirstOrderImageOfPixelAndDisparityNoise) {
  const double f = 525, b = 0.075, pointing = 0.35, disparity = 0.17;
  const auto point = [&](const Eigen::Vector3d& uvd) {  // of pixel coordinates and disparity
    const double z = f * b / uvd.z();
    return Eigen::Vector3d(uvd.x() * z / f, uvd.y() * z / f, z);
  };
  const Eigen::Vector3d uvd(-140, 60, 20);
  Eigen::Matrix3d J_point_uvd;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = 1e-4 * Eigen::Vector3d::Unit(k);
    J_point_uvd.col(k) = (point(uvd + step) - point(uvd - step)) / 2e-4;
  }
  const Eigen::Vector3d variances(pointing * pointing, pointing * pointing, disparity * disparity);
  const Eigen::Matrix3d expected = J_point_uvd * variances.asDiagonal() * J_point_uvd.transpose();
  EXPECT_TRUE(covariance_in_sensor(model("kinect1"), point(uvd)).isApprox(expected, 1e-8));
}

TEST(NoiseModel, CovariancesAreSymmetricAndNowhereNegative) {
  test::SeededRandom random;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d point(random.normal(), random.normal(), random.uniform(0.3, 8.0));
    for (const char* specification : {"kinect1", "khoshelham", "nguyen", "kinect2", "azure_kinect",
                                      "realsense_d435", "lidar", "isotropic:0.003"}) {
      const Eigen::Matrix3d cov = covariance(model(specification), Viewpoint{}, point);
      EXPECT_EQ(cov, cov.transpose());
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cov).eigenvalues()(0), 0.0);
    }
  }
}

TEST(NoiseModel, TurnsWithTheSensor) {
  test::SeededRandom random;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Quaterniond turn =
        Eigen::AngleAxisd(random.uniform(0, 3), random.unit3()) * Eigen::Quaterniond::Identity();
    Viewpoint viewpoint;
    viewpoint.position = random.normal3();
    viewpoint.quaternion_xyzw = {turn.x(), turn.y(), turn.z(), turn.w()};
    const Eigen::Vector3d point_sensor(0.3, -0.2, 1.7);
    const Eigen::Matrix3d R = turn.toRotationMatrix();
    const Eigen::Matrix3d expected = R * covariance_in_sensor(model("kinect1"), point_sensor) * R.transpose();
    const Eigen::Vector3d point = R * point_sensor + viewpoint.position;
    EXPECT_TRUE(covariance(model("kinect1"), viewpoint, point).isApprox(expected, 1e-10));
  }
}

TEST(NoiseHelp, ShowsEveryModel) {
  for (const char* name :
       {"from_file", "stereo:", "kinect1", "khoshelham", "nguyen", "realsense_d435", "kinect2",
        "azure_kinect", "lidar:range=", "isotropic:", "estimated:", "Source:"}) {
    EXPECT_THAT(noise_help(), HasSubstr(name));
  }
}

// A plane with noise along its normal, points `spacing` apart.
Scan noisy_plane(double spacing, double sigma, int side) {
  test::SeededRandom random;
  Scan scan;
  for (int i = 0; i < side * side; ++i) {
    const Eigen::Vector3d point(spacing * (i % side), spacing * (i / side), 1.0 + sigma * random.normal());
    scan.positions.push_back(point.cast<float>());
  }
  scan.width = static_cast<std::uint32_t>(scan.size());
  scan.finite.assign(scan.size(), 1);
  scan.finite_count = scan.size();
  return scan;
}

double estimated_sigma(const Scan& scan) {
  const NoiseModel estimate = default_noise_model(scan);
  EXPECT_TRUE(estimate.assumed);
  EXPECT_THAT(estimate.specification, testing::StartsWith("estimated:"));
  const double sigma = std::get<IsotropicNoise>(estimate.kind).sigma;
  EXPECT_EQ(std::get<IsotropicNoise>(model(estimate.specification).kind).sigma, sigma)
      << "does not read back";
  return sigma;
}

TEST(DefaultNoiseModel, EstimatesTheNoiseOfAPlaneWhateverItsDensity) {
  EXPECT_NEAR(estimated_sigma(noisy_plane(0.02, 0.002, 60)), 0.002, 0.0002);
  EXPECT_NEAR(estimated_sigma(noisy_plane(0.002, 0.002, 100)), 0.002, 0.0004);
}

TEST(DefaultNoiseModel, EstimatesTheSameFromPartOfMoreThanAMillionPoints) {
  EXPECT_NEAR(estimated_sigma(noisy_plane(0.004, 0.002, 1100)), 0.002, 0.0002);
}

TEST(DefaultNoiseModel, CountsRepeatedPointsOnce) {
  const Scan once = noisy_plane(0.02, 0.002, 40);
  Scan often = once;
  for (int i = 0; i < 5; ++i)
    often.positions.insert(often.positions.end(), once.positions.begin(), once.positions.end());
  often.finite.assign(often.size(), 1);
  often.finite_count = often.size();
  EXPECT_NEAR(estimated_sigma(often), 0.002, 0.0003);
}

TEST(DefaultNoiseModel, StaysPositiveWhereThereIsNothingToMeasure) {
  EXPECT_EQ(estimated_sigma(noisy_plane(0.02, 0.0, 20)), 1e-6);
  EXPECT_EQ(estimated_sigma(noisy_plane(0.02, 0.0, 2)), 0.001);
}

TEST(DefaultNoiseModel, IsThePaperSKinectForGridsAndTheFileSOwnBeforeAll) {
  Scan scan = noisy_plane(0.02, 0.001, 10);
  scan.width = scan.height = 10;
  const NoiseModel kinect = default_noise_model(scan);
  EXPECT_EQ(kinect.specification, "kinect1");
  EXPECT_TRUE(kinect.assumed);
  scan.covariances.assign(scan.size(), {1e-6, 0, 0, 1e-6, 0, 1e-6});
  EXPECT_TRUE(default_noise_model(scan).from_file());
  EXPECT_FALSE(default_noise_model(scan).assumed);
}

}  // namespace
}  // namespace patchlab
