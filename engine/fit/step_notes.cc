#include "engine/fit/step_notes.h"

#include <algorithm>
#include <cstdio>

#include "engine/fit/fit_patch.h"

namespace patchlab {
namespace {

template <class... Numbers>
std::string formatted(const char* format, Numbers... numbers) {
  char text[256];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

std::string spelled(std::string_view name) {
  std::string text(name);
  std::ranges::replace(text, '_', ' ');
  return text;
}

std::string least_areas(const std::vector<OutlineCandidate>& outlines) {
  std::string text;
  for (const OutlineCandidate& outline : outlines) {
    text += (text.empty() ? "; least areas, best first: " : ", ") + std::string(name(outline.boundary)) +
            formatted(" %.4g m^2", outline.area);
  }
  return text;
}

std::string lengths(const StepNote& note) {
  std::string text;
  for (int i = 0; i < note.count; ++i)
    text += formatted(i == 0 ? "%.4g" : ", %.4g", note.numbers[static_cast<std::size_t>(i)]);
  return text;
}

std::string in_words(const StepNote& note, const FitReport& report) {
  const auto& [a, b, c, d, e] = note.numbers;
  switch (note.step) {
    case Step::plane:
      return formatted("1. plane by least squares: normal (%.4f, %.4f, %.4f)", a, b, c);
    case Step::surface:
      return "2. " + spelled(note.what) +
             formatted(": chi-square %.2f after %.0f iterations, curvature (%.4g, %.4g) 1/m", a, b, c, d);
    case Step::type:
      return "3. type: " + spelled(note.what) + ", " + report.candidates.front().reason;
    case Step::boundary:
      return "4. boundary: " + std::string(note.what) + formatted(", containment %.4g", a) +
             least_areas(report.outlines);
    case Step::projection:
      return formatted("5. %.0f points projected", a);
    case Step::bound:
      return "6-9. " + std::string(note.what) + " with d = " + lengths(note);
  }
  return {};
}

}  // namespace

std::vector<std::string> steps_in_words(const FitReport& report) {
  std::vector<std::string> all;
  for (const StepNote& note : report.steps) all.push_back(in_words(note, report));
  return all;
}

}  // namespace patchlab
