// Text and bytes of exported files.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <string>
#include <string_view>

#include "engine/io/patch_set.h"

namespace patchlab {

static_assert(std::endian::native == std::endian::little, "bytes are written as they lie in memory");

template <class T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The shortest decimal that reads back to the same bits, whatever the locale.
std::string decimal(double value);
std::string decimals(const Eigen::Ref<const Eigen::VectorXd>& values, std::string_view between = " ");

// Ids and names are the user's: without control characters, for a comment or a header that is one line.
std::string one_line(std::string_view text);
// With &, <, >, " and ' as XML entities, on one line.
std::string xml(std::string_view text);
// Of letters, digits and _ only, starting with a letter: for names of files, topics and links. `number` makes
// it unique.
std::string plain_name(std::string_view text, std::size_t number);

// The one frame of the patches; refused error where they stand in several.
Result<std::string> common_frame(const PatchSet& set, std::string_view format);

}  // namespace patchlab
