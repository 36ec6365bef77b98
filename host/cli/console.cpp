#include "host/cli/console.hpp"

#include <cmath>
#include <sstream>

#include "host/link/host_prompt.hpp"

namespace unicursal::host {
namespace {

constexpr auto help =
    "type pause, resume, cancel or stop, or else answer, speed, flow, nozzle or bed with a number";

}  // namespace

std::string obey(Session& session, const std::string& words) {
  std::istringstream stream(words);
  std::string word, rest;
  double value = 0;
  if (!(stream >> word)) return {};
  const bool number = static_cast<bool>(stream >> value);
  if (number && !(stream >> rest)) {
    if (word == "answer") {
      const auto button = static_cast<std::size_t>(value);
      const bool whole = value >= 0 && value < HostPrompt::most_buttons && value == std::floor(value);
      return whole ? session.answer(button).value_or("") : "an answer is a number from 0 to 9";
    }
    if (word == "speed") return session.set_speed(value).value_or("");
    if (word == "flow") return session.set_flow(value).value_or("");
    if (word == "nozzle") return session.set_nozzle(value).value_or("");
    if (word == "bed") return session.set_bed(value).value_or("");
  } else if (stream.eof()) {
    if (word == "pause") return session.pause().value_or("");
    if (word == "resume") return session.resume().value_or("");
    if (word == "cancel") return session.cancel().value_or("");
    if (word == "stop") return session.emergency_stop().value_or("");
  }
  return help;
}

}  // namespace unicursal::host
