#include "host/daemon/own_addresses.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "core/text/wording.hpp"

namespace unicursal::host {
namespace {

struct Address {
  std::string text;  ///< IPv6 in brackets
  bool four = true;
  bool loopback = false;
};

std::optional<Address> address_of(const sockaddr* at) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (at->sa_family == AF_INET) {
    const auto* four = reinterpret_cast<const sockaddr_in*>(at);
    if (inet_ntop(AF_INET, &four->sin_addr, text.data(), text.size()) == nullptr) return std::nullopt;
    return Address{text.data()};
  }
  if (at->sa_family != AF_INET6) return std::nullopt;
  const auto* six = reinterpret_cast<const sockaddr_in6*>(at);
  // Link-local ones need a zone, which browsers do not know.
  if (IN6_IS_ADDR_LINKLOCAL(&six->sin6_addr)) return std::nullopt;
  if (inet_ntop(AF_INET6, &six->sin6_addr, text.data(), text.size()) == nullptr) return std::nullopt;
  return Address{fmt::format("[{}]", text.data()), false};
}

/// IPv4 first.
std::vector<Address> addresses() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> freeing(first, &freeifaddrs);
  std::vector<Address> found;
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || (one->ifa_flags & IFF_UP) == 0) continue;
    if (auto address = address_of(one->ifa_addr)) {
      address->loopback = (one->ifa_flags & IFF_LOOPBACK) != 0;
      found.push_back(std::move(*address));
    }
  }
  std::stable_partition(found.begin(), found.end(), [](const Address& one) { return one.four; });
  return found;
}

}  // namespace

std::vector<std::string> own_names() {
  std::array<char, 256> text{};
  if (gethostname(text.data(), text.size() - 1) != 0) return {};
  const std::string name = core::lower(text.data());
  if (name.empty() || name == "localhost") return {};
  return {name, name.substr(0, name.find('.')) + ".local"};
}

std::vector<std::string> own_hosts(unsigned port) {
  std::vector<std::string> hosts;
  for (const Address& one : addresses()) {
    hosts.push_back(fmt::format("{}:{}", one.text, port));
    if (port == 80) hosts.push_back(one.text);
  }
  return hosts;
}

std::string reachable_address(unsigned port) {
  for (const Address& one : addresses()) {
    if (!one.loopback) return fmt::format("{}:{}", one.text, port);
  }
  const std::vector<std::string> names = own_names();
  return fmt::format("{}:{}", names.empty() ? "localhost" : names.back(), port);
}

}  // namespace unicursal::host
