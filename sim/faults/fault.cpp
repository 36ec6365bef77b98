#include "sim/faults/fault.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace unicursal::sim {

namespace {

enum class Value { none, chance, seconds, optional_seconds, text };

struct KindFacts {
  FaultKind kind;
  std::string_view name;
  Value value;
  std::string_view what;
};

using K = FaultKind;

constexpr std::array kinds{
    KindFacts{K::bit_flip, "bitflip", Value::chance, "a byte to the printer has one bit wrong"},
    KindFacts{K::lost_byte, "lostbyte", Value::chance, "a byte to the printer is lost"},
    KindFacts{K::reply_flip, "replyflip", Value::chance, "a byte from the printer has one bit wrong"},
    KindFacts{K::lost_reply, "lostreply", Value::chance, "a byte from the printer is lost"},
    KindFacts{K::merged_lines, "merge", Value::chance,
              "a line to the printer loses its newline and joins the next"},
    KindFacts{K::false_alarm, "falsealarm", Value::chance,
              "the printer reports a checksum mismatch for a good line"},
    KindFacts{K::false_number, "falsenumber", Value::chance,
              "the printer reports a wrong line number for a good line"},
    KindFacts{K::false_missing, "falsemissing", Value::chance,
              "the printer reports a missing checksum for a good line"},
    KindFacts{K::rewind, "rewind", Value::chance, "the printer accepts a line and then asks for it again"},
    KindFacts{K::lost_ok, "lostok", Value::chance, "an ok never arrives"},
    KindFacts{K::double_ok, "doubleok", Value::chance, "an ok arrives twice"},
    KindFacts{K::broken_ok, "brokenok", Value::chance, "an ok is misspelt"},
    KindFacts{K::other_ok, "answer", Value::text, "the next ok reads TEXT"},
    KindFacts{K::lost_resend, "lostresend", Value::chance, "a request to resend never arrives"},
    KindFacts{K::double_resend, "doubleresend", Value::chance, "a request to resend arrives twice"},
    KindFacts{K::glued_ok, "gluedok", Value::chance,
              "a report of temperatures loses its newline, and the next ok is glued to it"},
    KindFacts{K::noise, "noise", Value::chance, "a line of random bytes comes before a reply"},
    KindFacts{K::bad_utf8, "badutf8", Value::chance, "a line of invalid UTF-8 comes before a reply"},
    KindFacts{K::nul, "nul", Value::chance, "a line with NUL bytes comes before a reply"},
    KindFacts{K::slow, "slow", Value::seconds, "every reply is up to SECONDS late"},
    KindFacts{K::slow_boot, "slowboot", Value::seconds, "the board takes SECONDS to boot"},
    KindFacts{K::stall, "stall", Value::seconds,
              "the firmware neither reads nor answers for SECONDS; moves continue"},
    KindFacts{K::silence, "silence", Value::none, "the firmware never answers again"},
    KindFacts{K::disconnect, "disconnect", Value::optional_seconds,
              "the cable is pulled; it returns after SECONDS if given"},
    KindFacts{K::reset, "reset", Value::none, "the board resets"},
    KindFacts{K::heater_failure, "heaterfail", Value::none, "the nozzle heater gives no more heat"},
    KindFacts{K::bed_failure, "bedfail", Value::none, "the bed heater gives no more heat"},
    KindFacts{K::unguarded, "unguarded", Value::none,
              "from now on the firmware does not notice when a heater fails"},
    KindFacts{K::runaway, "runaway", Value::none, "the nozzle heater cannot be switched off"},
    KindFacts{K::thermistor, "thermistor", Value::none, "the nozzle thermistor falls out"},
    KindFacts{K::runout, "runout", Value::none,
              "a feeder runs out of filament, and the printer announces it"},
    KindFacts{K::filament_change, "filamentchange", Value::none,
              "a feeder runs out of filament; the printer parks and waits for a person"},
    KindFacts{K::say, "say", Value::text, "the printer says TEXT"},
    KindFacts{K::display, "display", Value::text, "a person gives the command TEXT at the printer's display"},
    KindFacts{K::fatal, "fatal", Value::text, "the firmware stops itself with the error TEXT"},
    KindFacts{K::stopped, "stopped", Value::none,
              "the firmware acknowledges moves and does none of them until M999"},
    KindFacts{K::silent_work, "silentwork", Value::seconds,
              "the command of the moment takes SECONDS longer, and the firmware says nothing meanwhile"},
    KindFacts{K::chatty_work, "chattywork", Value::seconds,
              "the command of the moment takes SECONDS longer, and reports a probed point every 3 s"},
};

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
  throw std::invalid_argument(fmt::format("the fault \"{}\" {}", text, why));
}

const KindFacts& facts_of(FaultKind kind) {
  return *std::find_if(kinds.begin(), kinds.end(), [kind](const KindFacts& f) { return f.kind == kind; });
}

const KindFacts& kind_named(std::string_view name, std::string_view fault) {
  std::string names;
  for (const KindFacts& facts : kinds) {
    if (facts.name == name) return facts;
    names += (names.empty() ? "" : ", ") + std::string(facts.name);
  }
  refuse(fault, fmt::format("has an unknown kind; the kinds are {}", names));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view{} : text.substr(first, last - first + 1);
}

template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double seconds_from(std::string_view text, std::string_view fault) {
  constexpr double longest = 1e7;
  const auto value = number<double>(text);
  if (!value || !(*value >= 0 && *value <= longest)) {
    refuse(fault, fmt::format("needs a number of seconds, not \"{}\"", text));
  }
  return *value;
}

void read_moment(std::string_view moment, std::string_view text, Fault& fault) {
  const auto equals = moment.find('=');
  const std::string_view which = moment.substr(0, equals);
  const std::string_view value = equals == std::string_view::npos ? "" : moment.substr(equals + 1);
  if (which == "t") {
    fault.time = seconds_from(value, text);
  } else if (which == "line") {
    fault.line = number<std::int64_t>(value);
    if (!fault.line) refuse(text, "needs a line number after line=");
  } else if (which == "command" && !value.empty()) {
    fault.command = std::string(value);
  } else {
    refuse(text, "has an unknown moment; use @t=SECONDS, @line=NUMBER or @command=WORD");
  }
}

void read_chance(std::string_view value, std::string_view text, Fault& fault) {
  if (value.empty() && fault.has_moment()) return;
  const auto chance = number<double>(value);
  if (!chance || !(*chance >= 0 && *chance <= 1)) {
    refuse(text, "needs a chance from 0 to 1, as in bitflip:1e-4, or a moment");
  }
  fault.chance = *chance;
}

void read_value(Value kind, std::string_view value, std::string_view text, Fault& fault) {
  switch (kind) {
    case Value::none:
      if (!value.empty()) refuse(text, "takes no value");
      return;
    case Value::chance:
      return read_chance(value, text, fault);
    case Value::optional_seconds:
      if (value.empty()) return;
      [[fallthrough]];
    case Value::seconds:
      fault.seconds = seconds_from(value, text);
      return;
    case Value::text:
      if (value.empty()) refuse(text, "needs a text, as in say://action:pause@t=60");
      fault.text = std::string(value);
  }
}

}  // namespace

std::string_view name(FaultKind kind) {
  return facts_of(kind).name;
}

std::string fault_help() {
  std::string help;
  for (const KindFacts& facts : kinds) {
    static constexpr std::array<std::string_view, 5> values{"", ":CHANCE", ":SECONDS", "[:SECONDS]", ":TEXT"};
    help += fmt::format("  {:<22}{}\n",
                        std::string(facts.name) + std::string(values[static_cast<std::size_t>(facts.value)]),
                        facts.what);
  }
  return help;
}

Fault parse_fault(std::string_view text) {
  text = trimmed(text);
  const auto at = text.rfind('@');
  const std::string_view before = text.substr(0, at);
  const auto colon = before.find(':');
  const KindFacts& facts = kind_named(before.substr(0, colon), text);
  Fault fault;
  fault.kind = facts.kind;
  if (at != std::string_view::npos) read_moment(text.substr(at + 1), text, fault);
  read_value(facts.value, colon == std::string_view::npos ? "" : before.substr(colon + 1), text, fault);
  const bool timeless = facts.kind == K::slow || facts.kind == K::slow_boot;
  if (timeless && fault.has_moment()) refuse(text, "acts all the time and takes no moment");
  const bool work = facts.kind == K::silent_work || facts.kind == K::chatty_work;
  if (work && !fault.command) refuse(text, "needs a command as its moment, as in silentwork:40@command=G29");
  const bool always = facts.value == Value::chance || timeless;
  if (!always && !fault.has_moment()) refuse(text, "needs a moment, as in reset@t=60 or reset@line=100");
  return fault;
}

FaultPlan parse_faults(std::string_view text, const std::string& file) {
  FaultPlan plan;
  for (std::size_t number_of_line = 1; !text.empty(); ++number_of_line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, std::min(end, text.find('#'))));
    text.remove_prefix(std::min(end + 1, text.size()));
    try {
      if (line.starts_with("seed ")) {
        const auto seed = number<std::uint64_t>(trimmed(line.substr(5)));
        if (!seed) refuse(line, "needs a whole number as seed");
        plan.seed = *seed;
      } else if (!line.empty()) {
        plan.faults.push_back(parse_fault(line));
      }
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("{}:{}: {}", file, number_of_line, error.what()));
    }
  }
  return plan;
}

FaultPlan read_faults(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) {
    throw std::system_error(errno, std::generic_category(), "cannot read the faults in " + file.string());
  }
  return parse_faults(text, file.string());
}

}  // namespace unicursal::sim
