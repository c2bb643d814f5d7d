#include <array>
#include <utility>

#include "engine/fit/fit_patch.h"

namespace patchlab {
namespace {

template <class T, std::size_t n>
using Names = std::array<std::pair<T, std::string_view>, n>;

constexpr Names<SurfaceRequest, 9> surfaces = {{
    {SurfaceRequest::automatic, "auto"},
    {SurfaceRequest::paraboloid, "paraboloid"},
    {SurfaceRequest::elliptic_paraboloid, "elliptic_paraboloid"},
    {SurfaceRequest::hyperbolic_paraboloid, "hyperbolic_paraboloid"},
    {SurfaceRequest::cylindric_paraboloid, "cylindric_paraboloid"},
    {SurfaceRequest::circular_paraboloid, "circular_paraboloid"},
    {SurfaceRequest::plane, "plane"},
    {SurfaceRequest::sphere, "sphere"},
    {SurfaceRequest::circular_cylinder, "circular_cylinder"},
}};
constexpr Names<BoundaryRequest, 5> boundaries = {{
    {BoundaryRequest::automatic, "auto"},
    {BoundaryRequest::ellipse, "ellipse"},
    {BoundaryRequest::circle, "circle"},
    {BoundaryRequest::rectangle, "rectangle"},
    {BoundaryRequest::convex_quad, "convex_quad"},
}};
constexpr Names<FitMethod, 2> methods = {
    {{FitMethod::calibrated, "calibrated"}, {FitMethod::paper, "paper"}}};
constexpr Names<BoundsMethod, 2> bounds_methods = {
    {{BoundsMethod::extent, "extent"}, {BoundsMethod::paper, "paper"}}};

template <class T, std::size_t n>
std::string_view name_in(const Names<T, n>& names, T value) {
  for (const auto& [key, text] : names) {
    if (key == value) return text;
  }
  return "";
}
template <class T, std::size_t n>
std::optional<T> value_in(const Names<T, n>& names, std::string_view text) {
  for (const auto& [key, known] : names) {
    if (known == text) return key;
  }
  return std::nullopt;
}

}  // namespace

std::string_view name(SurfaceRequest request) { return name_in(surfaces, request); }
std::string_view name(BoundaryRequest request) { return name_in(boundaries, request); }
std::string_view name(FitMethod method) { return name_in(methods, method); }
std::string_view name(BoundsMethod method) { return name_in(bounds_methods, method); }
std::optional<SurfaceRequest> surface_request_from_name(std::string_view text) {
  return value_in(surfaces, text);
}
std::optional<BoundaryRequest> boundary_request_from_name(std::string_view text) {
  return value_in(boundaries, text);
}
std::optional<FitMethod> fit_method_from_name(std::string_view text) { return value_in(methods, text); }
std::optional<BoundsMethod> bounds_method_from_name(std::string_view text) {
  return value_in(bounds_methods, text);
}

}  // namespace patchlab
