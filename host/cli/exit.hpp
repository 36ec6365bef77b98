// The program's exit codes, and which exception ends in which of them.
#pragma once

#include <exception>
#include <string>

namespace unicursal::host {

enum class Exit : int {
  success = 0,
  failed = 1,     ///< the print, the simulation or the writing of its report did not end well
  bad_input = 2,  ///< a file, key, option or printer was refused; nothing has heated or moved
  stopped = 3,    ///< the user ended the print early
};

/// Returns the code of a command that ended with this exception. Everything that is not known to come from
/// the input is Exit::failed.
Exit exit_of(const std::exception& error);

/// Returns the sentence to show for this exception, without the program's name and without a line end.
std::string sentence_of(const std::exception& error);

}  // namespace unicursal::host
