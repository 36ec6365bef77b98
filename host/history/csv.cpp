#include "host/history/csv.hpp"

#include <fmt/format.h>

#include <ctime>
#include <string_view>

namespace unicursal::host {
namespace {

constexpr std::string_view heading =
    "id,print,job,file,began,ended_at,seconds,foretold_seconds,ended,reason,layers_done,layers,feeder,"
    "filament,"
    "material,colour,metres,grams,cost,currency,warnings,note\r\n";

std::string cell(std::string text) {
  std::erase(text, '\0');
  if (!text.empty() && std::string_view("=+-@\t\r\n").find(text.front()) != std::string_view::npos)
    text.insert(text.begin(), '\'');
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string moment(const std::optional<std::int64_t>& time) {
  if (!time) return {};
  const auto seconds = static_cast<std::time_t>(*time);
  std::tm utc{};
  if (gmtime_r(&seconds, &utc) == nullptr) return {};
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

std::string decimal(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : std::string();
}

std::string integer(const std::optional<std::int64_t>& value) {
  return value ? std::to_string(*value) : std::string();
}

std::string joined(const std::vector<std::string>& sentences) {
  return fmt::format("{}", fmt::join(sentences, "; "));
}

std::string row_of(const PastPrint& print, const PastFilament* filament) {
  const PastFilament none;
  const PastFilament& one = filament ? *filament : none;
  const auto amount = [filament](double value) { return filament ? std::optional(value) : std::nullopt; };
  const std::vector<std::string> cells{std::to_string(print.id),
                                       cell(print.print),
                                       cell(print.job),
                                       cell(print.file),
                                       moment(print.began),
                                       moment(print.ended_at),
                                       decimal(print.seconds, 0),
                                       decimal(print.foretold, 0),
                                       cell(print.ended),
                                       cell(print.reason),
                                       integer(print.layers_done),
                                       integer(print.layers),
                                       one.feeder > 0 ? std::to_string(one.feeder) : "",
                                       cell(one.name),
                                       cell(one.material),
                                       cell(one.colour),
                                       decimal(amount(one.amount.metres), 4),
                                       decimal(amount(one.amount.grams), 3),
                                       decimal(one.amount.cost, 4),
                                       cell(print.currency),
                                       cell(joined(print.warnings)),
                                       cell(print.note)};
  return fmt::format("{}\r\n", fmt::join(cells, ","));
}

}  // namespace

std::string csv_of(const std::vector<PastPrint>& prints) {
  std::string text(heading);
  for (const PastPrint& print : prints) {
    if (print.filaments.empty()) text += row_of(print, nullptr);
    for (const PastFilament& filament : print.filaments) text += row_of(print, &filament);
  }
  return text;
}

}  // namespace unicursal::host
