// A small Marlin at the other end of a real pseudo-terminal, in a thread of its own: enough of a firmware to
// test the link's protocol, with a hook for every line in each direction.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace unicursal::test {

struct FakeBehaviour {
  /// Returns what really arrives of a line with its newline; by default all of it.
  std::function<std::string(std::string)> inwards = nullptr;
  /// The same for a reply.
  std::function<std::string(std::string)> outwards = nullptr;
  /// Called instead of executing the n-th (from 1) accepted command; returns true if it has handled it.
  std::function<bool(class FakePrinter&, std::size_t, const std::string&)> instead = nullptr;
  /// Called whenever nothing has arrived for 200 ms.
  std::function<void(class FakePrinter&)> on_tick = nullptr;
  bool boots = true;      ///< Whether it sends boot messages.
  bool advanced = false;  ///< Whether an ok reads "ok N… P… B…".
};

class FakePrinter {
 public:
  explicit FakePrinter(FakeBehaviour behaviour);
  ~FakePrinter();

  const std::string& path() const { return path_; }
  /// Ends the thread and hangs up; the results can be read afterwards.
  void stop();

  /// Accepted numbered commands in order, without queries (M105) and M110.
  const std::vector<std::string>& executed() const { return executed_; }
  std::size_t errors() const { return errors_; }
  std::size_t dropped_repeats() const { return dropped_repeats_; }
  /// The most unanswered bytes that were seen at once.
  std::size_t longest_burst() const { return longest_burst_; }
  bool killed() const { return killed_; }

  // For `instead`, which runs in the printer's thread.
  void reply(std::string_view line);
  /// Like reply(), at once, although the command is not finished.
  void say(std::string_view line);
  void fall_silent() { silent_ = true; }
  void forget_numbers(long last = 0) { last_ = last; }
  void hang_up();

 private:
  void run();
  void receive(std::string_view bytes);
  bool process(const std::string& line);
  bool process_numbered(const std::string& line);
  void refuse(const std::string& why);
  void execute(const std::string& command, bool numbered);
  void acknowledge(bool numbered);
  void flush();

  FakeBehaviour behaviour_;
  int master_ = -1, slave_ = -1;
  int stop_[2] = {-1, -1};
  std::string path_, input_, output_;
  std::vector<std::string> executed_;
  long last_ = 0;
  std::size_t accepted_ = 0, errors_ = 0, dropped_repeats_ = 0, longest_burst_ = 0;
  bool silent_ = false, killed_ = false;
  std::thread thread_;
};

}  // namespace unicursal::test
