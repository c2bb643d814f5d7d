// What the inspector says of a patch's parameters: names, values and standard deviations in words, and how
// well each is known. Pure text; no ImGui.
#pragma once

#include <string>
#include <vector>

#include "engine/patch/patch.h"

namespace patchlab::viewer {

struct ParameterRow {
  std::string name;    // "κ_x", "tilt x", "centre in plane"; "_" starts a subscript
  std::string value;   // "61.20 mm"; empty for what is a frame's own zero (tilt, centre)
  std::string sigma;   // "± 0.21 mm"
  double share = 0.0;  // how well it is known: see `of`
  std::string of;      // what the share is of: "of its value", "of the patch's size", "of a radian"
};

// In the patch's own axes (covariance_local): shape first, then pose. A patch without a covariance has empty
// sigmas.
std::vector<ParameterRow> parameter_rows(const Patch& patch);

// Share as the length of a bar in [0, 1]: logarithmic, from 0.01 % to 100 %.
double bar_length(double share);

// The words for an entry of local_names(): "kappa_x" is "κ_x", "t_z" is "centre along normal".
std::string local_words(const std::string& local_name);

// The pair with the strongest correlation in the local chart.
struct StrongestPair {
  std::string one, other;
  double correlation = 0.0;
};
StrongestPair strongest_pair(const Patch& patch, const PatchMatrix& correlations);

}  // namespace patchlab::viewer
