// Point tables: rows of numbers, with a header row or without.
#pragma once

#include <string_view>

namespace patchlab {

// Does a point table begin here: a line, comments and blank lines left out, that names columns x, y and z
// among others, or that holds three numbers at least?
bool is_point_table(std::string_view bytes);

}  // namespace patchlab
