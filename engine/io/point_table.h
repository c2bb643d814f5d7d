// The header row of a point table.
#pragma once

#include <string_view>

namespace patchlab {

// Is this line the header row of a point table: columns named x, y and z among others?
bool is_point_table_header(std::string_view line);

}  // namespace patchlab
