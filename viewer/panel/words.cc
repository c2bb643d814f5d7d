#include <algorithm>

#include "viewer/panel/panels.h"

namespace patchlab::viewer {

namespace {

struct SurfaceWords {
  SurfaceType surface;
  const char* words;
  const char* brief;
};
constexpr SurfaceWords kSurfaceWords[] = {
    {SurfaceType::elliptic_paraboloid, "elliptic paraboloid", "ell. paraboloid"},
    {SurfaceType::hyperbolic_paraboloid, "hyperbolic paraboloid", "hyp. paraboloid"},
    {SurfaceType::cylindric_paraboloid, "cylindric paraboloid", "cyl. paraboloid"},
    {SurfaceType::circular_paraboloid, "circular paraboloid", "circ. paraboloid"},
    {SurfaceType::plane, "plane", "plane"},
    {SurfaceType::sphere, "sphere", "sphere"},
    {SurfaceType::circular_cylinder, "circular cylinder", "cylinder"},
};

const SurfaceWords& words_of(SurfaceType surface) {
  return *std::find_if(std::begin(kSurfaceWords), std::end(kSurfaceWords),
                       [surface](const SurfaceWords& row) { return row.surface == surface; });
}

}  // namespace

std::string surface_words(SurfaceType surface) { return words_of(surface).words; }
std::string short_surface_words(SurfaceType surface) { return words_of(surface).brief; }

std::string boundary_words(BoundaryType boundary) {
  return boundary == BoundaryType::convex_quad ? "convex quad" : std::string(name(boundary));
}

std::string kind_words(const PatchTypeRow& type) {
  return short_surface_words(type.surface) + " · " + boundary_words(type.boundary);
}

std::string noise_words(const NoiseModel& model) {
  const std::string words = model.from_file() ? "from file" : model.specification;
  return model.assumed ? words + " (assumed)" : words;
}

}  // namespace patchlab::viewer
