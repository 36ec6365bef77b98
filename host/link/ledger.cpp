#include "host/link/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>

namespace unicursal::host {
namespace {

/// Number of acknowledged lines that are kept: several times as many as can be in flight. A firmware that
/// asks for an older one has not missed a line, but was reset.
constexpr std::uint32_t kept = 64;

constexpr std::uint32_t repetier_modulus = 65536;

bool is_query(std::string_view command) {
  return command == "M105" || command.starts_with("M105 ");
}

/// Heating, homing, probing, calibrating, dwelling, cleaning, and waiting for a person or for filament.
bool is_slow(std::string_view command) {
  constexpr std::array slow{"G4",   "G12",  "G28",  "G29",  "G30",  "G32",  "G33",  "G34",  "G35",
                            "G76",  "G80",  "G425", "M0",   "M1",   "M48",  "M109", "M116", "M125",
                            "M190", "M191", "M192", "M226", "M303", "M306", "M600", "M701", "M702"};
  const auto behind_number = command.find_first_not_of("0123456789", 1);
  return std::find(slow.begin(), slow.end(), command.substr(0, behind_number)) != slow.end();
}

/// A wait that somebody may want to end; homing and probing end by themselves.
bool is_wait(std::string_view frame) {
  constexpr std::array waits{"M0", "M1", "M109", "M116", "M190", "M191", "M192", "M226", "M600"};
  const std::string_view command = frame.substr(std::min(frame.find(' ') + 1, frame.size()));
  const auto behind_number = command.find_first_not_of("0123456789", 1);
  return std::find(waits.begin(), waits.end(), command.substr(0, behind_number)) != waits.end();
}

}  // namespace

std::string framed(std::uint32_t number, std::string_view command) {
  std::string line = fmt::format("N{} {}", number, command);
  unsigned char checksum = 0;
  for (char c : line) checksum = static_cast<unsigned char>(checksum ^ static_cast<unsigned char>(c));
  fmt::format_to(std::back_inserter(line), "*{}\n", checksum);
  return line;
}

void Ledger::number(std::string_view command, bool fence) {
  has_moved_ =
      has_moved_ || command.starts_with("G0") || command.starts_with("G1") || command.starts_with("G28");
  lines_.push_back({framed(end(), command), is_query(command), is_slow(command), fence,
                    fence ? 0 : move_clock_.seconds(command)});
  if (!fence) ++numbered_;
}

std::size_t Ledger::fill(std::string& bytes) {
  std::size_t count = 0;
  for (;; ++count) {
    if (next_ == end()) {
      if (waiting_.empty() || end() > last_) break;
      number(waiting_.front(), false);
      waiting_.pop_front();
    }
    const std::string& frame = line(next_).frame;
    if (counted_ < next_ && bytes_in_buffer_ + frame.size() > window_) break;
    bytes += frame;
    bytes_in_buffer_ += frame.size();
    ++next_;
  }
  return count;
}

void Ledger::advance(std::uint32_t front) {
  leave_buffer(std::min(front, next_));
  for (; front_ < front; ++front_) {
    if (!line(front_).fence) ++acknowledged_;
    fresh_seconds_ += line(front_).seconds.value_or(0);
  }
}

bool Ledger::all_timed() const {
  for (std::uint32_t n = front_; n < next_; ++n) {
    if (!line(n).seconds) return false;
  }
  return true;
}

double Ledger::queued_seconds() const {
  constexpr int most_moves = 16;  // Marlin's BLOCK_BUFFER_SIZE
  double sum = 0;
  int moves = 0;
  for (std::uint32_t n = front_; n > base_ && moves < most_moves; --n) {
    const double seconds = line(n - 1).seconds.value_or(0);
    sum += seconds;
    if (seconds > 0) ++moves;
  }
  return sum;
}

void Ledger::leave_buffer(std::uint32_t front) {
  for (; counted_ < front; ++counted_) bytes_in_buffer_ -= line(counted_).frame.size();
}

void Ledger::forget() {
  while (front_ - base_ > kept) lines_.pop_front(), ++base_;
}

std::string_view Ledger::oldest_command() const {
  const std::string_view frame = line(front_).frame;
  const auto begin = frame.find(' ') + 1;
  return frame.substr(begin, frame.rfind('*') - begin);
}

bool Ledger::acknowledge() {
  if (!in_flight() || line(front_).fence) return false;
  advance(front_ + 1);
  forget();
  return true;
}

bool Ledger::acknowledge_number(std::uint32_t number, std::uint32_t queued) {
  const auto known = locate(number);
  if (!known || *known < front_ || *known >= next_) return false;
  const bool oldest = *known == front_;
  advance(*known + 1);
  leave_buffer(std::min(front_ + queued, next_));
  forget();
  return oldest;
}

bool Ledger::acknowledge_query() {
  for (std::uint32_t n = front_; n < next_; ++n) {
    if (!line(n).query) continue;
    advance(n + 1);
    forget();
    return true;
  }
  return false;
}

std::optional<std::uint32_t> Ledger::locate(std::uint32_t number) const {
  if (number >= base_ && number <= end()) return number;
  const std::uint32_t behind = (end() - number) % repetier_modulus;
  if (number < repetier_modulus && behind <= end() - base_) return end() - behind;
  return std::nullopt;
}

bool Ledger::slow() const {
  return slow_since(base_);
}

bool Ledger::slow_in_flight() const {
  return in_flight() && slow_since(front_);
}

bool Ledger::waits_before(std::uint32_t beyond) const {
  return in_flight() && front_ < beyond && is_wait(line(front_).frame);
}

bool Ledger::slow_since(std::uint32_t number) const {
  const auto at = [this](std::uint32_t n) { return lines_.begin() + static_cast<std::ptrdiff_t>(n - base_); };
  return std::any_of(at(number), at(next_), [](const Line& line) { return line.slow; });
}

void Ledger::rewind(std::uint32_t number) {
  assert(number >= base_ && number <= end());
  advance(number);
  for (; front_ > number; --front_) {
    if (!line(front_ - 1).fence) --acknowledged_;
  }
  next_ = counted_ = number;
  bytes_in_buffer_ = 0;
  forget();
}

bool Ledger::fence() {
  for (std::uint32_t n = front_; n < end(); ++n) {
    if (line(n).fence) return false;
  }
  number("M105", true);
  return true;
}

void Ledger::restart() {
  assert(!in_flight() && next_ == end());
  lines_.clear();
  base_ = front_ = next_ = counted_ = 1;
}

}  // namespace unicursal::host
