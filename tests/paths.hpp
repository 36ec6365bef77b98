// The places that a test needs and cannot find by itself.
#pragma once

#include <filesystem>
#include <string>

namespace unicursal::test {

/// tests/data.
std::filesystem::path data_folder();
/// The top level of the sources.
std::filesystem::path source_folder();
/// The program `unicursal` that was built with the tests.
std::string program();

}  // namespace unicursal::test
