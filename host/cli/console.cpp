#include "host/cli/console.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "host/link/host_prompt.hpp"

namespace unicursal::host {
namespace {

constexpr auto help =
    "type pause, resume, cancel or stop, or else answer, speed, flow, nozzle or bed with a number";

std::string answer(Session& session, double value) {
  if (value < 0 || value >= HostPrompt::most_buttons || value != std::floor(value))
    return "an answer is a number from 0 to 9";
  return session.answer(static_cast<std::size_t>(value)).value_or("");
}

/// How a new value takes effect. Lines that wait for heat are not overtaken.
std::string set(const Session& session, const Refusal& refusal, const std::string& what) {
  if (refusal) return *refusal;
  const bool heating = session.status().state == SessionState::heating;
  return what + (heating ? " as soon as the printer is hot" : " now");
}

std::string obey_number(Session& session, const std::string& word, double value) {
  if (word == "answer") return answer(session, value);
  if (word == "speed") return set(session, session.set_speed(value), fmt::format("speed is {:.0f} %", value));
  if (word == "flow") return set(session, session.set_flow(value), fmt::format("flow is {:.0f} %", value));
  if (word == "nozzle")
    return set(session, session.set_nozzle(value), fmt::format("the nozzle is set to {:.0f} °C", value));
  if (word == "bed")
    return set(session, session.set_bed(value), fmt::format("the bed is set to {:.0f} °C", value));
  return help;
}

std::string obey_word(Session& session, const std::string& word) {
  if (word == "pause") return session.pause().value_or("");
  if (word == "resume") return session.resume().value_or("the print goes on");
  if (word == "cancel") return session.cancel().value_or("");
  if (word == "stop") return session.emergency_stop().value_or("an emergency stop was sent");
  return help;
}

}  // namespace

std::string obey(Session& session, const std::string& words) {
  std::istringstream stream(words);
  std::string word, number, rest;
  if (!(stream >> word)) return {};
  if (!(stream >> number)) return obey_word(session, word);
  std::istringstream digits(number);
  double value = 0;
  if (!(digits >> value) || digits.peek() != EOF || stream >> rest) return help;
  return obey_number(session, word, value);
}

}  // namespace unicursal::host
