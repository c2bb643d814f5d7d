// Files damaged at random, the same way for the same seed on every machine.
#pragma once

#include <string>

#include "engine/base/random.h"

namespace patchlab::test {

// One to three changes: bytes flipped, replaced, cut out or said twice, and what headers, numbers and JSON
// are made of put in.
std::string mutated(std::string file, Random& random);

}  // namespace patchlab::test
