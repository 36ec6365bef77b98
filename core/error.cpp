#include "core/error.hpp"

#include <utility>

namespace unicursal::core {
namespace {

std::string sentence(const std::string& file, const std::string& place, const std::string& problem,
                     const std::string& remedy) {
  std::string text;
  for (const std::string* part : {&file, &place}) {
    if (!part->empty()) text += *part + ": ";
  }
  text += problem;
  if (!remedy.empty()) text += "; " + remedy;
  return text;
}

}  // namespace

DataError::DataError(std::string file, std::string place, std::string problem, std::string remedy)
    : std::runtime_error(sentence(file, place, problem, remedy)),
      file_(std::move(file)),
      place_(std::move(place)),
      problem_(std::move(problem)),
      remedy_(std::move(remedy)) {}

}  // namespace unicursal::core
