#include "sim/host_wait.hpp"

#include <charconv>
#include <limits>

namespace unicursal::sim {

namespace {

constexpr double ns = 1e-9;

/// Removes the number at the beginning of the text and returns it.
template <class Number>
std::optional<Number> take_number(std::string_view& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace

std::optional<HostWait> parse_wait(std::string_view message) {
  constexpr std::string_view word = "wait ";
  if (!message.starts_with(word)) return std::nullopt;
  message.remove_prefix(word.size());
  const auto until = take_number<std::int64_t>(message);
  if (!until || !message.starts_with(' ')) return std::nullopt;
  message.remove_prefix(1);
  const auto bytes = take_number<std::uint64_t>(message);
  if (!bytes || !message.empty()) return std::nullopt;
  constexpr double for_ever = std::numeric_limits<double>::infinity();
  return HostWait{*until < 0 ? for_ever : static_cast<double>(*until) * ns, *bytes};
}

}  // namespace unicursal::sim
