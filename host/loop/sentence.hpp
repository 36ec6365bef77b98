// What went wrong, for people.
#pragma once

#include <exception>
#include <string>

namespace unicursal::host {

/// The message of an exception, which is a sentence with its remedy in this program; of bad_alloc, and of
/// what is not a std::exception, one is made. Precondition: `error` is not null.
std::string sentence(const std::exception_ptr& error);

}  // namespace unicursal::host
