// The addresses and names of this computer in its network, as they are now. An address in a Host header
// cannot be an attacker's name that resolves to this computer (DNS rebinding). Neither can the name that mDNS
// gives this computer (RFC 6762), nor its bare name: nobody can register these.
#pragma once

#include <string>
#include <vector>

namespace unicursal::host {

/// The computer's name, and that name with ".local", in lower case; empty if it is called localhost.
std::vector<std::string> own_names();

/// Values of Host: each address of an interface that is up, with the port (and without, if that is 80).
std::vector<std::string> own_hosts(unsigned port);

/// "192.168.1.5:8377": the first address that is not the loopback's, IPv4 before IPv6; else the name with
/// ".local".
std::string reachable_address(unsigned port);

}  // namespace unicursal::host
