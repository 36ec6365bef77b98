// The error of everything that reads a job or a profile.
#pragma once

#include "core/error.hpp"

namespace unicursal::host {

/// A mistake in a job or a profile; names file, line and key.
class JobError : public core::DataError {
 public:
  using DataError::DataError;
};

}  // namespace unicursal::host
