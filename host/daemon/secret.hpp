// Texts that prove who somebody is.
#pragma once

#include <string>

namespace unicursal::host {

/// 256 random bits from the system, in hexadecimal.
std::string random_token();

/// 128 random bits, in hexadecimal: as long as a key of OctoPrint, since some of its clients refuse longer
/// ones.
std::string random_key();

/// Compares in a time that does not show where they differ.
bool is_same_secret(const std::string& a, const std::string& b);

}  // namespace unicursal::host
