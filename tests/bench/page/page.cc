#include "tests/bench/page/page.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

namespace patchlab::bench {
namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  std::string line;
  while (std::getline(in, line)) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

}  // namespace

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

std::string date_and_machine() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char date[16];
  std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
  return std::string(date) + ", " + processor() + text(", %u cores", std::thread::hardware_concurrency());
}

bool write_between_marks(const std::string& file, const std::string& mark, const std::string& inner) {
  std::stringstream all;
  all << std::ifstream(file).rdbuf();
  std::string contents = all.str();
  const std::string from = "<!-- " + mark + " -->\n", to = "<!-- end -->";
  const std::size_t begin = contents.find(from), end = contents.find(to, begin);
  if (begin == std::string::npos || end == std::string::npos) return false;
  contents.replace(begin + from.size(), end - begin - from.size(), inner);
  return static_cast<bool>(std::ofstream(file) << contents);
}

}  // namespace patchlab::bench
