// The last lines that a person may want to read: what the printer has said, what this program did, and its
// notices. It belongs to the loop's thread.
#pragma once

#include <cstdint>
#include <deque>
#include <nlohmann/json.hpp>
#include <string>

namespace unicursal::host {

class LogRecord {
 public:
  static constexpr std::size_t most = 1000;         ///< lines that are kept
  static constexpr std::size_t longest_line = 400;  ///< bytes; the rest is cut off

  enum class From { printer, host, notice };
  /// Keeps a line; the printer's are made printable.
  void note(From from, const std::string& text);
  /// {"next", "lines"}: the lines from the number `id` on; "next" is the number of the line to come.
  nlohmann::json since(std::uint64_t id) const;

 private:
  struct Line {
    std::uint64_t id = 0;
    double time = 0;  ///< unix seconds
    From from = From::host;
    std::string text;
  };
  std::deque<Line> lines_;  ///< the oldest first
  std::uint64_t next_ = 0;
};

}  // namespace unicursal::host
