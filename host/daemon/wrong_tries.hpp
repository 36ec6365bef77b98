// How long whoever has shown a wrong token waits for the answer. A few tries are free; then each further one
// of the same peer waits behind the one before, also when they come at once. Only wrong tokens wait, so that
// nobody can shut out who has the right one, not even from behind the same proxy.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

namespace unicursal::host {

class WrongTries {
 public:
  static constexpr std::size_t most_peers =
      64;  ///< that are remembered; the one that was silent longest goes
  static constexpr int free_tries = 5;
  static constexpr auto memory = std::chrono::minutes(1);  ///< of a peer that tries no more
  static constexpr auto longest_wait = std::chrono::seconds(10);

  using Clock = std::chrono::steady_clock;
  /// Counts one more try of this peer.
  std::chrono::milliseconds wait_of(const std::string& peer, Clock::time_point now = Clock::now());

 private:
  struct Peer {
    int tries = 0;
    Clock::time_point last, free_at;
  };
  std::map<std::string, Peer> peers_;
};

}  // namespace unicursal::host
