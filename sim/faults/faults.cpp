#include "sim/faults/faults.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace unicursal::sim {

namespace {

bool needs_occasion(FaultKind kind) {
  return kind < FaultKind::slow;
}

/// "N12 G28 X" → "G28 X"; other lines stay as they are.
std::string_view without_number(std::string_view line) {
  if (!line.starts_with('N')) return line;
  const std::size_t behind = line.find_first_not_of("0123456789 ", 1);
  return behind == std::string_view::npos ? std::string_view{} : line.substr(behind);
}

bool is_command(std::string_view line, std::string_view word) {
  const std::string_view body = without_number(line);
  if (!body.starts_with(word)) return false;
  return body.size() == word.size() || body[word.size()] < '0' || body[word.size()] > '9';
}

std::optional<std::int64_t> number_of(std::string_view line) {
  std::int64_t number = 0;
  if (!line.starts_with('N')) return std::nullopt;
  const auto read = std::from_chars(line.data() + 1, line.data() + line.size(), number);
  return read.ec == std::errc{} ? std::optional(number) : std::nullopt;
}

char flipped(char byte, std::uint64_t bit) {
  return static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << (bit % 8)));
}

bool is_ok(std::string_view line) {
  return line == "ok" || line.starts_with("ok ");
}

/// One that the firmware makes by itself, or while it waits for heat; an answer to M105 begins with its ok.
bool is_report(std::string_view line) {
  return line.starts_with("T:") || line.starts_with(" T:");
}

bool is_resend(std::string_view line) {
  return line.starts_with("Resend:");
}

}  // namespace

Faults::Faults(const FaultPlan& plan) : details_(plan.seed) {
  for (std::size_t i = 0; i < plan.faults.size(); ++i) {
    std::seed_seq seeds{plan.seed, plan.seed >> 32, static_cast<std::uint64_t>(i) + 1};
    armed_.push_back({plan.faults[i], std::mt19937_64(seeds), 0, false});
  }
}

bool Faults::strikes(Armed& armed) {
  const bool by_moment = armed.pending > 0;
  if (by_moment) --armed.pending;
  constexpr double unit = 1.0 / 9007199254740992.0;  // 2^-53
  const bool by_chance =
      armed.fault.chance > 0 && static_cast<double>(armed.chance() >> 11) * unit < armed.fault.chance;
  if (by_moment || by_chance) ++counts_[std::string(name(armed.fault.kind))];
  return by_moment || by_chance;
}

bool Faults::strikes(FaultKind kind) {
  bool struck = false;
  for (Armed& armed : armed_) {
    if (armed.fault.kind == kind && strikes(armed)) struck = true;
  }
  return struck;
}

// ---- bytes to the printer

std::vector<WireByte> Faults::to_printer(std::string_view bytes) {
  std::vector<WireByte> result;
  result.reserve(bytes.size());
  for (const char byte : bytes) damage_byte({byte, false}, result);
  return result;
}

void Faults::damage_byte(WireByte byte, std::vector<WireByte>& bytes) {
  if (strikes(FaultKind::lost_byte) || (byte.value == '\n' && strikes(FaultKind::merged_lines))) {
    gap_ = true;
    return;
  }
  byte.damaged = std::exchange(gap_, false);
  if (strikes(FaultKind::bit_flip)) byte = {flipped(byte.value, details_()), true};
  bytes.push_back(byte);
}

Misreading Faults::received(std::string_view line) {
  const auto number = number_of(line);
  for (Armed& armed : armed_) {
    const Fault& fault = armed.fault;
    const bool by_line = fault.line && number && *number == *fault.line && !std::exchange(armed.past, true);
    const bool by_command = fault.command && is_command(line, *fault.command);
    if (by_line || by_command) arm(armed);
  }
  // Every kind draws its chance, whether or not another one strikes, so that the kinds stay independent.
  const bool damaged = strikes(FaultKind::false_alarm), misnumbered = strikes(FaultKind::false_number),
             unchecked = strikes(FaultKind::false_missing), forgotten = number && strikes(FaultKind::rewind);
  return damaged       ? Misreading::damaged
         : misnumbered ? Misreading::misnumbered
         : unchecked   ? Misreading::unchecked
         : forgotten   ? Misreading::forgotten
                       : Misreading::none;
}

// ---- lines from the printer

std::string Faults::from_printer(std::string_view line) {
  std::string text = before_reply();
  text += behind_report(is_ok(line));
  if (is_report(line) && strikes(FaultKind::glued_ok)) {
    unfinished_ = line;
    return damaged(text);
  }
  std::string whole = std::string(line) + '\n';
  if (is_ok(line)) {
    if (strikes(FaultKind::lost_ok)) whole.clear();
    if (strikes(FaultKind::broken_ok)) whole = misspelt_ok();
    if (const auto other = other_ok()) whole = *other + '\n';
    if (strikes(FaultKind::double_ok)) whole += whole;
  } else if (is_resend(line)) {
    if (strikes(FaultKind::lost_resend)) whole.clear();
    if (strikes(FaultKind::double_resend)) whole += whole;
  }
  return damaged(text + whole);
}

/// What remains of a report before the next line: nothing else is glued to it than an ok.
std::string Faults::behind_report(bool ok) {
  std::string report = std::exchange(unfinished_, {});
  if (!report.empty() && !ok) report += '\n';
  return report;
}

std::string Faults::misspelt_ok() {
  static constexpr std::array<const char*, 6> spellings{"k\n", "o", "kok\n", "OK\n", "ok", "o\x1bk\n"};
  return spellings[details_() % spellings.size()];
}

std::optional<std::string> Faults::other_ok() {
  std::optional<std::string> text;
  for (Armed& armed : armed_) {
    if (armed.fault.kind == FaultKind::other_ok && strikes(armed)) text = armed.fault.text;
  }
  return text;
}

std::string Faults::before_reply() {
  std::string text;
  if (strikes(FaultKind::noise)) text += noise();
  if (strikes(FaultKind::bad_utf8)) text += "\xc3\x28\xff\xfe echo \xe2\x82\n";
  if (strikes(FaultKind::nul)) text += std::string("\0echo\0\0:\0\n", 10);
  return text;
}

std::string Faults::noise() {
  constexpr std::size_t longest = 40;
  std::string text(details_() % longest + 1, ' ');
  for (char& byte : text) byte = static_cast<char>(details_() % 255 + 1);
  return text + '\n';
}

std::string Faults::damaged(std::string text) {
  std::string result;
  for (const char byte : text) {
    if (strikes(FaultKind::lost_reply)) continue;
    result += strikes(FaultKind::reply_flip) ? flipped(byte, details_()) : byte;
  }
  return result;
}

double Faults::delay() {
  double longest = 0;
  for (const Armed& armed : armed_) {
    if (armed.fault.kind == FaultKind::slow) longest = std::max(longest, armed.fault.seconds);
  }
  if (longest == 0) return 0;
  ++counts_[std::string(name(FaultKind::slow))];
  constexpr double parts = 1000;
  return longest * static_cast<double>(details_() % static_cast<std::uint64_t>(parts)) / parts;
}

// ---- faults of the printer itself

/// Called when the moment of a fault has come.
void Faults::arm(Armed& armed) {
  if (needs_occasion(armed.fault.kind)) {
    ++armed.pending;
    return;
  }
  ++counts_[std::string(name(armed.fault.kind))];
  events_.push_back(armed.fault);
}

std::optional<double> Faults::boot_seconds() const {
  std::optional<double> longest;
  for (const Armed& armed : armed_) {
    if (armed.fault.kind == FaultKind::slow_boot)
      longest = std::max(longest.value_or(armed.fault.seconds), armed.fault.seconds);
  }
  return longest;
}

std::vector<Fault> Faults::long_works() const {
  std::vector<Fault> works;
  for (const Armed& armed : armed_) {
    const FaultKind kind = armed.fault.kind;
    if (kind == FaultKind::silent_work || kind == FaultKind::chatty_work) works.push_back(armed.fault);
  }
  return works;
}

std::optional<double> Faults::next_time() const {
  std::optional<double> next;
  for (const Armed& armed : armed_) {
    if (!armed.fault.time || armed.past) continue;
    next = std::min(next.value_or(*armed.fault.time), *armed.fault.time);
  }
  return next;
}

std::vector<Fault> Faults::due(double now) {
  for (Armed& armed : armed_) {
    if (!armed.fault.time || armed.past || *armed.fault.time > now) continue;
    armed.past = true;
    arm(armed);
  }
  return std::exchange(events_, {});
}

}  // namespace unicursal::sim
