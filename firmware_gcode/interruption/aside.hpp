// What every interruption of a print needs: a place beside the part, and lines that lead there and back,
// squeeze out plastic and draw filament back. Unlike MoveWriter it starts from any state between two lines of
// a print (modal_state.hpp). mm, mm/s, mm³, °C.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/interruption/modal_state.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::gcode {

/// The corner of the bed that is farthest from the part; nullopt if it is too near to squeeze plastic out
/// there.
std::optional<core::Vec2> place_beside(const Printer& printer, const core::Box& extent);

/// The height at which the nozzle, which is at `height`, moves aside: above everything that the print has
/// laid, since higher parts may stand beside the one that is being printed; less high near the top of the
/// printer.
double height_aside(const Printer& printer, double height, const ModalState& state);

class AsideWriter {
 public:
  /// `state` is the state that the print's next line expects. Printer and state must outlive this object.
  /// `drawn`: the present retraction of the filament, mm.
  AsideWriter(const Printer& printer, const ModalState& state, double drawn);

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    chunk_.lines.push_back(fmt::format(text, std::forward<Arguments>(arguments)...));
  }
  void lines(const std::vector<std::string>& more);

  /// Chooses the extruder that mixes, for which most firmwares need no line.
  void choose_extruder();
  /// Selects the mixture that the print's next line expects.
  void select_mixture();
  /// Sets the heaters to the print's targets and waits for them.
  void heat();
  void travel(const core::Vec2& to);
  void height(double z);
  /// Completes the retraction in equal shares.
  void draw_back();
  /// Undoes the retraction and squeezes `volume` of plastic out with the tool in use. Precondition: the
  /// nozzle is at a place where the plastic may lie.
  void squeeze(double volume, double flow);
  /// Returns to the place in the print, lowers the nozzle, and restores the state that the next line expects.
  void approach();

  Chunk take() { return std::move(chunk_); }
  Chunk& chunk() { return chunk_; }

 private:
  void draw(double length);
  void filament(double length, double speed);
  double filament_area() const;

  const Printer& printer_;
  const ModalState& state_;
  std::optional<std::string> equal_shares_;  ///< the line that selects them
  double drawn_;                             ///< present retraction, mm of filament
  Chunk chunk_;
};

}  // namespace unicursal::gcode
