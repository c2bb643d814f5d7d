#include "tests/bench/fit/table.h"

#include <cmath>
#include <limits>

#include "engine/fit/rows.h"
#include "tests/bench/page/page.h"

namespace patchlab::bench {
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

std::string when_and_where() { return date_and_machine() + ", " + fastest_rows().name + " kernels"; }

}  // namespace patchlab::bench
