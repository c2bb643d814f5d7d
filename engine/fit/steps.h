// The nine steps of Section IV as functions over one workbench; engine/fit/fit_patch.cc calls them in order.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/fit/choose_type.h"
#include "engine/fit/fit_boundary.h"
#include "engine/fit/fit_patch.h"
#include "engine/fit/fit_surface.h"
#include "engine/fit/moments.h"
#include "engine/fit/samples.h"

namespace patchlab {

struct Workbench {
  FitOptions options;
  BoundsMethod bounds = BoundsMethod::extent;
  double containment = 1.0;  // Gamma
  Samples samples;
  std::optional<SurfaceState> kept;  // the surface that is refitted, about samples.origin
  std::vector<Finding> notes;        // warnings met on the way

  SurfaceState plane;       // step 1
  SurfaceFit plane_fit;     //         refitted with covariances, in the paper's method only
  bool noise_holds = true;  //         half of the points lie on a quadric within the stated noise
  double robust_scale = 1.0;
  std::vector<SurfaceFit> fits;  // step 2: one a candidate model
  Choice choice;                 // step 3
  SurfaceFit surface;            //         the one that was chosen
  SurfaceType surface_type{};    //         and its name in Table I
  PatchPlan plan;                // step 4
  std::vector<OutlineCandidate> outlines;
  FootPoints feet;  // step 5
  MomentVector moments = MomentVector::Zero();
  JointCovariance cov_joint;
  Patch patch;  // steps 6 to 9
  std::vector<StepNote> log;
};

// Options that make sense, points that span a surface. usage or no_finite_fit otherwise.
Result<Workbench> begin(const Observations& observations, const FitOptions& options);

// The same for a refit of a kept patch: its type and its outline are named, its surface is the start.
Result<Workbench> begin_from(const Patch& kept, const Observations& observations, const FitOptions& options);

void fit_plane(Workbench& work);         // step 1
void fit_surfaces(Workbench& work);      // step 2
void refine_type(Workbench& work);       // step 3
void choose_boundary(Workbench& work);   // step 4
void project_points(Workbench& work);    // step 5
void bound_cylinder(Workbench& work);    // step 6: cylindric paraboloid, circular cylinder
void bound_revolute(Workbench& work);    // step 7: circular paraboloid, sphere
void bound_paraboloid(Workbench& work);  // step 8: elliptic and hyperbolic paraboloid
void bound_plane(Workbench& work);       // step 9

// The conventional description of the patch, validated, with the report.
Result<FitResult> conclude(Workbench& work);

}  // namespace patchlab
