#include "host/daemon/query.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace unicursal::host {
namespace {

/// The text behind "known="; absent if the query is empty.
std::optional<std::string_view> query_text(const RequestHead& request, std::string_view known) {
  const std::string_view query = request.query;
  if (query.empty()) return std::nullopt;
  const bool one = query.size() > known.size() && query.starts_with(known) && query[known.size()] == '=' &&
                   query.find('&') == std::string_view::npos;
  if (!one) throw HttpError(400, fmt::format("this address takes ?{}=NUMBER only", known));
  return query.substr(known.size() + 1);
}

HttpError not_a_number(std::string_view known) {
  return {400, fmt::format("{} is not a number of at least 0", known)};
}

template <typename Number>
std::optional<Number> number_in(const RequestHead& request, std::string_view known) {
  const auto text = query_text(request, known);
  if (!text) return std::nullopt;
  Number number{};
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
  if (error != std::errc() || end != text->data() + text->size()) throw not_a_number(known);
  return number;
}

}  // namespace

std::optional<double> query_number(const RequestHead& request, std::string_view known) {
  const auto number = number_in<double>(request, known);
  if (number && (!std::isfinite(*number) || *number < 0)) throw not_a_number(known);
  return number;
}

std::optional<std::uint64_t> query_whole_number(const RequestHead& request, std::string_view known) {
  return number_in<std::uint64_t>(request, known);
}

}  // namespace unicursal::host
