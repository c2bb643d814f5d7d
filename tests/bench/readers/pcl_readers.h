// The same by PCL.
#pragma once

#include <string>

namespace patchlab::bench {

bool has_pcl_readers();
// How many points a file of x y z and colour holds; it is a PLY or a PCD by its name.
std::size_t read_by_pcl(const std::string& file);

}  // namespace patchlab::bench
