// What a simulated printer is like, and which files it writes. mm, mm/s, mm/s², mm³, bits/s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace unicursal::sim {

struct SimulatorOptions {
  std::optional<std::filesystem::path> link;  ///< a symbolic link to make to the pseudo-terminal
  /// A Unix socket to make: the host says how far printer time goes (sim/lockstep.hpp).
  std::optional<std::filesystem::path> control;
  std::string personality = "marlin";  ///< sim/firmware/personality.hpp lists them
  double baud = 250000;                ///< bits/s; counts only where printer time is real or the host's
  std::string usb = "cdc";             ///< the chip at the cable's end: none, cdc, ftdi
  std::vector<std::string> faults;     ///< sim/faults/fault.hpp says how they are written
  std::optional<std::filesystem::path> fault_file;
  std::optional<std::uint64_t> seed;  ///< of the faults; 1 unless the file has another
  double speed = 0;                   ///< printer seconds per real second; 0: as fast as lines come
  std::optional<std::filesystem::path> transcript;  ///< every command as it is executed, one on each line
  std::optional<std::filesystem::path> report;      ///< JSON, written when the simulation ends
  std::optional<std::filesystem::path>
      pictures;         ///< folder for deposit-NNNN.png of each layer, part.png, motion.png
  double pixel = 0.05;  ///< mm per picture pixel
  std::optional<std::filesystem::path> rasters;  ///< file or pipe for the layers as laid (sim/bed/raster.hpp)
  double raster_pixel = 0.05;                    ///< mm; coarser on a bed so big that memory asks for it
  double dead_volume = 2.1;                      ///< mm³ that pass before the first trace of a new mixture
  double mixing_volume = 4.0;                    ///< mm³ from there to 95 % of it
  std::optional<std::size_t> tanks;              ///< that the chamber's melt passes, 1 to 8; 2 if not said
  std::vector<double> bed = {200, 200, 200};     ///< mm, x y z
  double filament_diameter = 1.75;               ///< mm
  std::vector<double> steps_per_mm = {80, 80, 400};          ///< x y z
  double feeder_steps_per_mm = 400;                          ///< steps of one feeder for 1 mm of its filament
  std::vector<double> max_acceleration = {1500, 1500, 100};  ///< mm/s², x y z
  std::vector<double> max_speed = {150, 150, 10};            ///< mm/s, x y z
  std::vector<double> jerk = {10, 10, 0.3};                  ///< mm/s that x, y, z may jump by
  double junction_deviation = 0;                             ///< mm; above 0 it takes the place of the jerk
  double acceleration = 3000;                                ///< mm/s² along a move that extrudes or travels
  double feeder_speed = 50, feeder_acceleration = 10000, feeder_jerk = 5;  ///< of the filament, mm and s
  std::size_t feeders = 3;
  bool once = false;  ///< end when the host closes the line after having used it
};

}  // namespace unicursal::sim
