#include "engine/fit/foot_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patchlab {

double footprint(const Samples& samples, const SurfaceState& state, std::size_t i, const Residual& r) {
  constexpr double least_cosine = 0.15;
  if (samples.robust[i] == 0.0) return 0.0;
  const std::optional<Vector3d>& axis = samples.observations->optical_axis;
  if (!axis) return 1.0;
  const Vector3d n = r.g.normalized();
  const Vector3d from_camera = state.c + state.R * r.x - samples.viewpoint(i);
  const Vector3d ray = from_camera.normalized();
  const double depth = axis->dot(from_camera), cos_psi = std::abs(axis->dot(ray));
  const double facing = std::max(std::abs(n.dot(state.R.transpose() * ray)), least_cosine);
  return std::max(depth * depth * cos_psi * std::abs(n.z()) / facing, 0.0);
}

Footprints::Footprints(const Samples& samples, const SampleRows& rows, const SurfaceState& state,
                       const MomentKernel& kernel)
    : samples_(samples), rows_(rows), state_(state), kernel_(kernel) {
  if (!samples.observations->optical_axis) return;
  const Vector3d at = to_local(state, samples.viewpoint(0)),
                 axis = state.R.transpose() * *samples.observations->optical_axis;
  for (Eigen::Index i = 0; i < 3; ++i) {
    camera_.at[i] = at[i];
    camera_.axis[i] = axis[i];
  }
}

void Footprints::count(std::size_t block, double* counted) const {
  for (std::size_t i = 0; i < block_size; ++i) {
    const std::size_t sample = block * block_size + i;
    counted[i] = sample < samples_.size() && samples_.robust[sample] != 0.0 ? 1.0 : 0.0;
  }
}

void Footprints::weigh(std::size_t block, const RowBlock& rows, double* weight) const {
  count(block, weight);
  if (!samples_.observations->optical_axis) return;
  if (samples_.observations->viewpoints.empty()) {
    return kernel_.footprints(rows_.surface(), camera_, rows, weight, rows_.lanes_of(block), weight);
  }
  for (std::size_t i = 0; i < rows_.count(block); ++i) {
    weight[i] = footprint(samples_, state_, block * block_size + i, rows_.residual(rows, i));
  }
}

void settle_padding(std::size_t count, RowBlock& rows) {
  for (std::size_t i = count; i < block_size; ++i) {
    for (auto& x : rows.x) x[i] = 0.0;
    rows.sigma[i] = 1.0;
  }
}

FootPoints room_for_feet(const Samples& samples) {
  return {std::vector<Vector3d>(samples.size()), std::vector<double>(samples.size()),
          std::vector<double>(samples.size())};
}

void put_feet(const RowBlock& rows, const double* weight, std::size_t block, std::size_t count,
              FootPoints& feet) {
  const std::size_t at = block * block_size;
  for (std::size_t i = 0; i < count; ++i) feet.x[at + i] = {rows.x[0][i], rows.x[1][i], rows.x[2][i]};
  std::copy_n(weight, count, feet.weight.data() + at);
  std::copy_n(rows.row[chart_size], count, feet.F.data() + at);
}

void scale_weights(double by, FootPoints& feet) {
  for (double& weight : feet.weight) weight *= by;
}

FootPoints foot_points(const Samples& samples, const SurfaceFit& fit) {
  FootPoints feet = room_for_feet(samples);
  const SampleRows rows(samples, fit.model, fit.state, Distance::exact);
  const Footprints footprints(samples, rows, fit.state);
  for_each_chunk(rows.blocks(), blocks_a_part(rows.blocks()), [&](const Chunk& part) {
    RowBlock block;
    alignas(64) double weight[block_size];
    for (std::size_t b = part.first; b < part.last; ++b) {
      rows.evaluate(b, block);
      footprints.weigh(b, block, weight);
      put_feet(block, weight, b, rows.count(b), feet);
    }
  });
  scale_weights(1.0 / std::accumulate(feet.weight.begin(), feet.weight.end(), 0.0), feet);
  return feet;
}

}  // namespace patchlab
