// The LZF compression of PCD's binary_compressed points.
#pragma once

#include <string_view>
#include <vector>

namespace patchlab {

// No block of LZF grows more than this many times: three bytes stand for at most 264.
constexpr std::size_t lzf_largest_expansion = 88;

// Fills `out` exactly; false where the data are damaged: they end early, refer to before their start, or give
// more or fewer bytes than out.size().
bool lzf_decompress(std::string_view compressed, std::vector<char>& out);

}  // namespace patchlab
