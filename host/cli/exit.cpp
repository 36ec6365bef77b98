#include "host/cli/exit.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <new>

#include "core/error.hpp"
#include "host/cli/for_terminal.hpp"
#include "host/engine/session_types.hpp"
#include "host/link/link.hpp"
#include "host/loop/sentence.hpp"

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
    return fmt::format("{}: {}; check the name and the permissions", for_terminal(file->path1().string()),
                       file->code().message());
  }
  // A NUL in a name would cut what(), but not the parts.
  if (const auto* data = dynamic_cast<const core::DataError*>(&error)) {
    std::string text;
    for (const std::string& where : {data->file(), data->place()}) {
      if (!where.empty()) text += where + ": ";
    }
    text += data->problem();
    if (!data->remedy().empty()) text += "; " + data->remedy();
    return for_terminal(text);
  }
  if (is_any_of<std::bad_alloc>(error)) return sentence(std::make_exception_ptr(std::bad_alloc()));
  return for_terminal(error.what());
}

}  // namespace unicursal::host
