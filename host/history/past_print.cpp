#include "host/history/past_print.hpp"

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

namespace unicursal::host {
namespace {

using nlohmann::json;

template <class Value>
void put_known(json& to, const char* key, const std::optional<Value>& value) {
  if (value) to[key] = *value;
}

template <class Value>
std::optional<Value> known_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? std::nullopt : std::optional(found->get<Value>());
}

json filament_json_of(const PastFilament& filament) {
  json one = to_json(filament.amount);
  if (filament.feeder > 0) one["feeder"] = filament.feeder;
  one["name"] = filament.name;
  one["material"] = filament.material;
  one["colour"] = filament.colour;
  return one;
}

PastFilament filament_in_json(const json& one) {
  PastFilament filament{
      one.value("feeder", std::int64_t{0}), one.at("name"), one.at("material"), one.at("colour"), {}};
  filament.amount.metres = one.at("metres");
  filament.amount.grams = one.at("grams");
  filament.amount.cost = known_in<double>(one, "cost");
  return filament;
}

}  // namespace

json to_json(const PastPrint& print) {
  json filaments = json::array();
  for (const PastFilament& filament : print.filaments) filaments.push_back(filament_json_of(filament));
  json object = {{"id", print.id},
                 {"print", print.print},
                 {"job", print.job},
                 {"ended", print.ended},
                 {"currency", print.currency},
                 {"filaments", filaments},
                 {"warnings", print.warnings},
                 {"note", print.note},
                 {"picture", print.picture}};
  if (!print.reason.empty()) object["reason"] = print.reason;
  put_known(object, "began", print.began);
  put_known(object, "ended_at", print.ended_at);
  put_known(object, "seconds", print.seconds);
  put_known(object, "foretold_seconds", print.foretold);
  put_known(object, "layers_done", print.layers_done);
  put_known(object, "layers", print.layers);
  return object;
}

json to_json(const PastTotals& totals) {
  json filaments = json::array();
  for (const SpentFilament& one : totals.filaments) {
    json object = filament_json_of(one.filament);
    object["currency"] = one.currency;
    object["prints"] = one.prints;
    filaments.push_back(std::move(object));
  }
  json object = {{"prints", totals.prints}, {"seconds", totals.seconds}, {"filaments", filaments}};
  const auto same = [&](const SpentFilament& one) {
    return one.currency == totals.filaments.front().currency;
  };
  if (!totals.filaments.empty() && std::all_of(totals.filaments.begin(), totals.filaments.end(), same))
    object["currency"] = totals.filaments.front().currency;
  return object;
}

std::string waiting_line(const PastPrint& print, bool goes_on) {
  json object = to_json(print);
  object["file"] = print.file;
  object["goes_on"] = goes_on;
  if (print.range) object["range"] = {print.range->first, print.range->last};
  return object.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

WaitingPrint print_in_line(const std::string& line) {
  const json object = json::parse(line);
  WaitingPrint waiting;
  PastPrint& print = waiting.print;
  print.print = object.at("print");
  print.ended = object.at("ended");
  print.currency = object.at("currency");
  for (const json& one : object.at("filaments")) print.filaments.push_back(filament_in_json(one));
  // Older versions kept nothing else. They wrote a print that was resumed again, and whole.
  print.job = object.value("job", print.print.size() > 18 ? print.print.substr(18) : print.print);
  print.file = object.value("file", "");
  print.reason = object.value("reason", "");
  print.note = object.value("note", "");
  print.warnings = object.value("warnings", std::vector<std::string>());
  print.began = known_in<std::int64_t>(object, "began");
  print.ended_at = known_in<std::int64_t>(object, "ended_at");
  print.seconds = known_in<double>(object, "seconds");
  print.foretold = known_in<double>(object, "foretold_seconds");
  print.layers_done = known_in<std::int64_t>(object, "layers_done");
  print.layers = known_in<std::int64_t>(object, "layers");
  if (const auto range = object.find("range"); range != object.end())
    print.range = LayerRange{range->at(0).get<std::size_t>(), range->at(1).get<std::size_t>()};
  if (!print.began) print.began = time_in_name(print.print);
  waiting.goes_on = object.value("goes_on", true);
  return waiting;
}

std::optional<std::int64_t> time_in_name(const std::string& print) {
  std::tm utc{};
  const char* const end = strptime(print.c_str(), "%Y-%m-%d-%H%M%S", &utc);
  if (end == nullptr || (*end != '-' && *end != 0)) return std::nullopt;
  return timegm(&utc);
}

}  // namespace unicursal::host
