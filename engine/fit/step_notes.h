// The nine steps of a fit as its report tells them: kept as numbers, put into words where somebody reads
// them.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace patchlab {

struct FitReport;

enum class Step { plane, surface, type, boundary, projection, bound };

struct StepNote {
  Step step;
  std::string_view what = {};  // name of a surface or of an outline, which outlives the note
  // plane: its normal; surface: chi-square, iterations and both curvatures (1/m); boundary: the containment;
  // projection: how many points; bound: its lengths (m).
  std::array<double, 5> numbers = {};
  int count = 0;  // of numbers
};

// A sentence a step, in their order.
std::vector<std::string> steps_in_words(const FitReport& report);

}  // namespace patchlab
