// Errors are values: every operation that can fail returns a Result, which holds what was asked for or an
// Error with a code and a sentence for the user. No exception crosses a room of the engine.
//
//   Result<Scan> scan = read_scan(file);
//   if (!scan) return scan.error();
//   use(*scan);
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace patchlab {

// What kind of failure it was; the command line turns it into its exit status (exit_status below).
enum class ErrorCode {
  usage,          // the request itself is wrong
  unreadable,     // an input cannot be read or is malformed
  no_finite_fit,  // the points do not determine the patch (too few, collinear, coincident, bad covariance)
  unwritable,     // an output cannot be written
  refused,        // an item was refused, the rest was done
  cancelled,      // the user cancelled
};

// `message` is one whole sentence: it names the file or item, what is wrong, where, and what to do.
struct Error {
  ErrorCode code;
  std::string message;
};

// Exit status of the command line for an error: 1 refused or cancelled, 2 usage, 3 unreadable or no finite
// fit, 4 unwritable.
inline int exit_status(ErrorCode code) {
  switch (code) {
    case ErrorCode::usage:
      return 2;
    case ErrorCode::unreadable:
    case ErrorCode::no_finite_fit:
      return 3;
    case ErrorCode::unwritable:
      return 4;
    case ErrorCode::refused:
    case ErrorCode::cancelled:
      return 1;
  }
  return 1;
}

// A value or an Error. Precondition of `*` and `->`: it holds a value; of error(): it does not.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : held_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : held_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return held_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& operator*() & { return std::get<0>(held_); }
  const T& operator*() const& { return std::get<0>(held_); }
  T&& operator*() && { return std::get<0>(std::move(held_)); }
  T* operator->() { return &std::get<0>(held_); }
  const T* operator->() const { return &std::get<0>(held_); }

  const Error& error() const { return std::get<1>(held_); }

 private:
  std::variant<T, Error> held_;
};

// The result of an operation that gives nothing back.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : held_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return held_.index() == 0; }
  explicit operator bool() const { return ok(); }
  const Error& error() const { return std::get<1>(held_); }

 private:
  std::variant<std::monostate, Error> held_;
};

}  // namespace patchlab
