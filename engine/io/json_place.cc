#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/base/printable.h"
#include "engine/io/json.h"

namespace patchlab {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

bool is_covariance(const Eigen::MatrixXd& cov) {
  if ((cov - cov.transpose()).cwiseAbs().maxCoeff() > 1e-9 * cov.cwiseAbs().maxCoeff()) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(cov, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[0] >= -1e-9 * cov.trace();
}

const json& null_value() {
  static const json null;
  return null;
}

std::string in_quotes(const std::string& text) { return "\"" + text + "\""; }

// What stands there, as a message shows it.
std::string shown(const json& value) {
  constexpr std::size_t longest = 40;
  if (value.is_structured()) return std::string("an ") + value.type_name();
  const std::string text = value.dump();
  return text.size() <= longest ? text : "a long " + std::string(value.type_name());
}

}  // namespace

JsonPlace::JsonPlace(const json& value, std::string file, std::optional<Error>& error)
    : value_(&value), file_(std::move(file)), error_(&error) {}

JsonPlace JsonPlace::operator[](const std::string& key) const {
  if (std::optional<JsonPlace> member = find(key)) return *member;
  fail("lacks the member " + in_quotes(key));
  return nowhere();
}

std::optional<JsonPlace> JsonPlace::find(const std::string& key) const {
  if (*error_) return std::nullopt;
  if (!value_->is_object()) {
    expected("an object");
    return std::nullopt;
  }
  const auto member = value_->find(key);
  if (member == value_->end() || member->is_null()) return std::nullopt;
  JsonPlace place = *this;
  place.value_ = &*member;
  place.path_ += (path_.empty() ? "" : path_.back() == '"' ? ": " : ".") + key;
  return place;
}

std::vector<JsonPlace> JsonPlace::items() const {
  std::vector<JsonPlace> places;
  if (*error_) return places;
  if (!value_->is_array()) expected("an array");
  if (*error_) return places;
  places.reserve(value_->size());
  for (const json& item : *value_) {
    JsonPlace place = *this;
    place.value_ = &item;
    place.path_.append("[").append(std::to_string(places.size())).append("]");
    places.push_back(std::move(place));
  }
  return places;
}

void JsonPlace::only(std::initializer_list<std::string_view> members) const {
  if (!value_->is_object()) return expected("an object");
  for (const auto& [key, value] : value_->items()) {
    if (std::ranges::find(members, key) == members.end()) fail("has the unknown member " + in_quotes(key));
  }
}

JsonPlace JsonPlace::called(const std::string& what) const {
  JsonPlace place = *this;
  place.path_ = what;
  return place;
}

double JsonPlace::number() const {
  if (*error_) return 0.0;
  if (!value_->is_number()) expected("a number");
  return value_->is_number() ? value_->get<double>() : 0.0;
}

std::uint64_t JsonPlace::whole_number(std::uint64_t limit) const {
  if (*error_) return 0;
  const bool whole = value_->is_number_unsigned() && value_->get<std::uint64_t>() <= limit;
  if (!whole) expected("a whole number from 0 to " + std::to_string(limit));
  return whole ? value_->get<std::uint64_t>() : 0;
}

bool JsonPlace::boolean() const {
  if (*error_) return false;
  if (!value_->is_boolean()) expected("true or false");
  return value_->is_boolean() && value_->get<bool>();
}

std::string JsonPlace::text() const {
  if (*error_) return {};
  if (!value_->is_string()) expected("a string");
  return value_->is_string() ? value_->get<std::string>() : std::string();
}

Eigen::VectorXd JsonPlace::numbers(Eigen::Index size) const {
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(size);
  const std::vector<JsonPlace> places = items();
  if (!*error_ && static_cast<Eigen::Index>(places.size()) != size) {
    fail("has " + std::to_string(places.size()) + " entries, " + std::to_string(size) + " are expected");
  }
  if (*error_) return numbers;
  for (Eigen::Index i = 0; i < size; ++i) numbers[i] = places[static_cast<std::size_t>(i)].number();
  return numbers;
}

Eigen::MatrixXd JsonPlace::square_matrix(Eigen::Index size) const {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  const std::vector<JsonPlace> rows = items();
  if (!*error_ && static_cast<Eigen::Index>(rows.size()) != size) {
    fail("has " + std::to_string(rows.size()) + " rows, " + std::to_string(size) + " are expected");
  }
  if (*error_) return matrix;
  for (Eigen::Index i = 0; i < size; ++i) {
    matrix.row(i) = rows[static_cast<std::size_t>(i)].numbers(size).transpose();
  }
  return matrix;
}

Eigen::MatrixXd JsonPlace::covariance(Eigen::Index size) const {
  const Eigen::MatrixXd matrix = square_matrix(size);
  if (!is_covariance(matrix)) fail("is not symmetric positive semi-definite");
  return matrix;
}

void JsonPlace::fail(const std::string& what) const {
  if (*error_) return;
  const std::string place = path_.empty() ? "the file" : path_;
  *error_ = Error{ErrorCode::unreadable,
                  file_ + ": " + printable(place + " " + what) + (what.back() == '.' ? "" : ".")};
}

JsonPlace JsonPlace::nowhere() const {
  JsonPlace place = *this;
  place.value_ = &null_value();
  return place;
}

void JsonPlace::expected(const std::string& what) const {
  fail("is " + shown(*value_) + " where " + what + " is expected");
}

json unknown_members(const json& original, const ordered_json& known) {
  json unknown = json::object();
  if (!original.is_object()) return unknown;
  for (const auto& [key, value] : original.items()) {
    if (!known.contains(key)) {
      unknown[key] = value;
    } else if (value.is_object() && known[key].is_object()) {
      if (json nested = unknown_members(value, known[key]); !nested.empty()) unknown[key] = std::move(nested);
    }
  }
  return unknown;
}

void add_unknown_members(ordered_json& known, const json& unknown) {
  for (const auto& [key, value] : unknown.items()) {
    if (!known.contains(key)) {
      known[key] = value;
    } else if (value.is_object() && known[key].is_object()) {
      add_unknown_members(known[key], value);
    }
  }
}

}  // namespace patchlab
