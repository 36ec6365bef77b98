// What the page's users have chosen for this printer, in the state folder's `preferences.json`: its name, the
// language, sets of temperatures to preheat with, and the address of a camera. The page shows these texts as
// text.
#pragma once

#include <asio/awaitable.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host/daemon/keys.hpp"

namespace asio {
class thread_pool;
}

namespace unicursal::host {

struct Preset {
  std::string name;
  double nozzle_c = 0, bed_c = 0;  ///< °C
};

struct PreferenceValues {
  std::string name;      ///< of the printer; empty: its profile's
  std::string language;  ///< "de", "pt-BR"; empty: the browser's
  std::string camera;    ///< "http://…"; empty: none. May hold a secret behind its question mark
  std::vector<Preset> presets;
};

class Preferences {
 public:
  static constexpr std::size_t most_presets = 16;

  /// Reads the file if there is one. Throws DaemonError.
  explicit Preferences(std::filesystem::path file);
  ~Preferences();
  Preferences(const Preferences&) = delete;
  Preferences& operator=(const Preferences&) = delete;

  const PreferenceValues& values() const { return values_; }
  /// As the API has them. Only who has the right to set the camera's address sees what follows its question
  /// mark.
  nlohmann::json shown_to(Right right) const;
  /// Changes what `body` holds, and returns when it is on the disk. Throws HttpError 400, 403 if the right
  /// does not suffice, or 422; and Refused without room.
  asio::awaitable<void> change(nlohmann::json body, Right right);

 private:
  const std::filesystem::path file_;
  PreferenceValues values_;
  std::uint64_t changes_ = 0;
  const std::unique_ptr<asio::thread_pool> disk_;  ///< one thread, so that the last change is written last
};

}  // namespace unicursal::host
