// Measures what becomes of a slicer's file on a mixing nozzle: how much of the plastic that is seen (outer
// walls, top) comes out in the wrong mixture.
//   bench_sliced [--tanks N] [--tower] FILE.gcode ...
//
// Every file is printed on the simulated printer with three chambers, and with the tool changes where the
// slicer has put them, switched ahead, and switched ahead and hidden. Tool n gets feeder n. The chamber of
// the simulated printer has N tanks (2 by default; the plan takes 2). A reader of its own, which knows no
// more than G0, G1, G92, M82, M83, T and the comments of types, reads the file for the comparison. --tower:
// the wipe tower is left out.
#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/remix/remix.hpp"
#include "sim/firmware/repetier.hpp"
#include "sim/motion/move_sinks.hpp"
#include "sim/nozzle/nozzle.hpp"

namespace {

using namespace unicursal;

struct Stroke {
  double x0, y0, x1, y1, z, e;
  int tool;
  bool seen, part;
};

/// A second opinion on the file.
std::vector<Stroke> strokes_in(const std::string& file, bool without_tower) {
  std::ifstream stream(file);
  std::vector<Stroke> strokes;
  std::string line, type = "none";
  double x = 0, y = 0, z = 0, e = 0;
  bool relative = false;
  int tool = 0;
  while (std::getline(stream, line)) {
    if (line.starts_with(";TYPE:")) type = line.substr(6);
    std::istringstream words(line.substr(0, line.find(';')));
    std::string code, word;
    words >> code;
    if (code == "M82") relative = false;
    if (code == "M83") relative = true;
    if (code.size() > 1 && code[0] == 'T') tool = std::atoi(code.c_str() + 1);
    if (code != "G0" && code != "G1" && code != "G92") continue;
    double to_x = x, to_y = y, to_e = relative ? 0 : e;
    while (words >> word) {
      const double value = std::strtod(word.c_str() + 1, nullptr);
      if (word[0] == 'X') to_x = value;
      if (word[0] == 'Y') to_y = value;
      if (word[0] == 'Z') z = value;
      if (word[0] == 'E') to_e = value;
    }
    const double fed = relative ? to_e : to_e - e;
    if (code != "G92" && fed > 0 && (to_x != x || to_y != y)) {
      const bool wall = type == "External perimeter" || type == "Overhang perimeter" || type == "WALL-OUTER";
      const bool top = type == "Top solid infill" || type == "Ironing" || type == "SKIN";
      const bool part = type != "Custom" && type != "Wipe tower" && type != "Skirt/Brim" && type != "SKIRT" &&
                        type != "none" && type != "PRIME-TOWER";
      if (!without_tower || type != "Wipe tower")
        strokes.push_back({x, y, to_x, to_y, z, fed, tool, wall || top, part});
    }
    x = to_x, y = to_y;
    if (!relative || code == "G92") e = to_e;
  }
  return strokes;
}

/// Compares the beads with the strokes, by the volume that was laid before.
class Comparison : public sim::BedSink {
 public:
  Comparison(const std::vector<Stroke>& strokes, std::vector<gcode::Mixture> mixtures, double area)
      : strokes_(strokes), mixtures_(std::move(mixtures)), area_(area) {}

  void laid(const sim::Bead& bead) override {
    const double middle = total + bead.volume / 2;
    total += bead.volume;
    while (at_ < strokes_.size() && end_ < middle) end_ += strokes_[at_++].e * area_;
    if (at_ == 0) return;
    const Stroke& stroke = strokes_[at_ - 1];
    const double x = (bead.from.x + bead.to.x) / 2, y = (bead.from.y + bead.to.y) / 2;
    if (!holds(stroke, x, y, bead.to.z)) lost += bead.volume;
    if (stroke.part) part += bead.volume;
    if (!stroke.seen) return;
    gcode::Shares arrived = gcode::Shares::zeros(3);
    for (std::size_t f = 0; f < 3; ++f) arrived[f] = bead.shares[f];
    const auto& want = mixtures_.at(static_cast<std::size_t>(stroke.tool));
    seen += bead.volume;
    misplaced += gcode::misplaced(arrived, want.shares()) * bead.volume;
    const double own = gcode::squared_distance(arrived, want.shares());
    for (const gcode::Mixture& rival : mixtures_) {
      if (gcode::squared_distance(arrived, rival.shares()) >= own) continue;
      wrong += bead.volume;
      break;
    }
  }
  void travelled(const sim::Position&, const sim::Position&) override {}

  double seen = 0, misplaced = 0, wrong = 0, lost = 0, part = 0, total = 0;  ///< mm³

 private:
  static bool holds(const Stroke& s, double x, double y, double z) {
    if (std::abs(s.z - z) > 1e-3) return false;
    const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, length = dx * dx + dy * dy;
    const double t = length > 0 ? std::clamp(((x - s.x0) * dx + (y - s.y0) * dy) / length, 0.0, 1.0) : 0;
    return std::hypot(x - s.x0 - t * dx, y - s.y0 - t * dy) < 0.01;
  }

  const std::vector<Stroke>& strokes_;
  std::vector<gcode::Mixture> mixtures_;
  double area_;
  std::size_t at_ = 0;
  double end_ = 0;  ///< mm³, of the strokes before
};

void send(sim::Firmware& firmware, const gcode::Chunk& chunk) {
  for (const std::string& line : chunk.lines) {
    if (!gcode::is_command(line)) continue;
    firmware.receive(line + "\n");
    while (firmware.blocked()) firmware.advance(*firmware.next_event());
  }
}

struct Way {
  const char* name;
  bool look_ahead, hide;
};

void measure(const std::string& file, std::size_t tanks, bool without_tower) {
  const std::vector<Stroke> strokes = strokes_in(file, without_tower);
  for (const auto& [dead, mixing] : {std::pair(2.1, 4.0), std::pair(6.0, 12.0), std::pair(10.0, 25.0)}) {
    gcode::Printer printer;
    printer.max_flow = 20;
    printer.dead_volume = dead;
    printer.mixing_volume = mixing;
    std::ifstream survey_stream(file, std::ios::binary);
    const gcode::SlicedSurvey survey = gcode::survey_sliced(survey_stream, file, printer, {});
    if (dead == 2.1) {
      fmt::print("\n{}: {}, {} layers, {} changes, {:.0f} mm³ ({:.0f} in a tower), {:.0f} s\n", file,
                 survey.slicer, survey.layers, survey.changes, survey.volume, survey.tower_volume,
                 survey.seconds);
      for (const std::string& note : survey.notes) fmt::print("  note: {}\n", note);
    }
    for (const Way& way : {Way{"where the slicer has it", false, false}, Way{"ahead", true, false},
                           Way{"ahead, and hidden", true, true}}) {
      gcode::RemixSettings settings;
      for (const gcode::SlicedTool& tool : survey.tools) {
        gcode::Shares shares = gcode::Shares::zeros(3);
        shares[static_cast<std::size_t>(tool.number) % 3] = 1;
        settings.tools[tool.number] = settings.materials.size();
        settings.materials.push_back({fmt::format("T{}", tool.number), gcode::Mixture(shares)});
      }
      settings.look_ahead = way.look_ahead;
      settings.hide = way.hide;
      settings.leave_out_tower = without_tower;
      std::ifstream stream(file, std::ios::binary);
      gcode::Remix remix(stream, file, printer, survey, settings);
      std::vector<gcode::Mixture> mixtures(3, gcode::Mixture({1, 1, 1}));
      for (const auto& [number, material] : settings.tools)
        mixtures.at(static_cast<std::size_t>(number)) = remix.intended(material);
      const double area = std::acos(-1) / 4 * printer.filament_diameter * printer.filament_diameter;
      Comparison comparison(strokes, mixtures, area);
      sim::Nozzle nozzle(printer.filament_diameter, sim::Chamber({dead, mixing, tanks}, 3), comparison);
      sim::MoveSinks sinks({&nozzle});
      sim::Machine machine;
      machine.bed = printer.bed;
      std::size_t errors = 0;
      const auto firmware =
          sim::make_firmware(machine, sim::personality("marlin"), sinks, [&](std::string_view said) {
            if (said.find("rror") == std::string_view::npos && said.find("nknown") == std::string_view::npos)
              return;
            if (errors++ < 3) fmt::print("  printer: {}\n", said);
          });
      const double begin = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
      std::vector<gcode::Chunk> chunks{remix.start()};
      while (auto chunk = remix.next()) chunks.push_back(std::move(*chunk));
      chunks.push_back(remix.finish(false));
      const double seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC - begin;
      double printing = 0, volume = 0;
      for (const gcode::Chunk& chunk : chunks)
        send(*firmware, chunk), printing += chunk.seconds, volume += chunk.volume;
      firmware->run_down();
      const gcode::SeenMixing foretold = remix.seen();
      fmt::print(
          "  {:4g} + {:2g} mm³  {:24} misplaced {:6.3f} %, wrong {:6.3f} % of {:.0f} mm³ seen (foretold "
          "{:.3f} %); {:.1f} s "
          "of work, prints {:.0f} s, {:.0f} mm³, left out {:.0f} mm³, not found {:.1f} mm³\n",
          dead, mixing, way.name, 100 * comparison.misplaced / comparison.seen,
          100 * comparison.wrong / comparison.seen, comparison.seen,
          100 * foretold.misplaced / foretold.volume, seconds, printing, volume, remix.left_out(),
          comparison.lost);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t tanks = 2;
  bool without_tower = false;
  try {
    for (int i = 1; i < argc; ++i) {
      if (std::strcmp(argv[i], "--tanks") == 0 && i + 1 < argc)
        tanks = std::strtoull(argv[++i], nullptr, 10);
      else if (std::strcmp(argv[i], "--tower") == 0)
        without_tower = true;
      else
        measure(argv[i], tanks, without_tower);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_sliced: {}\n", error.what());
    return 2;
  }
  return 0;
}
