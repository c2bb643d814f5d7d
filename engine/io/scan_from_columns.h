// From point attributes to a Scan: coordinates, colours, labels, covariances and sensor positions, by name.
#pragma once

#include <cstdint>
#include <span>

#include "engine/base/result.h"
#include "engine/io/columns.h"
#include "engine/io/read_scan.h"
#include "engine/scan/scan.h"

namespace patchlab {

// Where the origin of the positions goes. A file of float numbers keeps the origin of its frame unless its
// coordinates are large; numbers of more digits are kept about their middle. Either way no float coordinate
// changes its value.
enum class OriginRule { where_large, always };

// Is it one of the names that carry meaning in a point table: x y z, label, vp_x vp_y vp_z (the position of
// the sensor for that point) and those of covariance_columns.h?
bool is_point_table_column(std::string_view name);

// Fills everything of the scan that comes from its points, from columns of these names and colours: rgb or
// rgba (packed in four bytes), red green blue or r g b (uint8). Precondition: scan.file, encoding and
// viewpoint are set, points > 0. unreadable error: x, y or z is missing, a covariance is incomplete, or the
// coordinates can only be damage.
Result<void> fill_scan(Scan& scan, std::span<const Column> columns, std::size_t points, OriginRule rule,
                       const ReadOptions& options);

// Before anything is allocated: do the positions of `points` points, and `more` bytes beside them, stay
// within the memory limit? fill_scan asks again, for all that it keeps of a point.
Result<void> check_memory(const std::string& name, std::uint64_t points, std::uint64_t more,
                          const ReadOptions& options);

// Memory of one point of such columns, in bytes: what a Scan keeps of it, and what it is made from beside the
// columns.
std::uint64_t memory_of_point(std::span<const Column> columns);

}  // namespace patchlab
