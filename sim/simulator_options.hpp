// The properties of a simulated printer and the files that it writes. mm, mm/s, mm/s², mm³, bits/s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/picture/image.hpp"

namespace unicursal::sim {

struct SimulatorOptions {
  /// Symbolic link to make to the pseudo-terminal.
  std::optional<std::filesystem::path> link;
  /// Unix socket to make, through which the host controls printer time (sim/lockstep.hpp).
  std::optional<std::filesystem::path> control;
  std::string personality = "marlin";  ///< Firmware, see sim/firmware/personality.hpp.
  double baud = 250000;                ///< Line speed, bits/s; without effect if time leaps.
  std::string usb = "cdc";             ///< Chip in the cable: none, cdc or ftdi.
  std::vector<std::string> faults;     ///< Faults in the syntax of sim/faults/fault.hpp.
  std::optional<std::filesystem::path> fault_file;
  std::optional<std::uint64_t> seed;  ///< Seed of the faults; nullopt = the file's, or 1.
  double speed = 0;                   ///< Printer seconds per real second; 0 = as fast as lines arrive.
  /// File for every executed command, one on each line.
  std::optional<std::filesystem::path> transcript;
  /// File for every bead that is laid (sim/bed/bead_log.hpp).
  std::optional<std::filesystem::path> beads;
  std::optional<std::filesystem::path> report;  ///< JSON file, written when the simulation ends.
  /// Folder for deposit-NNNN.png of each layer, part.png and motion.png.
  std::optional<std::filesystem::path> pictures;
  double pixel = 0.05;  ///< Picture pixel, mm.
  /// File or pipe for the layers as deposited (sim/bed/raster.hpp).
  std::optional<std::filesystem::path> rasters;
  double raster_pixel = 0.05;        ///< Raster pixel, mm; coarser on a large bed, to save memory.
  double dead_volume = 2.1;          ///< Volume before the first trace of a new mixture, mm³.
  double mixing_volume = 4.0;        ///< Volume from the first trace to 95 %, mm³.
  std::optional<std::size_t> tanks;  ///< Stirred tanks in series in the chamber, 1 to 8; nullopt = 2.
  std::vector<double> bed = {200, 200, 200};                 ///< Bed size, x y z, mm.
  std::vector<double> overtravel = {0, 0};                   ///< Beyond its left and front edge, x y, mm.
  double filament_diameter = 1.75;                           ///< Filament diameter, mm.
  std::vector<double> steps_per_mm = {80, 80, 400};          ///< Steps per mm, x y z.
  double feeder_steps_per_mm = 400;                          ///< Steps per mm of one feeder's filament.
  std::vector<double> max_acceleration = {1500, 1500, 100};  ///< Limit of each axis, x y z, mm/s².
  std::vector<double> max_speed = {150, 150, 10};            ///< Limit of each axis, x y z, mm/s.
  std::vector<double> jerk = {10, 10, 0.3};                  ///< Classic jerk, x y z, mm/s.
  double junction_deviation = 0;                             ///< mm; if above 0, it replaces the jerk.
  double acceleration = 3000;                                ///< Along printing moves and travels, mm/s².
  double feeder_speed = 50;                                  ///< Limits of E: mm/s,
  double feeder_acceleration = 10000;                        ///< mm/s²,
  double feeder_jerk = 5;                                    ///< mm/s.
  std::size_t feeders = 3;
  std::vector<picture::Colour> filaments = {};  ///< Of the first feeders, in pictures; else the usual ones.
  /// How far the head reaches around the nozzle, and the height above its tip at which everything else
  /// begins, mm; nullopt: only the tip can strike what was laid.
  std::optional<std::pair<double, double>> clearance;
  bool once = false;  ///< Whether to end when the host has used the line and closed it.
};

}  // namespace unicursal::sim
