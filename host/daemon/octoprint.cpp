#include "host/daemon/octoprint.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/job/sliced_file.hpp"

namespace unicursal::host::octo {
namespace {

using nlohmann::json;

/// Our word for the state of a print, and OctoPrint's (octoprint.printer.standard and octoprint.util.comm).
constexpr std::pair<const char*, const char*> states[] = {
    {"connecting", "Starting"}, {"heating", "Printing"},     {"printing", "Printing"},
    {"pausing", "Pausing"},     {"paused", "Paused"},        {"resuming", "Resuming"},
    {"finishing", "Finishing"}, {"cancelling", "Cancelling"}};

json number_or_null(const json& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? json() : *found;
}

json heater(const json& print, const char* which) {
  const json known = print.value(which, json::object());
  if (known.empty()) return {};
  return {{"actual", number_or_null(known, "actual_c")},
          {"target", number_or_null(known, "target_c")},
          {"offset", 0}};
}

bool is_one_of(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return text == word; });
}

json flags(const std::string& text, bool interrupted) {
  const bool operational = text != "Offline";
  const bool printing =
      is_one_of(text, {"Starting", "Printing", "Pausing", "Resuming", "Finishing", "Cancelling"});
  return {{"operational", operational},
          {"printing", printing},
          {"cancelling", text == "Cancelling"},
          {"pausing", text == "Pausing"},
          {"resuming", text == "Resuming"},
          {"finishing", text == "Finishing"},
          {"paused", text == "Paused"},
          {"ready", text == "Operational" && !interrupted},
          {"sdReady", false},
          {"error", false},
          {"closedOrError", !operational}};
}

json whole(const json& seconds) {
  return seconds.is_number() ? json(std::llround(seconds.get<double>())) : json();
}

}  // namespace

std::string address(const RequestHead& head) {
  return "http://" + head.header("host").value_or("localhost");
}

std::string state_text(const json& status, bool there) {
  const std::string state = status.value("state", "idle");
  if (state == "reconnecting") return "Offline";
  if (state == "preparing") return "Starting";
  const std::string print = status.value("print", json::object()).value("state", "");
  for (const auto& [ours, theirs] : states) {
    if (state != "idle" && print == ours) return theirs;
  }
  return there ? "Operational" : "Offline";
}

json version() {
  return {{"api", "0.1"},
          {"server", spoken_version},
          {"text", std::string("OctoPrint ") + spoken_version + " (as unicursal " + UNICURSAL_VERSION +
                       " speaks it)"}};
}

json server() {
  return {{"version", spoken_version}, {"safemode", false}};
}

json user(const Visitor& visitor) {
  json permissions = json::array({"STATUS", "CONNECTION", "FILES_LIST", "SETTINGS_READ"});
  if (visitor.right >= Right::queue) permissions.insert(permissions.end(), {"FILES_UPLOAD", "FILES_SELECT"});
  if (visitor.right >= Right::queue) permissions.insert(permissions.end(), {"FILES_DELETE"});
  if (visitor.right >= Right::steer) permissions.insert(permissions.end(), {"PRINT", "CONTROL"});
  return {{"name", visitor.name.empty() ? "owner" : visitor.name},
          {"permissions", permissions},
          {"groups", {visitor.right >= Right::steer ? "users" : "readonly"}}};
}

json settings(const std::string& printer_name, const std::string& identity) {
  return {{"api", {{"allowCrossOrigin", false}}},
          {"appearance", {{"name", printer_name}, {"color", "default"}}},
          {"feature", {{"sdSupport", false}, {"temperatureGraph", false}}},
          {"folder", json::object()},
          {"plugins",
           {{"discovery", {{"upnpUuid", identity}, {"publicHost", nullptr}, {"publicPort", nullptr}}}}},
          {"scripts", json::object()},
          {"serial", json::object()},
          {"server", json::object()},
          {"system", {{"actions", json::array()}}},
          {"temperature", {{"profiles", json::array()}}},
          {"terminalFilters", json::array()},
          {"webcam",
           {{"webcamEnabled", false},
            {"streamUrl", ""},
            {"snapshotUrl", ""},
            {"snapshotSslValidation", true},
            {"flipH", false},
            {"flipV", false},
            {"rotate90", false}}}};
}

json profiles(const gcode::Printer* printer, const std::string& address) {
  if (!printer) return {{"profiles", json::object()}};
  json axes = json::object();
  constexpr std::array names{"x", "y", "z"};
  for (std::size_t axis = 0; axis < names.size(); ++axis)
    axes[names[axis]] = {{"speed", printer->max_speed[axis] * 60}, {"inverted", false}};
  axes["e"] = {{"speed", printer->retraction_speed * 60}, {"inverted", false}};
  const json profile = {{"id", profile_id},
                        {"name", printer->name},
                        {"model", printer->name},
                        {"color", "default"},
                        {"default", true},
                        {"current", true},
                        {"resource", address + "/api/printerprofiles/" + profile_id},
                        {"volume",
                         {{"formFactor", "rectangular"},
                          {"origin", "lowerleft"},
                          {"width", printer->bed[0]},
                          {"depth", printer->bed[1]},
                          {"height", printer->bed[2]},
                          {"custom_box", false}}},
                        {"heatedBed", true},
                        {"heatedChamber", false},
                        {"axes", axes},
                        // One nozzle, however many feeders: OctoPrint counts tools that are heated.
                        {"extruder",
                         {{"count", 1},
                          {"nozzleDiameter", printer->nozzle},
                          {"sharedNozzle", false},
                          {"offsets", {{0.0, 0.0}}}}}};
  return {{"profiles", {{profile_id, profile}}}};
}

json connection(const json& status, const json& printer, bool there) {
  const json port = number_or_null(printer, "port"), baud = number_or_null(printer, "baud");
  const json ports = port.is_null() ? json::array() : json::array({port});
  const json bauds = baud.is_null() ? json::array() : json::array({baud});
  const std::string name = printer.value("name", "");
  const std::string state = state_text(status, there);
  const bool open = state != "Offline";
  return {{"current",
           {{"state", state == "Offline" ? "Closed" : state},
            {"port", open ? port : json()},
            {"baudrate", open ? baud : json()},
            {"printerProfile", profile_id}}},
          {"options",
           {{"ports", ports},
            {"baudrates", bauds},
            {"printerProfiles", {{{"id", profile_id}, {"name", name}}}},
            {"portPreference", port},
            {"baudratePreference", baud},
            {"printerProfilePreference", profile_id},
            {"autoconnect", true}}}};
}

json job(const json& status, const QueuedJob* next, bool there) {
  const std::string state = state_text(status, there);
  const bool busy = status.value("state", "idle") != "idle";
  const json print = busy ? status.value("print", json::object()) : json::object();
  std::string name;
  if (busy) name = status.value("job", json::object()).value("job", "");
  if (!busy && next) name = next->name;
  json file = {{"name", nullptr},   {"path", nullptr}, {"display", nullptr},
               {"origin", nullptr}, {"size", nullptr}, {"date", nullptr}};
  if (!name.empty()) {
    const std::string shown = local_name(name).value_or(name);
    file["name"] = file["path"] = file["display"] = shown;
    file["origin"] = "local";
  }
  const json elapsed = number_or_null(print, "elapsed_seconds"), left = number_or_null(print, "left_seconds");
  json expected;
  if (elapsed.is_number() && left.is_number())
    expected = std::llround(elapsed.get<double>() + left.get<double>());
  return {{"job",
           {{"file", file},
            {"estimatedPrintTime", expected},
            {"averagePrintTime", nullptr},
            {"lastPrintTime", nullptr},
            {"filament", nullptr},
            {"user", nullptr}}},
          {"progress",
           {{"completion", number_or_null(print, "percent")},
            {"filepos", nullptr},
            {"printTime", whole(elapsed)},
            {"printTimeLeft", whole(left)},
            {"printTimeLeftOrigin", left.is_number() ? json("estimate") : json()}}},
          {"state", state}};
}

namespace {

json temperatures(const json& status) {
  const bool busy = status.value("state", "idle") != "idle";
  const json print = status.value(busy ? "print" : "idle", json::object());
  json temperature = json::object();
  if (json nozzle = heater(print, "nozzle"); !nozzle.is_null()) temperature["tool0"] = std::move(nozzle);
  if (json bed = heater(print, "bed"); !bed.is_null()) temperature["bed"] = std::move(bed);
  return temperature;
}

}  // namespace

json heaters(const json& status, const char* which) {
  json all = temperatures(status);
  if (!all.contains(which)) return json::object();
  return {{which, std::move(all[which])}};
}

double temperature(const json& target) {
  if (!target.is_number()) throw HttpError(400, "the target is missing: a number of degrees Celsius");
  return target.get<double>();
}

double millimetres(const json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || !found->is_number())
    throw HttpError(400, std::string(key) + " is missing: a number of mm");
  return found->get<double>();
}

std::array<double, 3> jog(const json& body, const std::optional<std::array<double, 3>>& at) {
  const bool absolute = body.contains("absolute") && body["absolute"].is_boolean() && body["absolute"];
  if (absolute && !at) throw HttpError(409, "nobody knows where the nozzle is; home it first");
  std::array<double, 3> by{};
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    if (!body.contains(axes[axis])) continue;
    by[axis] = millimetres(body, axes[axis]) - (absolute ? (*at)[axis] : 0);
  }
  return by;
}

double percent(const json& factor) {
  if (!factor.is_number())
    throw HttpError(400, "factor is missing: per cent as a whole number, or a fraction such as 0.95");
  return factor.is_number_float() ? factor.get<double>() * 100 : factor.get<double>();
}

json printer(const json& status, bool there) {
  const std::string text = state_text(status, there);
  return {{"state", {{"text", text}, {"flags", flags(text, status.contains("interrupted"))}}},
          {"temperature", temperatures(status)},
          {"sd", {{"ready", false}}}};
}

json file(const LocalFile& file, const std::string& address) {
  const bool is_gcode = is_sliced_file(file.name);
  const std::size_t slash = file.name.rfind('/');
  return {{"name", slash == std::string::npos ? file.name : file.name.substr(slash + 1)},
          {"display", file.name},
          {"path", file.name},
          {"type", is_gcode ? "machinecode" : "model"},
          {"typePath", is_gcode ? json({"machinecode", "gcode"}) : json({"model"})},
          {"origin", "local"},
          {"size", file.size},
          {"date", file.date},
          {"refs", {{"resource", address + "/api/files/local/" + file.name}}}};
}

json files(const std::vector<LocalFile>& files, std::uint64_t free, const std::string& address) {
  json all = json::array();
  for (const LocalFile& one : files) all.push_back(file(one, address));
  return {{"files", all}, {"free", free}};
}

}  // namespace unicursal::host::octo
