// Texts that prove who somebody is.
#pragma once

#include <string>

namespace unicursal::host {

/// 256 random bits from the system, in hexadecimal.
std::string random_token();

/// Compares in a time that does not show where they differ.
bool is_same_secret(const std::string& a, const std::string& b);

}  // namespace unicursal::host
