#include "host/daemon/keys.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/text/printable.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/secret.hpp"
#include "host/daemon/state_folder.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::size_t longest_name = 64;
constexpr std::pair<Right, const char*> names[] = {
    {Right::watch, "watch"}, {Right::queue, "queue"}, {Right::steer, "steer"}};

std::int64_t seconds_since_1970() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string checked_name(const std::string& name) {
  if (name.empty() || name.size() > longest_name)
    throw Refused(Why::bad_name, "the name of a program has 1 to 64 bytes; choose a short one");
  return core::printable(name);
}

}  // namespace

const char* name(Right right) {
  for (const auto& [one, word] : names) {
    if (one == right) return word;
  }
  return "all";
}

std::optional<Right> right_named(const std::string& word) {
  for (const auto& [right, known] : names) {
    if (word == known) return right;
  }
  return std::nullopt;
}

Keys::Keys(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream stream(file_);
  if (!stream) return;
  try {
    const json stored = json::parse(stream);
    next_id_ = stored.at("next_id").get<std::uint64_t>();
    for (const json& entry : stored.at("keys")) {
      keys_.push_back({entry.at("id").get<std::uint64_t>(), entry.at("name").get<std::string>(),
                       right_named(entry.at("right").get<std::string>()).value(),
                       entry.at("secret").get<std::string>(), entry.at("made").get<std::int64_t>()});
    }
  } catch (const std::exception&) {
    throw DaemonError(file_.string(), "", "is not a list of keys of this program",
                      "move it away; the keys in it have to be made again");
  }
}

void Keys::save() const {
  json entries = json::array();
  for (const Key& key : keys_) {
    entries.push_back({{"id", key.id},
                       {"name", key.name},
                       {"right", host::name(key.right)},
                       {"secret", key.secret},
                       {"made", key.made}});
  }
  const json all = {{"version", 1}, {"next_id", next_id_}, {"keys", entries}};
  try {
    write_state(file_, all.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
  } catch (const DaemonError& full) {
    throw Refused(Why::no_room, full.what());
  }
}

const Key* Keys::with_secret(const std::string& secret) const {
  const Key* found = nullptr;
  for (const Key& key : keys_) {
    if (is_same_secret(key.secret, secret)) found = &key;
  }
  return found;
}

const Key& Keys::add(const std::string& name, Right right) {
  if (keys_.size() >= most_keys)
    throw Refused(Why::conflict, "there are too many keys; remove those that nobody uses");
  keys_.push_back({next_id_++, checked_name(name), right, random_key(), seconds_since_1970()});
  try {
    save();
  } catch (const Refused&) {
    keys_.pop_back();
    throw;
  }
  return keys_.back();
}

void Keys::remove(std::uint64_t id) {
  const auto key = std::find_if(keys_.begin(), keys_.end(), [id](const Key& one) { return one.id == id; });
  if (key == keys_.end())
    throw Refused(Why::not_found, "a key with that number does not exist; see `unicursal keys`");
  const std::vector<Key> before = keys_;
  keys_.erase(key);
  try {
    save();
  } catch (const Refused&) {
    keys_ = before;  // it would come back with the next daemon
    throw;
  }
}

// ---- programs that ask for one

void Keys::forget_old(Clock::time_point now) {
  std::erase_if(waiting_, [now](const Waiting& one) {
    return now - one.asked > patience || now - one.begun > longest_wait;
  });
}

std::vector<KeyRequest> Keys::requests(Clock::time_point now) {
  forget_old(now);
  std::vector<KeyRequest> open;
  for (const Waiting& one : waiting_) {
    if (one.secret.empty()) open.push_back(one);
  }
  return open;
}

std::string Keys::request(const std::string& name, const std::string& peer, Clock::time_point now) {
  forget_old(now);
  if (waiting_.size() >= most_requests)
    throw Refused(Why::busy, "too many programs ask for a key; try again in a minute");
  Waiting one;
  one.id = next_request_++;
  one.name = checked_name(name);
  one.peer = peer;
  one.ticket = random_token();
  one.asked = one.begun = now;
  waiting_.push_back(one);
  return one.ticket;
}

Keys::Answer Keys::ask(const std::string& ticket, Clock::time_point now) {
  forget_old(now);
  const auto one = std::find_if(waiting_.begin(), waiting_.end(),
                                [&](const Waiting& each) { return is_same_secret(each.ticket, ticket); });
  if (one == waiting_.end()) return {};
  one->asked = now;
  if (one->secret.empty()) return {Fate::waits, {}};
  const Answer answer{Fate::granted, one->secret};
  waiting_.erase(one);
  return answer;
}

Keys::Waiting& Keys::waiting(std::uint64_t request, Clock::time_point now) {
  forget_old(now);
  const auto one = std::find_if(waiting_.begin(), waiting_.end(), [request](const Waiting& each) {
    return each.id == request && each.secret.empty();
  });
  if (one == waiting_.end())
    throw Refused(Why::not_found, "no program asks under that number any more; see `unicursal keys`");
  return *one;
}

void Keys::grant(std::uint64_t request, Right right, Clock::time_point now) {
  Waiting& one = waiting(request, now);
  one.secret = add(one.name, right).secret;
}

void Keys::deny(std::uint64_t request, Clock::time_point now) {
  const std::uint64_t id = waiting(request, now).id;
  std::erase_if(waiting_, [id](const Waiting& one) { return one.id == id; });
}

}  // namespace unicursal::host
