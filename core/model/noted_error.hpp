// A refusal of a model with the notes that its reader had made until then: often they say why.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace unicursal::core {

class NotedError : public ModelError {
 public:
  NotedError(const ModelError& refusal, std::vector<std::string> notes)
      : ModelError(refusal), notes_(std::move(notes)) {}

  /// One sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::vector<std::string> notes_;
};

}  // namespace unicursal::core
