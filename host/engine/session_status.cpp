// What a session tells: of the printer's words, of itself, and of what is to come.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>
#include <variant>

#include "firmware_gcode/reply/reply.hpp"
#include "host/engine/printer_check.hpp"
#include "host/engine/session_impl.hpp"

namespace unicursal::host {
namespace {

using namespace gcode;

void update(Temperatures& known, const Temperatures& told) {
  const auto take = [](std::optional<double>& to, const std::optional<double>& from) {
    if (from) to = from;
  };
  take(known.nozzle, told.nozzle);
  take(known.nozzle_target, told.nozzle_target);
  take(known.bed, told.bed);
  take(known.bed_target, told.bed_target);
}

std::optional<double> share_in(const std::string& line) {
  const auto at = line.find(" P");
  if (!line.starts_with("M163 ") || at == std::string::npos) return std::nullopt;
  double share = 0;
  const char* begin = line.data() + at + 2;
  const auto [end, error] = std::from_chars(begin, line.data() + line.size(), share);
  return error == std::errc() ? std::optional(share) : std::nullopt;
}

constexpr double same_share = 0.002;  ///< what rounding to a firmware's integers may change

}  // namespace

const char* name(SessionState state) {
  switch (state) {
    case SessionState::connecting:
      return "connecting";
    case SessionState::heating:
      return "heating";
    case SessionState::printing:
      return "printing";
    case SessionState::pausing:
      return "pausing";
    case SessionState::paused:
      return "paused";
    case SessionState::resuming:
      return "resuming";
    case SessionState::finishing:
      return "finishing";
    case SessionState::cancelling:
      return "cancelling";
    case SessionState::done:
      return "done";
    case SessionState::stopped:
      return "stopped";
    case SessionState::failed:
      break;
  }
  return "failed";
}

const char* name(SessionEvent::Kind kind) {
  switch (kind) {
    case SessionEvent::Kind::state:
      return "state";
    case SessionEvent::Kind::progress:
      return "progress";
    case SessionEvent::Kind::heat:
      return "heat";
    case SessionEvent::Kind::notice:
      return "notice";
    case SessionEvent::Kind::printer:
      break;
  }
  return "printer";
}

void Session::State::hear(const std::string& line) {
  const Reply reply = parse_reply(line);
  const auto heard = [&](const Temperatures& told) {
    update(temperatures, told);
    wake.notify();
    tell(SessionEvent::Kind::heat);
  };
  if (const auto* ok = std::get_if<reply::Ok>(&reply)) return heard(ok->temperatures);
  if (const auto* report = std::get_if<reply::TemperatureReport>(&reply)) return heard(report->temperatures);
  if (const auto* error = std::get_if<reply::Error>(&reply); error && error->halted) halted = true;
  tell(SessionEvent::Kind::printer, line);
  if (const auto* echo = std::get_if<reply::Echo>(&reply); echo && echo->unknown_command) {
    if (denies_mixing(line)) {
      mixes = false;
      wake.notify();
    }
    if (echo->text.find("M85") != std::string::npos)
      warn("this firmware does not know M85: if this computer fails in mid-print, nothing cools the printer");
  }
  if (const auto* echo = std::get_if<reply::Echo>(&reply)) {
    if (echo->text.find("cold extrusion") != std::string::npos) hold_because_cold();
  }
  if (const auto* action = std::get_if<reply::Action>(&reply)) obey(action->text);
  if (halted) wake.notify();
}

void Session::State::enter(SessionState next, const std::string& why) {
  state = next;
  reason = why;
  tell(SessionEvent::Kind::state);
}

void Session::State::tell(SessionEvent::Kind kind, const std::string& text) const {
  if (observer) observer({kind, text});
}

void Session::State::warn(const std::string& sentence) {
  if (std::find(warnings.begin(), warnings.end(), sentence) != warnings.end()) return;
  warnings.push_back(sentence);
  tell(SessionEvent::Kind::notice, "Warning: " + sentence);
}

Ahead Session::State::ahead() const {
  return {source.layers(), source.waiting(),
          [this](std::size_t begin, std::size_t end) { return source.foretold(begin, end); }};
}

/// By the tool in use and what was last stored into it.
std::string Session::State::mixture() const {
  if (!modal.tool || !caught_up) return {};
  const auto tool = modal.tools.find(*modal.tool);
  if (tool == modal.tools.end()) return {};
  std::vector<double> shares;
  for (const std::string& line : tool->second) {
    if (const auto share = share_in(line)) shares.push_back(*share);
  }
  for (const NamedMixture& named : source.mixtures()) {
    bool same = shares.size() >= 3;
    for (std::size_t i = 0; i < 3 && same; ++i)
      same = std::abs(named.mixture.share(i) - shares[i]) < same_share;
    if (same) return named.name;
  }
  std::string text;
  for (const double share : shares) text += fmt::format("{}{:.2f}", text.empty() ? "" : " : ", share);
  return text;
}

SessionStatus Session::State::status() const {
  SessionStatus status;
  status.state = state;
  status.reason = pause_wanted && state == SessionState::heating ? pause_when_hot : reason;
  status.layers = source.layers();
  status.layer = progress.layer(status.layers);
  status.layer_fraction = progress.fraction();
  if (progress.has_begun()) {
    status.left = has_ended(state) ? 0 : progress.seconds_left(ahead());
    status.percent = progress.percent(ahead(), state == SessionState::done);
  }
  status.elapsed = std::chrono::duration<double>(clock->now() - began).count();
  status.temperatures = temperatures;
  status.mixture = mixture();
  const Waiting waiting = source.waiting();
  status.lookahead = waiting.seconds;
  status.lookahead_layers = waiting.layers;
  if (const auto& queues = link.queues(); queues && queues->planner_size > 0)
    status.queue = 1 - static_cast<double>(queues->planner_free) / queues->planner_size;
  status.speed_percent = speed_percent;
  status.flow_percent = flow_percent;
  if (caught_up) status.warnings = source.warnings();
  status.warnings.insert(status.warnings.end(), warnings.begin(), warnings.end());
  return status;
}

}  // namespace unicursal::host
