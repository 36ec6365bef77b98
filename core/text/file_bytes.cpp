#include "core/text/file_bytes.hpp"

#include <cstdint>
#include <fstream>
#include <system_error>

#include "core/error.hpp"

namespace unicursal::core {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{2} << 30;  ///< bytes; 40 million triangles

}  // namespace

std::string file_bytes(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw FileError(file.string(), "", "there is no such file", "check the path");
  if (!fs::is_regular_file(status)) {
    throw FileError(file.string(), "", "this is not a file", "name a drawing or a mesh");
  }
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) throw FileError(file.string(), "", "its size cannot be read", "check the disk");
  if (size > largest_file)
    throw FileError(file.string(), "", "it is larger than 2 GiB", "simplify the model");
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size)) && size > 0) {
    throw FileError(file.string(), "", "it cannot be read", "check its permissions");
  }
  return bytes;
}

}  // namespace unicursal::core
