#include "engine/scan/survey.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "engine/base/parallel.h"

namespace patchlab {
namespace {

// The value with this share of the others below it.
float quantile(std::vector<float>& values, double share) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * last);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// One value of every finite point.
template <class Value>
void gather_finite(const Scan& scan, const Value& value, std::vector<float>& values) {
  values.clear();
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.finite[i]) values.push_back(value(scan.positions[i]));
  }
}

std::size_t count_far(const Scan& scan) {
  std::vector<float> values;
  values.reserve(scan.finite_count);
  Eigen::Vector3f middle;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    gather_finite(
        scan, [axis](const Eigen::Vector3f& p) { return p(axis); }, values);
    middle(axis) = quantile(values, 0.5);
  }
  gather_finite(
      scan, [&](const Eigen::Vector3f& p) { return (p - middle).stableNorm(); }, values);
  const double limit = far_factor * static_cast<double>(quantile(values, 0.9));
  return static_cast<std::size_t>(
      std::ranges::count_if(values, [&](float distance) { return static_cast<double>(distance) > limit; }));
}

// Equal points have equal hashes: 0 and -0 are one number.
std::uint32_t hash_of(const Eigen::Vector3f& p) {
  std::uint64_t mixed = 0;
  for (const float coordinate : {p.x(), p.y(), p.z()})
    mixed = (mixed ^ std::bit_cast<std::uint32_t>(coordinate + 0.0F)) * 0x9e3779b97f4a7c15ULL;
  return static_cast<std::uint32_t>(mixed >> 32);
}

std::uint32_t index_in(std::uint64_t entry) { return static_cast<std::uint32_t>(entry); }

// Among points of one hash.
std::size_t count_equal(const Scan& scan, std::span<std::uint64_t> entries) {
  const auto key = [&](std::uint64_t entry) {
    const Eigen::Vector3f& p = scan.positions[index_in(entry)];
    return std::tuple(p.x(), p.y(), p.z());
  };
  std::ranges::sort(entries, {}, key);
  std::size_t equal = 0;
  for (std::size_t i = 1; i < entries.size(); ++i) equal += key(entries[i]) == key(entries[i - 1]) ? 1 : 0;
  return equal;
}

// Sorted by hash, in an entry of eight bytes with the index, since a copy of the points would be half as
// large again.
std::size_t count_duplicates(const Scan& scan) {
  std::vector<std::uint64_t> entries;
  entries.reserve(scan.finite_count);
  for (std::uint32_t i = 0; i < scan.size(); ++i) {
    if (scan.finite[i]) entries.push_back(std::uint64_t{hash_of(scan.positions[i])} << 32 | i);
  }
  std::ranges::sort(entries);
  std::size_t duplicates = 0;
  for (auto begin = entries.begin(); begin != entries.end();) {
    const auto end =
        std::find_if(begin, entries.end(), [&](std::uint64_t entry) { return entry >> 32 != *begin >> 32; });
    if (end - begin > 1) duplicates += count_equal(scan, {begin, end});
    begin = end;
  }
  return duplicates;
}

}  // namespace

Survey survey(const Scan& scan) {
  if (scan.finite_count == 0) return {};
  Survey found;
  for_each_chunk(2, 1, [&](const Chunk& half) {
    if (half.number == 0)
      found.duplicates = count_duplicates(scan);
    else
      found.far_outliers = count_far(scan);
  });
  return found;
}

}  // namespace patchlab
