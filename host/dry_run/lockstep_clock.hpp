// The clock of a dry run in virtual time: the simulated printer's, held in lockstep over its control socket
// (protocol: sim/lockstep.hpp). Time advances only when the loop has nothing left to do, and then at once to
// the next event. So nothing depends on the speed of this computer.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/loop/clock.hpp"

namespace unicursal::host {

class LockstepClock final : public Clock {
 public:
  /// Connects to a simulator's control socket. Throws SimulatorError.
  explicit LockstepClock(const std::filesystem::path& control);
  ~LockstepClock() override;
  LockstepClock(const LockstepClock&) = delete;
  LockstepClock& operator=(const LockstepClock&) = delete;

  TimePoint now() const override { return now_; }
  void set(asio::steady_timer& timer, TimePoint deadline) override;
  void forget(asio::steady_timer& timer) noexcept override;
  /// Throws SimulatorError if the simulator is gone, or if it and the host wait for each other.
  void run(asio::io_context& loop) override;
  /// The simulator waits for every byte that it was announced.
  bool may_discard() const override { return false; }
  void attach(int port, std::function<std::uint64_t()> written) override;

 private:
  struct Alarm {
    asio::steady_timer* timer;
    TimePoint deadline;
  };

  TimePoint next_deadline() const;
  void step();
  void ask(TimePoint until);
  std::string answer();
  void await_bytes(std::uint64_t count, bool gone) const;
  void ring();

  int socket_ = -1;
  int port_ = -1;
  std::function<std::uint64_t()> written_;
  std::uint64_t written_before_ = 0;  ///< by earlier conversations on the same line
  std::vector<Alarm> alarms_;
  std::string pending_;       ///< an answer that is not yet complete
  TimePoint now_{};           ///< since the printer's power-up
  std::uint64_t handed_ = 0;  ///< bytes that the printer has handed over in all
};

}  // namespace unicursal::host
