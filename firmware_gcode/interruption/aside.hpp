// What every interruption of a print needs: a place beside the part, and lines that lead there and back,
// squeeze out plastic and draw filament back. Unlike MoveWriter this takes the printer as it is found
// (modal_state.hpp), between any two lines of a print. mm, mm/s, mm³, °C.
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

/// The corner of the bed that is farthest from the part, if that is far enough to squeeze plastic out there.
std::optional<core::Vec2> place_beside(const Printer& printer, const core::Box& extent);

/// How far the nozzle rises before it goes aside: less where the bed's height ends.
double rise_aside(const Printer& printer, double height);

class AsideWriter {
 public:
  /// `state`: that the print's next line expects; both must outlive this object. `drawn`: mm of filament by
  /// which it is drawn back now.
  AsideWriter(const Printer& printer, const ModalState& state, double drawn);

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    chunk_.lines.push_back(fmt::format(text, std::forward<Arguments>(arguments)...));
  }
  void lines(const std::vector<std::string>& more);

  void select(std::optional<int> tool);
  /// Heaters to what the print wants, and waits for them.
  void heat();
  void travel(const core::Vec2& to);
  void height(double z);
  /// Draws back what is not drawn back yet, by the tool of equal shares.
  void draw_back();
  /// Pushes everything forward and squeezes so much plastic out in the tool in use. Precondition: the nozzle
  /// is where that may lie.
  void squeeze(double volume, double flow);
  /// To where the print goes on, down, and the state that its next line expects.
  void approach();

  Chunk take() { return std::move(chunk_); }
  Chunk& chunk() { return chunk_; }

 private:
  void draw(double length);
  void filament(double length, double speed);
  double filament_area() const;

  const Printer& printer_;
  const ModalState& state_;
  std::optional<int> equal_;  ///< the tool of equal shares
  double drawn_;              ///< mm of filament
  Chunk chunk_;
};

}  // namespace unicursal::gcode
