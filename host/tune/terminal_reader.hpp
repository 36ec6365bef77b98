// Asks a person at the terminal what the strip shows.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "host/tune/reading.hpp"

namespace unicursal::host {

class TerminalReader final : public StripReader {
 public:
  /// Both must outlive the reader.
  TerminalReader(std::istream& in, std::ostream& out) : in_(in), out_(out) {}

  /// Asks until the answers fit the strip. `q` and the end of the input throw TuningCancelled.
  StripReading read(const Strip& strip) override;

 private:
  std::optional<double> ask(const Strip& strip, const std::string& question, bool needed);
  StripReading ask_all(const Strip& strip);

  std::istream& in_;
  std::ostream& out_;
};

/// A number as people type it, with a decimal comma or point and blanks around it; absent if it is none.
std::optional<double> typed_number(const std::string& text);

/// Asks until a number from `least` to `most` is given. `q` and the end of the input throw TuningCancelled.
double asked_number(std::istream& in, std::ostream& out, const std::string& question, double least,
                    double most);

/// Asks a yes-or-no question; any answer but yes counts as no.
bool confirmed(std::istream& in, std::ostream& out, const std::string& question);

}  // namespace unicursal::host
