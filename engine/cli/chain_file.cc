#include "engine/cli/chain_file.h"

#include <cmath>
#include <optional>

#include "engine/io/json.h"

namespace patchlab {
namespace {

using nlohmann::ordered_json;

ChainElement read_element(const JsonPlace& place) {
  ChainElement element;
  element.pose.pose = {place["r"].numbers(3), place["t"].numbers(3)};
  if (const auto phi = place.find("phi")) {
    element.phi = phi->number() < 0.0 ? -1 : 1;
    if (std::abs(phi->number()) != 1.0) phi->fail("must be 1 or -1");
  }
  if (const auto covariance = place.find("covariance")) {
    element.pose.covariance = covariance->covariance(6);
  }
  return element;
}

template <class Derived>
ordered_json list(const Eigen::MatrixBase<Derived>& matrix) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    if (matrix.cols() == 1) {
      rows.push_back(matrix(i, 0));
    } else {
      rows.push_back(list(matrix.row(i).transpose().eval()));
    }
  }
  return rows;
}

}  // namespace

Result<Chain> parse_chain(std::string_view text, const std::string& name) {
  const Result<nlohmann::json> json = parse_json(text, name);
  if (!json) return json.error();
  std::optional<Error> error;
  const JsonPlace root(*json, name, error);
  root.only({"elements"});
  const JsonPlace elements = root["elements"];
  Chain chain;
  for (const JsonPlace& place : elements.items()) {
    place.only({"r", "t", "phi", "covariance"});
    chain.push_back(read_element(place));
  }
  if (chain.empty()) elements.fail("must hold a pose or more");
  if (error) return *error;
  return chain;
}

Result<Chain> parse_pose(std::string_view text, const std::string& name) {
  const Result<nlohmann::json> json = parse_json(text, name);
  if (!json) return json.error();
  if (json->is_object() && json->contains("elements")) return parse_chain(text, name);
  std::optional<Error> error;
  const JsonPlace root(*json, name, error);
  root.only({"r", "t", "covariance", "axis_pose"});
  const ChainElement element = read_element(root);
  if (error) return *error;
  return Chain{element};
}

ordered_json to_json(const UncertainPose& pose) {
  const UncertainAxisPose axis = axis_pose(pose);
  return {{"r", list(pose.pose.r)},
          {"t", list(pose.pose.t)},
          {"covariance", list(pose.covariance)},
          {"axis_pose",
           {{"r_xy", list(axis.r_xy)},
            {"t", list(axis.t)},
            {"covariance", list(axis.covariance)},
            {"near_singular", axis.near_singular},
            {"tilt_covariance", list(axis.cov_tilt)}}}};
}

}  // namespace patchlab
