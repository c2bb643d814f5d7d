// The colour of a region and of its patches, where somebody chose one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace patchlab {

using Colour = std::array<std::uint8_t, 3>;  // sRGB

// "#e69f00", and back: six digits in either case, otherwise nothing.
std::string to_text(const Colour& colour);
std::optional<Colour> colour_from_text(const std::string& text);

}  // namespace patchlab
