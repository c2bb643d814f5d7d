// Parts that several commands share, from JSON and to it: the camera of a lasso, the options of a fit.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/fit/fit_patch.h"
#include "engine/io/json.h"
#include "engine/region/lasso.h"

namespace patchlab {

// Where the member is there, `value` becomes what `read` makes of it.
template <class T, class Read>
void may(const JsonPlace& place, const char* key, T& value, Read read) {
  if (const std::optional<JsonPlace> member = place.find(key)) value = std::invoke(read, *member);
}

template <class T, class FromName>
void may_name(const JsonPlace& place, const char* key, T& value, FromName from_name) {
  const std::optional<JsonPlace> member = place.find(key);
  if (!member) return;
  const std::string text = member->text();
  if (const auto named = from_name(text)) {
    value = *named;
  } else {
    member->fail("'" + text + "' is not known");
  }
}

inline void must(bool holds, const JsonPlace& place, const char* otherwise) {
  if (!holds) place.fail(otherwise);
}

inline Eigen::Vector3d read_position(const JsonPlace& place) { return place.numbers(3); }
inline nlohmann::ordered_json list(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }
inline nlohmann::ordered_json list(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ViewCamera read_camera(const JsonPlace& place);
nlohmann::ordered_json write(const ViewCamera& camera);

// Members that are missing keep their defaults; those that are defaults are not all written.
FitOptions read_options(const JsonPlace& place);
nlohmann::ordered_json write(const FitOptions& options);

}  // namespace patchlab
