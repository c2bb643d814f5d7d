#include <iostream>

#include "engine/base/file.h"
#include "engine/io/patch_set.h"

int main(int, char** arguments) {
  const patchlab::Result<patchlab::Bytes> bytes = patchlab::read_file(arguments[1]);
  const auto set = patchlab::read_patch_set(patchlab::as_text(*bytes), arguments[1]);
  if (!set) return std::cerr << set.error().message << '\n', 1;
  for (const patchlab::PatchRecord& record : set->patches)
    std::cout << record.id << ' ' << patchlab::surface_area(record.patch) << '\n';
}
