// Keys for single programs: a slicer, a phone, a home automation. Each has a name and a right, and can be
// removed without disturbing the others, which the token (state_folder.hpp) cannot. They lie in the state
// folder's `keys.json`, which only its owner can read.
//
// A program may ask for a key over the network, as OctoPrint's application keys have it (plugin "appkeys",
// its documentation and src/octoprint/plugins/appkeys of OctoPrint 2.0): it gets a ticket, asks again and
// again what has become of it, and has its key once the user has granted it with a command. Departures: a
// request is forgotten when its program has not asked for 30 s (OctoPrint: 5 s), since the user types a
// command; there are at most eight; and they do not outlive the daemon.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace unicursal::host {

/// Each includes those before it.
enum class Right {
  watch,  ///< see everything
  queue,  ///< send files, queue and remove jobs
  steer,  ///< start, pause and end prints, and change them
  all     ///< make and remove keys; never that of a key
};

const char* name(Right right);
/// Absent: not the name of a right that a key can have.
std::optional<Right> right_named(const std::string& word);

struct Key {
  std::uint64_t id = 0;
  std::string name;  ///< printable; two keys may have the same
  Right right = Right::steer;
  std::string secret;
  std::int64_t made = 0;  ///< s since 1970
};

struct KeyRequest {
  std::uint64_t id = 0;
  std::string name;    ///< what the program calls itself: printable, and not to be trusted
  std::string peer;    ///< the address from which it asks
  std::string ticket;  ///< only its program knows it
};

class Keys {
 public:
  static constexpr std::size_t most_keys = 100, most_requests = 8;
  static constexpr auto patience = std::chrono::seconds(30);      ///< between two questions of a program
  static constexpr auto longest_wait = std::chrono::minutes(10);  ///< for the user

  /// Reads the file if there is one. Throws DaemonError.
  explicit Keys(std::filesystem::path file);

  const std::vector<Key>& all() const { return keys_; }
  /// Null if no key is this one.
  const Key* with_secret(const std::string& secret) const;
  /// Throws Refused.
  const Key& add(const std::string& name, Right right);
  void remove(std::uint64_t id);

  using Clock = std::chrono::steady_clock;
  /// Those that somebody still waits for.
  std::vector<KeyRequest> requests(Clock::time_point now = Clock::now());
  /// Returns the ticket. Throws Refused.
  std::string request(const std::string& name, const std::string& peer, Clock::time_point now = Clock::now());
  enum class Fate { waits, granted, gone };
  struct Answer {
    Fate fate = Fate::gone;
    std::string secret;  ///< of the granted key; it is handed out once
  };
  /// Absent ticket: gone, as after a denial.
  Answer ask(const std::string& ticket, Clock::time_point now = Clock::now());
  /// Throws Refused.
  void grant(std::uint64_t request, Right right, Clock::time_point now = Clock::now());
  void deny(std::uint64_t request, Clock::time_point now = Clock::now());

 private:
  struct Waiting : KeyRequest {
    Clock::time_point asked, begun;
    std::string secret;  ///< once it is granted
  };
  Waiting& waiting(std::uint64_t request, Clock::time_point now);
  void forget_old(Clock::time_point now);
  void save() const;

  const std::filesystem::path file_;
  std::vector<Key> keys_;
  std::uint64_t next_id_ = 1;
  std::vector<Waiting> waiting_;
  std::uint64_t next_request_ = 1;
};

}  // namespace unicursal::host
