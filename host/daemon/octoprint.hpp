// The daemon's state in the words of OctoPrint's API, so that slicers, Home Assistant, phone apps and
// managers of many printers find what they look for. The names of fields are those of OctoPrint before
// version 2 (its documentation, docs/api, which 2.0 still serves to whoever asks for no version):
// version.rst, server.rst, authentication.rst, settings.rst, printerprofiles.rst, connection.rst, job.rst,
// printer.rst, files.rst and datamodel.rst. Departures:
//
// - What is not known is null or absent, never 0.
// - The file that is "selected" is the job that waits first.
// - The printer is "Operational" when its port is there: the daemon opens it for a print only.
// - Files have no folders, no history and no analysis.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/print/printer.hpp"
#include "host/daemon/access.hpp"
#include "host/daemon/job_files.hpp"
#include "host/daemon/queue.hpp"
#include "host/http/http_message.hpp"

namespace unicursal::host::octo {

/// Which OctoPrint's API this is; clients compare it.
inline constexpr const char* spoken_version = "1.11.0";
/// The only profile of the printer.
inline constexpr const char* profile_id = "_default";

/// "http://HOST" as the client calls this computer.
std::string address(const RequestHead& head);

/// `status`: as Daemon::status(); `there`: the printer's port is.
std::string state_text(const nlohmann::json& status, bool there);

nlohmann::json version();
nlohmann::json server();
nlohmann::json user(const Visitor& visitor);
/// `identity`: a UUID, by which Home Assistant knows the printer again.
nlohmann::json settings(const std::string& printer_name, const std::string& identity);
/// Null: no profile is known.
nlohmann::json profiles(const gcode::Printer* printer, const std::string& address);
/// `printer`: as Daemon::printer().
nlohmann::json connection(const nlohmann::json& status, const nlohmann::json& printer, bool there);
/// `next`: the job that waits first, or null.
nlohmann::json job(const nlohmann::json& status, const QueuedJob* next, bool there);
nlohmann::json printer(const nlohmann::json& status, bool there);
/// The heater "tool0" or "bed" alone; empty while it is not known.
nlohmann::json heaters(const nlohmann::json& status, const char* which);
/// A target, °C. Throws HttpError 400.
/// A number of mm. Throws HttpError 400.
double millimetres(const nlohmann::json& body, const char* key);
/// How far a "jog" moves from where the nozzle is. Throws HttpError 400, or 409 if that is unknown and asked
/// for.
std::array<double, 3> jog(const nlohmann::json& body, const std::optional<std::array<double, 3>>& at);
double temperature(const nlohmann::json& target);
/// A factor of speed or flow: a whole number is per cent, another one a fraction (docs/api/printer.rst).
/// Throws HttpError 400.
double percent(const nlohmann::json& factor);
nlohmann::json file(const LocalFile& file, const std::string& address);
nlohmann::json files(const std::vector<LocalFile>& files, std::uint64_t free, const std::string& address);

}  // namespace unicursal::host::octo
