#include "host/tune/terminal_reader.hpp"

#include <fmt/format.h>

#include <charconv>
#include <iostream>

#include "core/error.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t longest_answer = 40;  ///< characters; a longer answer is not a number

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Accepts a decimal comma as well as a point.
std::optional<double> number_in(std::string text) {
  if (text.size() > longest_answer) return std::nullopt;
  if (const std::size_t comma = text.find(','); comma != std::string::npos) text[comma] = '.';
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string line_of(std::istream& in, std::ostream& out, const std::string& question) {
  out << question << std::flush;
  std::string line;
  if (!std::getline(in, line)) {
    out << '\n';
    throw TuningCancelled("no answer came");
  }
  return trimmed(line);
}

}  // namespace

std::optional<double> TerminalReader::ask(const Strip& strip, const std::string& question, bool needed) {
  for (;;) {
    const std::string answer = line_of(in_, out_, question + " ");
    if (answer == "q" || answer == "Q") throw TuningCancelled("as requested");
    if (answer.empty() && !needed) return std::nullopt;
    const std::optional<double> tick = number_in(answer);
    if (tick && *tick >= 0 && *tick * strip.tick <= strip.length()) return *tick * strip.tick;
    out_ << fmt::format("  Please enter a tick from 0 to {}, such as 12 or 12.5{}; q quits.\n",
                        strip.points.size() - 1, needed ? "" : ", or just press Enter");
  }
}

StripReading TerminalReader::ask_all(const Strip& strip) {
  StripReading reading;
  reading.began =
      *ask(strip, "At which tick does the colour begin to change, so that it looks like line 5?", true);
  reading.half =
      ask(strip, "At which tick is it half changed, like line 50? (press Enter if you cannot say)", false);
  reading.stopped = *ask(strip, "At which tick has it nearly stopped changing, like line 95?", true);
  return reading;
}

StripReading TerminalReader::read(const Strip& strip) {
  out_ << "The mixture was changed at tick 0. Every tenth tick has a number; even ticks are behind the bead, "
          "odd\n"
          "ones in front of it. The lines below the numbers 5, 50 and 95 show how the bead looks after that\n"
          "percentage of the change; compare near the numbers. If several ticks look the same, take the "
          "middle\n"
          "one. q quits.\n";
  for (;;) {
    const StripReading reading = ask_all(strip);
    try {
      (void)fit_transition(volumes_of(strip, reading));
      return reading;
    } catch (const core::DataError& error) {
      out_ << "  " << error.what() << "\n";
    }
  }
}

std::optional<double> typed_number(const std::string& text) {
  return number_in(trimmed(text));
}

double asked_number(std::istream& in, std::ostream& out, const std::string& question, double least,
                    double most) {
  for (;;) {
    const std::string answer = line_of(in, out, question + " ");
    if (answer == "q" || answer == "Q") throw TuningCancelled("as requested");
    const std::optional<double> number = number_in(answer);
    if (number && *number >= least && *number <= most) return *number;
    out << fmt::format("  Please enter a number from {:g} to {:g}, such as 20.5; q quits.\n", least, most);
  }
}

bool confirmed(std::istream& in, std::ostream& out, const std::string& question) {
  const std::string answer = line_of(in, out, question + " [y/N] ");
  return answer == "y" || answer == "Y" || answer == "yes";
}

}  // namespace unicursal::host
