// What goes wrong with the files of a print, as sentences.
#pragma once

#include "core/error.hpp"

namespace unicursal::host {

/// A spool that cannot be read or made; names the file and the remedy.
class SpoolError : public core::DataError {
 public:
  using DataError::DataError;
};

/// What was to be kept could not be written; the file is as it was before. The disk may be full.
class SpoolFull : public SpoolError {
 public:
  using SpoolError::SpoolError;
};

}  // namespace unicursal::host
