// Planning that nobody wants any more ends within a second, wherever it is. The caller names a stop token for
// its thread; everything slow looks at it now and then, and throws Stopped. Workers
// (core/numeric/parallel.hpp) hand the token on to the threads that help them. A token that is never stopped
// changes no result.
//
//   const StopScope scope(token);
//   plan();  // throws Stopped soon after token's source was asked to stop
#pragma once

#include <exception>
#include <stop_token>

namespace unicursal::core {

/// The work was given up since its result is not wanted; not an error of its input.
class Stopped : public std::exception {
 public:
  const char* what() const noexcept override { return "the work was given up"; }
};

/// While it lives, stop_point() on this thread obeys the token. Scopes nest; the innermost counts.
class StopScope {
 public:
  explicit StopScope(std::stop_token token);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  std::stop_token before_;
};

/// The token that counts on this thread; without a scope it can never be stopped.
std::stop_token present_stop_token();

/// Throws Stopped if this thread was asked to stop. It costs a few nanoseconds.
void stop_point();

}  // namespace unicursal::core
