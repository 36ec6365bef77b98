#include "firmware_gcode/mixing/print_mixtures.hpp"

#include <utility>

#include "firmware_gcode/mixing/calibration.hpp"

namespace unicursal::gcode {

ChamberModel chamber_of(const Printer& printer) {
  return {printer.dead_volume, printer.mixing_volume, printer.tanks};
}

PrintMixtures mixtures_of(const Printer& printer, const std::vector<Material>& materials, bool look_ahead,
                          double before_border, const Dialect& dialect) {
  const Palette::Calibrate calibrate = [floor = printer.floor_share, factors = printer.flow_factors,
                                        &dialect](const Mixture& mixture) {
    return calibrated(mixture.with_floor(floor), factors, dialect);
  };
  PaletteWithOvershoots all{Palette(materials, calibrate), {}};
  if (look_ahead && printer.overshoot) {
    const std::size_t most = dialect.limits().virtual_tools - 1;  // one tool draws filament back
    all = with_overshoots(std::move(all.palette),
                          {chamber_of(printer), before_border, printer.floor_share, most});
  }
  ToolTable tools(dialect, all.palette, calibrate(Mixture::equal(printer.feeders)));
  return {std::move(all.palette), std::move(all.overshoots), std::move(tools)};
}

}  // namespace unicursal::gcode
