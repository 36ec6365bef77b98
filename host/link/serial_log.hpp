// What went over a serial line, for looking into trouble afterwards: every byte, escaped, on lines such as
//
//       12.345678 > N1 G28*18\n
//       12.351204 < ok\n
//
// seconds of the link's clock since the first entry, sent (>) or heard (<), and the bytes up to a newline or
// as far as they came at once. Printable ASCII stands for itself, a backslash is \\, everything else \n, \r,
// \xNN.
//
// A thread of its own does the writing: an entry costs the caller a copy. When the disk cannot follow,
// entries are left out and the log says how many bytes; a print never waits for its log.
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
    std::size_t file = 16 << 20;    ///< bytes, after which FILE becomes FILE.1, FILE.1 becomes FILE.2, …
    std::size_t files = 4;          ///< kept in all
    std::size_t waiting = 1 << 20;  ///< bytes that may wait for the disk
  };

  /// Begins the file anew. Throws core::DataError when it cannot be written.
  explicit SerialLog(std::filesystem::path file) : SerialLog(std::move(file), Limits{}) {}
  SerialLog(std::filesystem::path file, const Limits& limits);
  /// Writes what waits.
  ~SerialLog();
  SerialLog(const SerialLog&) = delete;
  SerialLog& operator=(const SerialLog&) = delete;

  void add(Way way, TimePoint time, std::string_view bytes);

  /// Bytes left out so far.
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
  std::size_t written_ = 0;         ///< bytes in the present file
  std::optional<TimePoint> begun_;  ///< of the first entry

  mutable std::mutex mutex_;  ///< over what follows
  std::condition_variable work_;
  std::vector<Entry> entries_;
  std::size_t waiting_ = 0;  ///< bytes in them
  std::uint64_t dropped_ = 0;
  bool over_ = false;
  std::thread thread_;
};

/// As the log writes them.
std::string escaped(std::string_view bytes);

}  // namespace unicursal::host
