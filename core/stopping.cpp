#include "core/stopping.hpp"

#include <utility>

namespace unicursal::core {
namespace {

thread_local std::stop_token present;

}  // namespace

StopScope::StopScope(std::stop_token token) : before_(std::exchange(present, std::move(token))) {}

StopScope::~StopScope() {
  present = std::move(before_);
}

std::stop_token present_stop_token() {
  return present;
}

void stop_point() {
  if (present.stop_requested()) throw Stopped();
}

}  // namespace unicursal::core
