#include "engine/fit/fit_patch.h"

#include "engine/fit/steps.h"

namespace patchlab {

namespace {

Result<FitResult> nine_steps(Result<Workbench> work, const Progress& progress) {
  if (!work) return work.error();
  work->samples.progress = progress;
  fit_plane(*work);  // 1. a plane by least squares
  if (!keep_going(progress, 0.1)) return Error{ErrorCode::cancelled, "The fit was cancelled."};
  fit_surfaces(*work);  // 2. unbounded surfaces by weighted Levenberg-Marquardt
  if (!keep_going(progress, 0.7)) return Error{ErrorCode::cancelled, "The fit was cancelled."};
  refine_type(*work);  // 3. the type that the curvatures ask for
  if (!keep_going(progress, 0.8)) return Error{ErrorCode::cancelled, "The fit was cancelled."};
  choose_boundary(*work);   // 4. its boundary, and the scale that containment gives
  project_points(*work);    // 5. the points on the surface, and their moments
  bound_cylinder(*work);    // 6. a rectangle for cylinders
  bound_revolute(*work);    // 7. a circle for surfaces of revolution
  bound_paraboloid(*work);  // 8. an ellipse for paraboloids
  bound_plane(*work);       // 9. any of the four for planes
  return conclude(*work);
}

}  // namespace

Result<FitResult> fit_patch(const Observations& observations, const FitOptions& options,
                            const Progress& progress) {
  return nine_steps(begin(observations, options), progress);
}

Result<FitResult> refit_patch(const Patch& kept, const Observations& observations, const FitOptions& options,
                              const Progress& progress) {
  return nine_steps(begin_from(kept, observations, options), progress);
}

}  // namespace patchlab
