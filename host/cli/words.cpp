#include "host/cli/words.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "host/cli/progress.hpp"

namespace unicursal::host {
namespace {

std::size_t parse_index(std::string_view text, const std::string& whole) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  throw core::DataError("", "--layers", fmt::format("\"{}\" is no range of layers", whole),
                        "write first:last counted from 0, for example 0:4");
}

/// Temperatures and the like are no news; errors and what the printer does on its own are.
bool worth_showing(const std::string& message) {
  for (const char* start : {"Error", "//action", "stopping", "echo: cold", "echo: too long", "!!"}) {
    if (message.rfind(start, 0) == 0) return true;
  }
  return false;
}

/// What comes from a printer is shown without control characters and not at any length.
std::string tame(const std::string& message) {
  constexpr std::size_t longest = 200;
  std::string text = message.substr(0, longest);
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

}  // namespace

LayerRange parse_layers(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string_view view = text;
  LayerRange range;
  if (colon == std::string::npos) {
    range.first = range.last = parse_index(view, text);
    return range;
  }
  range.last = static_cast<std::size_t>(-1) / 2;
  if (colon > 0) range.first = parse_index(view.substr(0, colon), text);
  if (colon + 1 < text.size()) range.last = parse_index(view.substr(colon + 1), text);
  return range;
}

PreparedJob prepare_and_warn(const JobOptions& options) {
  PreparedJob prepared = prepare(load_job(options.job, options.profile), options.layers);
  for (const std::string& warning : prepared.job.warnings) fmt::print(stderr, "note: {}\n", warning);
  for (const std::string& warning : prepared.part->warnings()) fmt::print(stderr, "note: {}\n", warning);
  return prepared;
}

nlohmann::json planning_json(const Lookahead& lookahead) {
  const PlanningEffort effort = lookahead.effort();
  return {{"seconds", effort.seconds}, {"cpu_seconds", effort.cpu_seconds}, {"threads", lookahead.threads()}};
}

nlohmann::json link_json(const StreamResult& result) {
  const LinkStatistics& s = result.statistics;
  return {{"firmware", result.firmware},    {"lines", s.lines},     {"sent", s.sent},
          {"acknowledged", s.acknowledged}, {"resends", s.resends}, {"bytes", s.bytes}};
}

StreamResult stream_with_progress(int port, Lookahead& lookahead, Run& run, const std::string& what) {
  Progress progress(what, run.prepared().count);
  StreamListeners listeners;
  listeners.progress = [&](std::size_t layers, double fraction) { progress.update(layers, fraction); };
  listeners.message = [&](const std::string& message) {
    if (worth_showing(message)) progress.say(tame(message));
  };
  return stream(port, lookahead, run, listeners);
}

}  // namespace unicursal::host
