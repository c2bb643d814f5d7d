// A fitted patch as a short table for people.
#pragma once

#include <string>

#include "engine/project/document.h"

namespace patchlab {

std::string fit_table(const Document& document, const PatchEntry& patch);

}  // namespace patchlab
