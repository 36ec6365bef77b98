// A progress line that is rewritten on a terminal, and an occasional plain line elsewhere. On standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace unicursal::host {

class Progress {
 public:
  /// `what` says what is being done: "planning", "printing". `layers`: how many there are.
  Progress(std::string what, std::size_t layers);
  /// Takes the line away.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `begun` layers before the present one, and the part of it that is done, 0…1.
  void update(std::size_t begun, double fraction);
  /// A message of its own line, above the progress.
  void say(const std::string& message);

 private:
  using Clock = std::chrono::steady_clock;

  void clear();
  std::string line(std::size_t begun, double share) const;

  std::string what_;
  std::size_t layers_;
  bool terminal_;
  bool shown_ = false;
  int last_tenth_ = 0;
  Clock::time_point started_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace unicursal::host
