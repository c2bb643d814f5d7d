#include "engine/sensor/point_covariances.h"

#include <array>
#include <cmath>
#include <variant>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "engine/base/large_pages.h"

namespace patchlab {
namespace {

// Sigma = along d d' + across M, with d the ray from the sensor to the point: a turn into the frame of the
// points leaves M = I as it is, and takes diag(1, 1, 0) to I - n n', n the optical axis.
struct Weights {
  double along, across;
};

struct OfStereo {
  static constexpr bool across_axis = true;
  explicit OfStereo(const StereoNoise& noise)
      : lateral(noise.pointing / noise.f), along_ray(noise.disparity / (noise.f * noise.baseline)) {}
  Weights operator()(double z, double) const {
    const double l = z * lateral, a = z * along_ray;
    return {a * a, l * l};
  }
  double lateral, along_ray;
};

struct OfDepth {
  static constexpr bool across_axis = true;
  explicit OfDepth(const DepthNoise& model) : noise(model) {}
  Weights operator()(double depth, double) const {
    const double z = std::abs(depth), beyond = z - noise.nearest;
    const double sigma = noise.constant + noise.linear * z + noise.quadratic * beyond * beyond +
                         noise.power_1_5 * z * std::sqrt(z);
    const double l = noise.lateral + noise.lateral_z * z, a = sigma / z;
    return {a * a, l * l};
  }
  DepthNoise noise;
};

struct OfLidar {
  static constexpr bool across_axis = false;
  explicit OfLidar(const LidarNoise& noise)
      : range2(noise.range * noise.range), angle2(noise.angle * noise.angle) {}
  Weights operator()(double, double r2) const { return {range2 / r2 - angle2, r2 * angle2}; }
  double range2, angle2;
};

struct OfIsotropic {
  static constexpr bool across_axis = false;
  explicit OfIsotropic(const IsotropicNoise& noise) : sigma2(noise.sigma * noise.sigma) {}
  Weights operator()(double, double) const { return {0.0, sigma2}; }
  double sigma2;
};

OfStereo weights_of(const StereoNoise& noise) { return OfStereo(noise); }
OfDepth weights_of(const DepthNoise& noise) { return OfDepth(noise); }
OfLidar weights_of(const LidarNoise& noise) { return OfLidar(noise); }
OfIsotropic weights_of(const IsotropicNoise& noise) { return OfIsotropic(noise); }
OfIsotropic weights_of(const NoiseFromFile&) { return OfIsotropic({0.0}); }

template <class Noise>
struct Sensor {
  Noise weights;
  std::array<double, 3> position, axis;
  std::array<double, 9> M;  // as above, row by row
};

// What the weights take: along the optical axis, and the distance squared.
template <class Noise>
Weights weights_at(const Sensor<Noise>& sensor, const double* d) {
  const double z = sensor.axis[0] * d[0] + sensor.axis[1] * d[1] + sensor.axis[2] * d[2];
  return sensor.weights(z, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

// Writes nine numbers for each of the points [first, count), and adds the weights along the rays: a sum that
// is not finite tells that some are not.
template <class Noise>
void write_each(const Sensor<Noise>& sensor, const double* points, std::size_t first, std::size_t count,
                double* covariances, double& sum) {
  for (std::size_t i = first; i < count; ++i) {
    std::array<double, 3> d;
    for (std::size_t k = 0; k < 3; ++k) d[k] = points[3 * i + k] - sensor.position[k];
    const Weights w = weights_at(sensor, d.data());
    sum += w.along;
    for (std::size_t k = 0; k < 9; ++k)
      covariances[9 * i + k] = w.along * (d[k / 3] * d[k % 3]) + w.across * sensor.M[k];
  }
}

#if defined(__x86_64__)
// As write_each, but for the last point, behind which nothing may be read: as many as are returned.
template <class Noise>
[[gnu::target("avx2")]] std::size_t write_by_avx2(const Sensor<Noise>& sensor, const double* points,
                                                  std::size_t count, double* covariances, double& sum) {
  const __m256d position = _mm256_setr_pd(sensor.position[0], sensor.position[1], sensor.position[2], 0.0);
  const __m256d M_first = _mm256_loadu_pd(sensor.M.data()), M_second = _mm256_loadu_pd(sensor.M.data() + 4);
  std::size_t i = 0;
  for (; i + 1 < count; ++i) {
    const __m256d d = _mm256_sub_pd(_mm256_loadu_pd(points + 3 * i), position);
    alignas(32) std::array<double, 4> rays;
    _mm256_store_pd(rays.data(), d);
    const Weights w = weights_at(sensor, rays.data());
    sum += w.along;
    const __m256d along = _mm256_set1_pd(w.along), across = _mm256_set1_pd(w.across);
    const __m256d first = _mm256_mul_pd(_mm256_permute4x64_pd(d, _MM_SHUFFLE(1, 0, 0, 0)),
                                        _mm256_permute4x64_pd(d, _MM_SHUFFLE(0, 2, 1, 0)));  // xx xy xz yx
    const __m256d second = _mm256_mul_pd(_mm256_permute4x64_pd(d, _MM_SHUFFLE(2, 2, 1, 1)),
                                         _mm256_permute4x64_pd(d, _MM_SHUFFLE(1, 0, 2, 1)));  // yy yz zx zy
    double* const to = covariances + 9 * i;
    _mm256_storeu_pd(to, _mm256_add_pd(_mm256_mul_pd(along, first), _mm256_mul_pd(across, M_first)));
    _mm256_storeu_pd(to + 4, _mm256_add_pd(_mm256_mul_pd(along, second), _mm256_mul_pd(across, M_second)));
    to[8] = w.along * (rays[2] * rays[2]) + w.across * sensor.M[8];
  }
  return i;
}
#endif

struct Request {
  const NoiseModel& model;
  const Eigen::Matrix3d& world_from_sensor;
  const Eigen::Vector3d& position;
  std::span<const Eigen::Vector3d> points;
};

template <class Noise>
Sensor<Noise> sensor_with(const Noise& weights, const Request& request) {
  const Eigen::Vector3d n = request.world_from_sensor.col(2);
  const Eigen::Matrix3d M =
      Eigen::Matrix3d::Identity() - (Noise::across_axis ? 1.0 : 0.0) * n * n.transpose();
  Sensor<Noise> sensor{weights, {}, {}, {}};
  Eigen::Map<Eigen::Vector3d>(sensor.position.data()) = request.position;
  Eigen::Map<Eigen::Vector3d>(sensor.axis.data()) = n;
  Eigen::Map<Eigen::Matrix3d>(sensor.M.data()) = M;
  return sensor;
}

// False where one cannot be written so: that of a point at the sensor itself.
template <class Noise>
bool write_all(const Noise& weights, const Request& request, [[maybe_unused]] bool plain,
               std::vector<Eigen::Matrix3d>& all) {
  const Sensor<Noise> sensor = sensor_with(weights, request);
  const double* const points = request.points.front().data();
  double* const covariances = all.front().data();
  std::size_t first = 0;
  double sum = 0.0;
#if defined(__x86_64__)
  if (!plain && __builtin_cpu_supports("avx2"))
    first = write_by_avx2(sensor, points, all.size(), covariances, sum);
#endif
  write_each(sensor, points, first, all.size(), covariances, sum);
  return std::isfinite(sum);
}

std::vector<Eigen::Matrix3d> covariances(const Request& request, bool plain) {
  std::vector<Eigen::Matrix3d> all;
  reserve_large(all, request.points.size());
  all.resize(request.points.size());
  if (all.empty()) return all;
  const bool done =
      std::visit([&](const auto& noise) { return write_all(weights_of(noise), request, plain, all); },
                 request.model.kind);
  for (std::size_t i = 0; !done && i < all.size(); ++i) {
    if (!all[i].allFinite())
      all[i] = covariance(request.model, request.world_from_sensor, request.position, request.points[i]);
  }
  return all;
}

}  // namespace

std::vector<Eigen::Matrix3d> covariances(const NoiseModel& model, const Eigen::Matrix3d& world_from_sensor,
                                         const Eigen::Vector3d& sensor_position,
                                         std::span<const Eigen::Vector3d> points) {
  return covariances({model, world_from_sensor, sensor_position, points}, false);
}

std::vector<Eigen::Matrix3d> covariances_plain(const NoiseModel& model,
                                               const Eigen::Matrix3d& world_from_sensor,
                                               const Eigen::Vector3d& sensor_position,
                                               std::span<const Eigen::Vector3d> points) {
  return covariances({model, world_from_sensor, sensor_position, points}, true);
}

}  // namespace patchlab
