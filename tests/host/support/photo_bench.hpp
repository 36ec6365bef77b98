// Strips of nozzles with hidden volumes, printed by the real program on its simulated printer, photographed,
// and read from the photo by the real program. mm³.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "tests/camera/camera.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/hidden_nozzles.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::test {

inline std::string diamond_profile(double dead, double mixing) {
  return fmt::format(
      "[printer]\nname = \"Diamond\"\nbed = [200.0, 200.0, 200.0]\nnozzle = 0.6\nbead_width_range = [0.36, "
      "1.6]\n"
      "[transition]\ndead_volume = {}\nmixing_volume = {}\n",
      dead, mixing);
}

/// What the profile of a user says before the nozzle is measured.
inline std::string unmeasured_profile() {
  return diamond_profile(2.1, 4);
}

/// The strip as the nozzle has printed it.
inline camera::PrintedLayer printed_strip(const HiddenNozzle& nozzle) {
  const TempFolder folder;
  const std::string profile = folder.write("profile.toml", unmeasured_profile());
  const std::string machine = folder.write("machine.toml", diamond_profile(nozzle.dead, nozzle.mixing));
  const std::string rasters = folder / "rasters";
  // The readings are of no interest; with them the program does not ask. The profile is a copy.
  const Outcome outcome =
      run({"tune", "transition", profile, "--simulate", "--machine", machine, "--tanks",
           std::to_string(nozzle.tanks), "--rasters", rasters, "--began", "31", "--stopped", "73", "--yes"});
  if (outcome.code != 0) throw std::runtime_error("the strip was not printed: " + outcome.err);
  return camera::read_layer(rasters);
}

struct FoundVolume {
  double value = 0, uncertainty = 0;
};

struct PhotoReading {
  Outcome outcome;
  std::optional<FoundVolume> dead, mixing, tanks;  ///< as the program's output gives them
  bool untouched = true;                           ///< the profile

  bool refused() const { return outcome.code != 0; }
  /// The greater of both errors as a share of dead + mixing volume. Precondition: both were found.
  double error(const HiddenNozzle& nozzle) const {
    const double worse =
        std::max(std::abs(dead->value - nozzle.dead), std::abs(mixing->value - nozzle.mixing));
    return worse / (nozzle.dead + nozzle.mixing);
  }
  /// The number of tanks lies in its uncertainty.
  bool tanks_fit(const HiddenNozzle& nozzle) const {
    return tanks && std::abs(tanks->value - static_cast<double>(nozzle.tanks)) <= tanks->uncertainty + 0.05;
  }
};

/// Reads "name:  2.13 mm³, give or take 0.05 (…)".
inline std::optional<FoundVolume> found_volume(const std::string& output, const std::string& name) {
  const std::string words = "give or take ";
  const std::size_t line = output.rfind("\n" + name + ":");
  if (line == std::string::npos) return {};
  const std::size_t uncertain = output.find(words, line);
  if (uncertain == std::string::npos) return {};
  return FoundVolume{std::strtod(&output[line + name.size() + 2], nullptr),
                     std::strtod(&output[uncertain + words.size()], nullptr)};
}

/// Lets the program measure a nozzle from a photo. `more`: further arguments.
inline PhotoReading read_photo(const std::filesystem::path& photo,
                               const std::vector<std::string>& more = {}) {
  const TempFolder folder;
  const std::string profile = folder.write("profile.toml", unmeasured_profile());
  std::vector<std::string> arguments = {"tune", "transition", profile, "--photo", photo.string(), "--yes"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  PhotoReading reading;
  reading.outcome = run(arguments);
  const std::string output = "\n" + reading.outcome.out;
  reading.dead = found_volume(output, "dead");
  reading.mixing = found_volume(output, "mixing");
  reading.tanks = found_volume(output, "tanks");
  reading.untouched = read_text(profile) == unmeasured_profile();
  return reading;
}

/// Takes the photo into `file` and reads it.
inline PhotoReading photographed(const camera::PrintedLayer& strip, const camera::FilamentPair& pair,
                                 const camera::Conditions& conditions, const std::filesystem::path& file) {
  camera::write_photo(file, camera::take_photo(strip, pair, conditions), conditions.quality,
                      conditions.orientation);
  return read_photo(file);
}

}  // namespace unicursal::test
