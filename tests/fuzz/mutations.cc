#include "tests/fuzz/mutations.h"

#include <iterator>

namespace patchlab::test {
namespace {

constexpr std::size_t longest_piece = 8;

std::string random_piece(Random& random) {
  static const std::string pieces[] = {"-1",
                                       "0",
                                       "4294967295",
                                       "99999999999",
                                       "18446744073709551615",
                                       "1e9",
                                       "1e308",
                                       "1e-320",
                                       "nan",
                                       "inf",
                                       " ",
                                       "\n",
                                       "\r\n",
                                       "\t",
                                       ",",
                                       ":",
                                       "\"",
                                       "{",
                                       "}",
                                       "[",
                                       "]",
                                       "<",
                                       ">",
                                       "x",
                                       "null",
                                       "#",
                                       "\\",
                                       "/",
                                       "%s%n",
                                       "-",
                                       "\xFF",
                                       std::string(1, '\0'),
                                       std::string(4, '\xFF')};
  return pieces[random.index(std::size(pieces))];
}

void change(std::string& file, Random& random) {
  const std::size_t at = random.index(file.size());
  switch (random.index(7)) {
    case 0:
      file[at] = static_cast<char>(random.index(256));
      break;
    case 1:
      file[at] = static_cast<char>(file[at] ^ 1 << random.index(8));
      break;
    case 2:
      file.insert(at, random_piece(random));
      break;
    case 3:
      file.replace(at, 1, random_piece(random));
      break;
    case 4:
      file.erase(at, 1 + random.index(longest_piece));
      break;
    case 5:
      file.insert(random.index(file.size()), file.substr(at, 1 + random.index(file.size())));
      break;
    default:
      if (random.index(4) == 0) file.resize(at);
  }
}

}  // namespace

std::string mutated(std::string file, Random& random) {
  for (std::size_t left = 1 + random.index(3); left > 0 && !file.empty(); --left) change(file, random);
  return file;
}

}  // namespace patchlab::test
