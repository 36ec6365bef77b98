// Words of a command line that the program does not know. CLI11 reports only that they were not expected, in
// an order of its own, and behind other mistakes; a person wants to see the first one, and what was probably
// meant.
#pragma once

#include "core/error.hpp"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace unicursal::host {

/// Throws core::DataError for the first word that is not a command, an option, the value of one, or an
/// argument that the command takes.
void check_words(const CLI::App& program, int argc, const char* const* argv);

/// Another mistake of usage, which CLI11 has found, in the words of this program.
core::DataError usage_error(const CLI::App& program, const CLI::ParseError& error);

}  // namespace unicursal::host
