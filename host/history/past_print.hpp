// What the history keeps of a print. s, m, g.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/layer_range.hpp"
#include "host/report/filament_use.hpp"

namespace unicursal::host {

struct PastFilament {
  std::int64_t feeder = 0;  ///< counted from 1; 0: not known
  std::string name, material, colour;
  FilamentAmount amount;
};

struct PastPrint {
  std::int64_t id = 0;              ///< in the history
  std::string print;                ///< of its folder: date, time and job
  std::string job;                  ///< for display
  std::string file;                 ///< a daemon's name for the job, or the path of its file; may be empty
  std::optional<LayerRange> range;  ///< as asked; absent: all layers
  std::optional<std::int64_t> began, ended_at;  ///< s since 1970
  std::optional<double> seconds;   ///< that it took, heating and pauses included, all sessions together
  std::optional<double> foretold;  ///< s, by its first forecast
  std::string ended;               ///< "completed", "stopped" or "failed"
  std::string reason;              ///< a sentence; empty: completed
  std::optional<std::int64_t> layers_done, layers;
  std::string currency;
  std::vector<PastFilament> filaments;  ///< those that were fed, by feeder
  std::vector<std::string> warnings;
  std::string note;      ///< the user's
  bool picture = false;  ///< whether there is one
};

/// A filament of all prints, with its currency: spools of one name, material and colour are one.
struct SpentFilament {
  PastFilament filament;
  std::string currency;
  std::int64_t prints = 0;
};

struct PastTotals {
  std::int64_t prints = 0;
  double seconds = 0;  ///< of those whose time is known
  std::vector<SpentFilament> filaments;
};

/// As in API.md.
nlohmann::json to_json(const PastPrint& print);
nlohmann::json to_json(const PastTotals& totals);

/// A line of the file in which prints wait for a history that cannot be written (history.hpp), and back.
/// Lines of older versions have fewer keys. Throws nlohmann::json::exception.
std::string waiting_line(const PastPrint& print, bool goes_on);
struct WaitingPrint {
  PastPrint print;
  bool goes_on = false;  ///< it is a later session of a print
};
WaitingPrint print_in_line(const std::string& line);

/// When a print began, from its folder's name; absent: not such a name.
std::optional<std::int64_t> time_in_name(const std::string& print);

}  // namespace unicursal::host
