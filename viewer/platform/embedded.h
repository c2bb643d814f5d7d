// A file that viewer/embed.cmake made part of the program.
#pragma once

#include <cstddef>

namespace patchlab::viewer {

struct Embedded {
  const char* file;  // its name, without folders
  const unsigned char* bytes;
  std::size_t size;
};

}  // namespace patchlab::viewer
