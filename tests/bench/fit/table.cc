#include "tests/bench/fit/table.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#include "engine/fit/rows.h"

namespace patchlab::bench {
namespace {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  std::string line;
  while (std::getline(in, line)) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  char buffer[128];
  std::snprintf(buffer, sizeof buffer, format, numbers...);
  return buffer;
}

}  // namespace

void Collector::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
    const auto items = run.counters.find("items_per_second");
    if (items != run.counters.end()) times_[run.run_name.function_name].push_back(1e6 / items->second.value);
  }
  ConsoleReporter::ReportRuns(runs);
}

double Collector::median(const std::string& name) const {
  const auto found = times_.find(name);
  return found == times_.end() ? std::numeric_limits<double>::quiet_NaN() : quantile(found->second, 0.5);
}

double Collector::spread(const std::string& name) const {
  const auto found = times_.find(name);
  if (found == times_.end()) return std::numeric_limits<double>::quiet_NaN();
  return 0.5 * (quantile(found->second, 0.75) - quantile(found->second, 0.25)) / quantile(found->second, 0.5);
}

std::string duration(double us, double spread) {
  if (std::isnan(us)) return "-";
  const std::string about = text(" ±%.0f %%", 100.0 * spread);
  return (us < 100.0    ? text("%.1f µs", us)
          : us < 1000.0 ? text("%.0f µs", us)
                        : text("%.2f ms", 1e-3 * us)) +
         about;
}

std::string ratio(double of, double to) {
  const double times = of / to;
  if (std::isnan(times)) return "";
  return times < 1.0    ? text(", %.2f ×", times)
         : times < 10.0 ? text(", %.1f ×", times)
                        : text(", %.0f ×", times);
}

std::string exponent(double us, double us_before, std::size_t size, std::size_t size_before) {
  const double grown = std::log(static_cast<double>(size) / static_cast<double>(size_before));
  return text("%.2f", std::log(us / us_before) / grown);
}

std::string when_and_where() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char date[16];
  std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
  return std::string(date) + ", " + processor() + text(", %u cores, ", std::thread::hardware_concurrency()) +
         fastest_rows().name + " kernels";
}

bool write_between_marks(const std::string& file, const std::string& inner) {
  std::stringstream all;
  all << std::ifstream(file).rdbuf();
  std::string contents = all.str();
  const std::string from = "<!-- fits -->\n", to = "<!-- end -->";
  const std::size_t begin = contents.find(from), end = contents.find(to, begin);
  if (begin == std::string::npos || end == std::string::npos) return false;
  contents.replace(begin + from.size(), end - begin - from.size(), inner);
  return static_cast<bool>(std::ofstream(file) << contents);
}

}  // namespace patchlab::bench
