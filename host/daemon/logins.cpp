#include "host/daemon/logins.hpp"

#include "host/daemon/secret.hpp"

namespace unicursal::host {

std::string Logins::open(const std::string& secret) {
  if (logins_.size() == most) logins_.pop_front();
  logins_.push_back({random_key(), secret});
  return logins_.back().session;
}

void Logins::close(const std::string& session) {
  std::erase_if(logins_, [&](const Login& one) { return is_same_secret(one.session, session); });
}

std::optional<std::string> Logins::secret_of(const std::string& session) const {
  for (const Login& one : logins_) {
    if (is_same_secret(one.session, session)) return one.secret;
  }
  return std::nullopt;
}

}  // namespace unicursal::host
