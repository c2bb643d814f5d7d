#include "engine/project/parts_json.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace patchlab {
namespace {

using nlohmann::ordered_json;

std::optional<bool> perspective_from_name(std::string_view name) {
  if (name == "perspective") return true;
  return name == "orthographic" ? std::optional(false) : std::nullopt;
}

std::array<int, 2> read_viewport(const JsonPlace& place) {
  const Eigen::Array2d size = place.numbers(2);
  const bool whole = (size == size.round() && size >= 1.0 && size <= 1 << 20).all();
  if (whole) return {static_cast<int>(size[0]), static_cast<int>(size[1])};
  place.fail("must be two whole numbers of pixels");
  return {1, 1};
}

std::uint64_t read_seed(const JsonPlace& place) {
  return place.whole_number(std::numeric_limits<std::uint64_t>::max());
}

struct LimitName {
  const char* name;
  double ValidationLimits::*value;
};
constexpr LimitName limit_names[] = {{"p_value", &ValidationLimits::p_value},
                                     {"residual_rms", &ValidationLimits::residual_rms},
                                     {"coverage", &ValidationLimits::coverage},
                                     {"curvature_extent", &ValidationLimits::curvature_extent}};

ValidationLimits read_limits(const JsonPlace& place) {
  place.only({"p_value", "residual_rms", "coverage", "curvature_extent"});
  ValidationLimits limits;
  for (const auto& [name, value] : limit_names) may(place, name, limits.*value, &JsonPlace::number);
  return limits;
}

// Those that are not the default.
ordered_json write(const ValidationLimits& limits) {
  ordered_json object = ordered_json::object();
  for (const auto& [name, value] : limit_names) {
    if (limits.*value != ValidationLimits{}.*value) object[name] = limits.*value;
  }
  return object;
}

}  // namespace

ViewCamera read_camera(const JsonPlace& place) {
  place.only({"position", "quaternion_xyzw", "fov_y", "height", "near", "far", "projection", "viewport"});
  ViewCamera camera;
  may_name(place, "projection", camera.perspective, perspective_from_name);
  camera.position = read_position(place["position"]);
  const Eigen::Vector4d q = place["quaternion_xyzw"].numbers(4);
  must(std::abs(q.squaredNorm() - 1.0) < 1e-3, place, "must have a quaternion_xyzw of length 1");
  camera.quaternion_xyzw = {q[0], q[1], q[2], q[3]};
  if (camera.perspective) {
    camera.fov_y = place["fov_y"].number();
    must(camera.fov_y > 0.0 && camera.fov_y < std::numbers::pi, place, "must have a fov_y between 0 and pi");
  } else {
    camera.height = place["height"].number();
    must(camera.height > 0.0, place, "must have a positive height");
  }
  camera.near_plane = place["near"].number();
  must(camera.near_plane >= 0.0, place, "must not have a negative near");
  may(place, "far", camera.far_plane, &JsonPlace::number);
  must(camera.far_plane > camera.near_plane, place, "must have a far beyond its near");
  camera.viewport = read_viewport(place["viewport"]);
  return camera;
}

ordered_json write(const ViewCamera& camera) {
  ordered_json object = {{"position", list(camera.position)}, {"quaternion_xyzw", camera.quaternion_xyzw}};
  if (camera.perspective) {
    object["fov_y"] = camera.fov_y;
  } else {
    object["height"] = camera.height;
  }
  object["near"] = camera.near_plane;
  if (std::isfinite(camera.far_plane)) object["far"] = camera.far_plane;
  object["projection"] = camera.perspective ? "perspective" : "orthographic";
  object["viewport"] = camera.viewport;
  return object;
}

FitOptions read_options(const JsonPlace& place) {
  place.only({"surface", "boundary", "method", "robust", "bounds", "containment", "seed", "limits"});
  FitOptions options;
  may_name(place, "surface", options.surface, surface_request_from_name);
  may_name(place, "boundary", options.boundary, boundary_request_from_name);
  may_name(place, "method", options.method, fit_method_from_name);
  may(place, "robust", options.robust, &JsonPlace::boolean);
  may_name(place, "bounds", options.bounds, bounds_method_from_name);
  may(place, "containment", options.containment, &JsonPlace::number);
  may(place, "seed", options.seed, read_seed);
  may(place, "limits", options.limits, read_limits);
  return options;
}

ordered_json write(const FitOptions& options) {
  ordered_json object = {{"surface", name(options.surface)},
                         {"boundary", name(options.boundary)},
                         {"method", name(options.method)},
                         {"robust", options.robust}};
  if (options.bounds) object["bounds"] = name(*options.bounds);
  if (options.containment) object["containment"] = *options.containment;
  if (options.seed != FitOptions{}.seed) object["seed"] = options.seed;
  if (ordered_json limits = write(options.limits); !limits.empty()) object["limits"] = std::move(limits);
  return object;
}

}  // namespace patchlab
