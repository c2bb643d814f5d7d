// Seeded random numbers: the same seed gives the same numbers on every machine (the distributions of
// Boost.Random are specified, those of the standard library are not).
#pragma once

#include <Eigen/Core>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <cstdint>

namespace patchlab {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform() { return boost::random::uniform_01<double>()(engine_); }  // in [0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double normal() { return normal_(engine_); }  // mean 0, standard deviation 1
  std::size_t index(std::size_t size) {         // in [0, size), size > 0
    return boost::random::uniform_int_distribution<std::size_t>(0, size - 1)(engine_);
  }
  Eigen::Vector3d normal3() {
    const double x = normal(), y = normal(), z = normal();
    return {x, y, z};
  }
  Eigen::Vector3d unit3() { return normal3().normalized(); }  // uniform on the sphere

 private:
  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_;
};

}  // namespace patchlab
