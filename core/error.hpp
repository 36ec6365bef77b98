// Errors in data from outside. Each message is a sentence: where, what, and what to do about it.
// Broken invariants are bugs; they assert instead.
#pragma once

#include <stdexcept>
#include <string>

namespace unicursal::core {

/// Bad input from outside the program. `what()` reads "file: place: problem; remedy".
class DataError : public std::runtime_error {
 public:
  /// `file` and `place` (a line, a key, an element, a coordinate) may be empty if none applies.
  DataError(std::string file, std::string place, std::string problem, std::string remedy);

  const std::string& file() const { return file_; }
  const std::string& place() const { return place_; }
  const std::string& problem() const { return problem_; }
  const std::string& remedy() const { return remedy_; }

 private:
  std::string file_, place_, problem_, remedy_;
};

/// A file that cannot be opened, read or written.
class FileError : public DataError {
 public:
  using DataError::DataError;
};

/// A drawing or a mesh that is not a printable shape.
class ModelError : public DataError {
 public:
  using DataError::DataError;
};

}  // namespace unicursal::core
