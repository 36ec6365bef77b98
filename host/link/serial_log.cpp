#include "host/link/serial_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.hpp"

namespace unicursal::host {
namespace {

/// Counted for each entry in addition to its bytes, so that many small entries are bounded, too.
constexpr std::size_t entry_cost = 64;

std::filesystem::path older(const std::filesystem::path& file, std::size_t number) {
  return file.string() + "." + std::to_string(number);
}

}  // namespace

std::string escaped(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() + 2);
  for (const char c : bytes) {
    if (c == '\n')
      text += "\\n";
    else if (c == '\r')
      text += "\\r";
    else if (c == '\\')
      text += "\\\\";
    else if (c >= ' ' && c <= '~')
      text += c;
    else
      fmt::format_to(std::back_inserter(text), "\\x{:02x}", static_cast<unsigned char>(c));
  }
  return text;
}

SerialLog::SerialLog(std::filesystem::path file, const Limits& limits)
    : file_(std::move(file)), limits_(limits), stream_(file_, std::ios::binary) {
  if (!stream_) {
    throw core::DataError(file_.string(), "", "the log cannot be written",
                          "name a file in a folder that exists and that you may write to");
  }
  thread_ = std::thread([this] { run(); });
}

SerialLog::~SerialLog() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  work_.notify_one();
  thread_.join();
}

void SerialLog::add(Way way, TimePoint time, std::string_view bytes) {
  const std::size_t cost = bytes.size() + entry_cost;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_ + cost > limits_.waiting) {
      dropped_ += bytes.size();
      return;
    }
    waiting_ += cost;
    entries_.push_back({way, time, std::string(bytes)});
    if (entries_.size() > 1) return;  // the first entry has woken the thread
  }
  work_.notify_one();
}

std::uint64_t SerialLog::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

void SerialLog::run() {
  std::uint64_t reported = 0;
  for (bool over = false; !over;) {
    std::vector<Entry> entries;
    std::uint64_t dropped;
    {
      std::unique_lock lock(mutex_);
      work_.wait(lock, [this] { return over_ || !entries_.empty(); });
      entries.swap(entries_);
      waiting_ = 0;
      dropped = dropped_;
      over = over_;
    }
    for (const Entry& entry : entries) write(entry);
    if (dropped > reported) put(fmt::format("{} bytes left out\n", dropped - reported));
    reported = dropped;
    stream_.flush();
  }
}

void SerialLog::write(const Entry& entry) {
  if (!begun_) begun_ = entry.time;
  const double seconds = std::chrono::duration<double>(entry.time - *begun_).count();
  std::string_view rest = entry.bytes;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
    put(fmt::format("{:13.6f} {} {}\n", seconds, entry.way == Way::out ? '>' : '<',
                    escaped(rest.substr(0, end))));
    rest.remove_prefix(end);
  }
}

void SerialLog::put(const std::string& line) {
  if (written_ > 0 && written_ + line.size() > limits_.file) rotate();
  stream_ << line;
  written_ += line.size();
}

/// Overwrites a file that cannot be renamed: the newest entries matter most.
void SerialLog::rotate() {
  stream_.close();
  std::error_code ignored;
  for (std::size_t number = limits_.files - 1; number > 0; --number) {
    const auto from = number > 1 ? older(file_, number - 1) : file_;
    std::filesystem::rename(from, older(file_, number), ignored);
  }
  stream_.clear();
  stream_.open(file_, std::ios::binary | std::ios::trunc);
  written_ = 0;
}

}  // namespace unicursal::host
