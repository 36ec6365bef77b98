#include "host/daemon/wrong_tries.hpp"

#include <algorithm>

namespace unicursal::host {
namespace {

constexpr std::chrono::milliseconds first_step(250), longest_step(2000);

}  // namespace

std::chrono::milliseconds WrongTries::wait_of(const std::string& peer, Clock::time_point now) {
  if (!peers_.contains(peer) && peers_.size() == most_peers) {
    peers_.erase(std::min_element(peers_.begin(), peers_.end(), [](const auto& a, const auto& b) {
      return a.second.last < b.second.last;
    }));
  }
  Peer& one = peers_[peer];
  if (now - one.last > memory) one = {};
  one.last = now;
  if (++one.tries <= free_tries) return {};
  const int doublings = std::min(one.tries - free_tries - 1, 3);
  one.free_at = std::max(one.free_at, now) + std::min(first_step * (1 << doublings), longest_step);
  one.free_at = std::min<Clock::time_point>(one.free_at, now + longest_wait);
  return std::chrono::ceil<std::chrono::milliseconds>(one.free_at - now);
}

}  // namespace unicursal::host
