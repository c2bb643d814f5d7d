// JSON as patchlab reads and writes it: strictly in, readably out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace patchlab {

// The value of a text that is JSON from its first byte to its last. unreadable error, with line and column,
// for anything else, for a member that stands twice in one object and for nesting deeper than 64.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& name);

// Text with one member a line, arrays and objects that fit on a line left there; numbers read back to the
// same bits. refused error, naming the place, where a number is not finite or a string is not UTF-8: JSON
// cannot hold them.
Result<std::string> json_text(const nlohmann::ordered_json& value, const std::string& name);

// What is wrong with the first number that is not finite, "fit.p_value is not a number"; empty where all are.
std::string not_finite(const nlohmann::ordered_json& value);

// A place in a JSON value being read. The first thing found wrong is kept in `error`, with the place; from
// then on reads give defaults, so that a reader reads on and its caller looks at `error` once, at the end:
//
//   std::optional<Error> error;
//   const JsonPlace root(json, file, error);
//   camera.fx = root["camera"]["fx"].number();
//   if (error) return *error;
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string file, std::optional<Error>& error);

  // A member that must be there; one that may be missing (null counts as missing).
  JsonPlace operator[](const std::string& key) const;
  std::optional<JsonPlace> find(const std::string& key) const;
  std::vector<JsonPlace> items() const;             // of an array
  JsonPlace called(const std::string& what) const;  // the same place, called so in messages

  // Wrong where an object has any other member.
  void only(std::initializer_list<std::string_view> members) const;

  double number() const;                                  // finite
  std::uint64_t whole_number(std::uint64_t limit) const;  // 0 <= n <= limit
  bool boolean() const;
  std::string text() const;
  Eigen::VectorXd numbers(Eigen::Index size) const;        // an array of exactly `size` numbers
  Eigen::MatrixXd square_matrix(Eigen::Index size) const;  // an array of `size` such rows
  Eigen::MatrixXd covariance(Eigen::Index size) const;     // such, symmetric positive semi-definite
  const nlohmann::json& value() const { return *value_; }
  bool ok() const { return !*error_; }  // nothing wrong so far, anywhere

  void fail(const std::string& what) const;  // "FILE: PLACE WHAT."

 private:
  JsonPlace nowhere() const;
  void expected(const std::string& what) const;

  const nlohmann::json* value_;
  std::string file_, path_;
  std::optional<Error>* error_;
};

// Members of `original` that `known` lacks, nested as they stand; and `known` with such members added at its
// end.
nlohmann::json unknown_members(const nlohmann::json& original, const nlohmann::ordered_json& known);
void add_unknown_members(nlohmann::ordered_json& known, const nlohmann::json& unknown);

}  // namespace patchlab
