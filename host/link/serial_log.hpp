// A log of a serial line, for diagnosis: every byte, escaped, on lines such as
//
//       12.345678 > N1 G28*18\n
//       12.351204 < ok\n
//
// Each line has the seconds of the link's clock since the first entry, the direction (> to the printer, <
// from it), and the bytes up to a newline or up to the end of what came at once. Printable ASCII stands for
// itself, a backslash becomes \\, and everything else becomes \n, \r or \xNN.
//
// A thread of its own writes the file: an entry costs the caller a copy. If the disk is too slow, entries are
// left out, and the log says how many bytes are missing; a print never waits for its log.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "host/loop/clock.hpp"

namespace unicursal::host {

class SerialLog {
 public:
  enum class Way { out, in };

  struct Limits {
    std::size_t file = 16 << 20;    ///< Bytes after which FILE becomes FILE.1, FILE.1 becomes FILE.2, …
    std::size_t files = 4;          ///< Number of files that are kept.
    std::size_t waiting = 1 << 20;  ///< Bytes that may wait for the disk.
  };

  /// Overwrites the file. Throws core::DataError if it cannot be written.
  explicit SerialLog(std::filesystem::path file) : SerialLog(std::move(file), Limits{}) {}
  SerialLog(std::filesystem::path file, const Limits& limits);
  /// Writes the waiting entries.
  ~SerialLog();
  SerialLog(const SerialLog&) = delete;
  SerialLog& operator=(const SerialLog&) = delete;

  void add(Way way, TimePoint time, std::string_view bytes);

  /// Number of bytes left out so far.
  std::uint64_t dropped() const;

 private:
  struct Entry {
    Way way;
    TimePoint time;
    std::string bytes;
  };

  void run();
  void write(const Entry& entry);
  void put(const std::string& line);
  void rotate();

  const std::filesystem::path file_;
  const Limits limits_;
  std::ofstream stream_;
  std::size_t written_ = 0;         ///< Bytes in the current file.
  std::optional<TimePoint> begun_;  ///< Time of the first entry.

  mutable std::mutex mutex_;  ///< Guards the members below.
  std::condition_variable work_;
  std::vector<Entry> entries_;
  std::size_t waiting_ = 0;  ///< Bytes in `entries_`.
  std::uint64_t dropped_ = 0;
  bool over_ = false;
  std::thread thread_;
};

/// Returns the bytes as the log writes them.
std::string escaped(std::string_view bytes);

}  // namespace unicursal::host
