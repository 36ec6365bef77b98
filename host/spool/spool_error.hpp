// Errors of the files of a print.
#pragma once

#include "core/error.hpp"

namespace unicursal::host {

/// A spool cannot be read or made. The message names the file and the remedy.
class SpoolError : public core::DataError {
 public:
  using DataError::DataError;
};

/// A record could not be written, perhaps because the disk is full. The file is unchanged.
class SpoolFull : public SpoolError {
 public:
  using SpoolError::SpoolError;
};

}  // namespace unicursal::host
