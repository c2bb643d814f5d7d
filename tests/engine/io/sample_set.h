// A patch set with everything a patch set can hold.
#pragma once

#include <Eigen/Core>

#include "engine/base/random.h"
#include "engine/io/patch_set.h"
#include "tests/support/sample_patches.h"

namespace patchlab::test {

inline Patch with_covariance(const Patch& patch, Random& random) {
  const int n = patch.type->size();
  PatchMatrix L(n, n);
  for (double& entry : L.reshaped()) entry = 1e-3 * random.normal();
  return make_patch(*patch.type, boundary(patch), curvatures(patch), axes(patch), centre(patch),
                    L * L.transpose());
}

inline FitSummary sample_fit() {
  FitSummary fit;
  fit.method = FitMethod::paper;
  fit.robust = true;
  fit.containment = 0.95;
  fit.points = 150;
  fit.outliers = 3;
  fit.chi2 = 148.2;
  fit.dof = 146;
  fit.p_value = 0.1 + 0.2;
  fit.iterations = 5;
  fit.residual_rms = 0.0041;
  fit.coverage = 0.93;
  fit.reasons = {{"coverage", 0.5, 0.75, "Half of the patch holds no points."}};
  return fit;
}

inline PatchSource sample_source() {
  PatchSource source;
  source.id = "scan-1";
  source.file = "mug.pcd";
  source.sha256 = "5f0c";
  source.noise = "kinect1";
  source.viewpoint = {Vector3d(0.1, 0.2, 0.3), {0.6, 0.0, 0.0, 0.8}, true};
  return source;
}

// Every sample patch with a covariance, a source, a fit and a provenance.
inline PatchSet sample_set() {
  Random random(3);
  PatchSet set;
  set.sources.push_back(sample_source());
  for (const SamplePatch& sample : sample_patches()) {
    PatchRecord record;
    record.id = sample.label;
    record.name = "the " + sample.label;
    record.frame_id = "camera";
    record.source = "scan-1";
    record.patch = with_covariance(sample.patch, random);
    record.fit = sample_fit();
    record.provenance = {{"region", "region-1"}, {"journal", "mug.patchlab"}};
    set.patches.push_back(record);
  }
  return set;
}

// One patch without covariance, source, fit or provenance.
inline PatchSet designed_set() {
  PatchRecord sole;
  sole.id = "left_sole";
  sole.frame_id = "left_foot";
  sole.patch = sample_patch("", SurfaceType::plane, BoundaryType::rectangle, {0.11, 0.05}, {}).patch;
  PatchSet set;
  set.patches.push_back(sole);
  return set;
}

}  // namespace patchlab::test
