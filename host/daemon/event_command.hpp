// A command of the user's that hears of what happens to prints: `serve --on-event`. It is run by sh with a
// JSON object on its standard input, one run at a time, in a thread of its own, so that nothing waits for it:
// runs that do not fit into a short queue are left out, and one that takes too long is killed with everything
// in its process group.
#pragma once

#include <sys/types.h>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

namespace unicursal::host {

/// What the command is given.
struct CommandEvent {
  std::string name;      ///< $UNICURSAL_EVENT, such as "print_ended"
  std::string sentence;  ///< $UNICURSAL_TEXT, for people; made safe to show
  std::string json;      ///< on standard input
};

class EventCommand {
 public:
  static constexpr std::chrono::seconds longest_run{30};
  static constexpr std::size_t most_waiting = 16;

  /// `longest`: after which a run is killed.
  explicit EventCommand(std::string command, std::chrono::milliseconds longest = longest_run);
  /// Gives the run that goes on, and those that wait, a moment; then kills it.
  ~EventCommand();
  EventCommand(const EventCommand&) = delete;
  EventCommand& operator=(const EventCommand&) = delete;

  /// Returns at once.
  void run(CommandEvent event);

 private:
  void work(const std::stop_token& stop);
  void run_one(const CommandEvent& event, const std::stop_token& stop) const;
  void await_end(pid_t child, const CommandEvent& event, const std::stop_token& stop) const;

  const std::string command_;
  const std::chrono::milliseconds longest_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<CommandEvent> waiting_;
  bool running_ = false;
  std::jthread thread_;  ///< the last member, so that it ends before the members that it uses
};

}  // namespace unicursal::host
