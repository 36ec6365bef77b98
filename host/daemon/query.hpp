// The words behind the question mark of an address: "since=12&from=3".
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "host/http/http_message.hpp"

namespace unicursal::host {

/// Throws HttpError 400 for a word that is not `known`, without a number of at least 0, or there twice.
/// Absent if the query is empty.
std::optional<double> query_number(const RequestHead& request, std::string_view known);
/// The same; the number is whole.
std::optional<std::uint64_t> query_whole_number(const RequestHead& request, std::string_view known);

}  // namespace unicursal::host
