#include "tests/paths.hpp"

namespace unicursal::test {

std::filesystem::path data_folder() {
  return source_folder() / "tests/data";
}

std::filesystem::path source_folder() {
  return UNICURSAL_SOURCES;
}

std::string program() {
  return UNICURSAL_PROGRAM;
}

}  // namespace unicursal::test
