#include "tests/bench/readers/pcl_readers.h"

namespace patchlab::bench {

bool has_pcl_readers() { return false; }
std::size_t read_by_pcl(const std::string&) { return 0; }

}  // namespace patchlab::bench
