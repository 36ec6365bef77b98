#include "host/cli/exit.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/error.hpp"
#include "host/engine/session_types.hpp"
#include "host/link/link.hpp"

namespace unicursal::host {
namespace {

template <class... Errors>
bool is_any_of(const std::exception& error) {
  return (... || (dynamic_cast<const Errors*>(&error) != nullptr));
}

}  // namespace

Exit exit_of(const std::exception& error) {
  // A file system's error comes from before a print: during a print, everything becomes a PrintError.
  const bool refused =
      is_any_of<core::DataError, PortError, PrinterUnfit, std::filesystem::filesystem_error>(error);
  return refused ? Exit::bad_input : Exit::failed;
}

std::string sentence_of(const std::exception& error) {
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error)) {
    return fmt::format("{}: {}; check the name and the permissions", file->path1().string(),
                       file->code().message());
  }
  return error.what();
}

}  // namespace unicursal::host
