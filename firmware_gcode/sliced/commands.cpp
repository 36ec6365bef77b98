#include "firmware_gcode/sliced/commands.hpp"

#include <algorithm>
#include <array>

namespace unicursal::gcode {
namespace {

using Kind = CommandKind;

struct Entry {
  int code;
  CommandUse use;
};

constexpr std::string_view remove_it = "remove this line, or the slicer's setting that writes it";

constexpr auto g_codes = std::to_array<Entry>({
    {4, {Kind::pass, {}, {}}},
    {5, {Kind::refuse, "lays a spline, which this program does not read", "export without splines"}},
    {12, {Kind::homes, {}, {}}},
    {17, {Kind::mode, {}, {}}},
    {18, {Kind::refuse, "draws arcs out of the layer", "export without arcs in other planes than XY"}},
    {19, {Kind::refuse, "draws arcs out of the layer", "export without arcs in other planes than XY"}},
    {20, {Kind::mode, {}, {}}},
    {21, {Kind::mode, {}, {}}},
    {26, {Kind::refuse, "prints a test pattern", remove_it}},
    {27, {Kind::homes, {}, {}}},
    {28, {Kind::homes, {}, {}}},
    {29, {Kind::homes, {}, {}}},
    {30, {Kind::homes, {}, {}}},
    {31, {Kind::pass, {}, {}}},
    {32, {Kind::homes, {}, {}}},
    {33, {Kind::homes, {}, {}}},
    {34, {Kind::homes, {}, {}}},
    {35, {Kind::homes, {}, {}}},
    {53, {Kind::refuse, "moves in the machine's coordinates", remove_it}},
    {54, {Kind::refuse, "chooses other coordinates", remove_it}},
    {55, {Kind::refuse, "chooses other coordinates", remove_it}},
    {56, {Kind::refuse, "chooses other coordinates", remove_it}},
    {57, {Kind::refuse, "chooses other coordinates", remove_it}},
    {58, {Kind::refuse, "chooses other coordinates", remove_it}},
    {59, {Kind::refuse, "chooses other coordinates", remove_it}},
    {60, {Kind::pass, {}, {}}},
    {61, {Kind::refuse, "moves to a place that this program does not know", remove_it}},
    {76, {Kind::homes, {}, {}}},
    {80, {Kind::homes, {}, {}}},
    {90, {Kind::mode, {}, {}}},
    {91, {Kind::mode, {}, {}}},
    {92, {Kind::mode, {}, {}}},
    {161, {Kind::homes, {}, {}}},
    {162, {Kind::homes, {}, {}}},
    {425, {Kind::homes, {}, {}}},
});

constexpr std::string_view card = "reads or writes the printer's own card";
constexpr std::string_view saves = "changes what the printer keeps when it is switched off";
constexpr std::string_view loads = "loads or unloads filament by itself";
constexpr std::string_view other = "is meant for another kind of printer";

constexpr auto m_codes = std::to_array<Entry>({
    {0, {Kind::wait, {}, {}}},
    {1, {Kind::wait, {}, {}}},
    {6, {Kind::mode, {}, {}}},
    {17, {Kind::pass, {}, {}}},
    {18, {Kind::pass, {}, {}}},
    {20, {Kind::leave_out, card, {}}},
    {21, {Kind::leave_out, card, {}}},
    {22, {Kind::leave_out, card, {}}},
    {23, {Kind::refuse, card, remove_it}},
    {24, {Kind::refuse, card, remove_it}},
    {25, {Kind::wait, {}, {}}},
    {26, {Kind::refuse, card, remove_it}},
    {28, {Kind::refuse, card, remove_it}},
    {29, {Kind::refuse, card, remove_it}},
    {30, {Kind::refuse, card, remove_it}},
    {32, {Kind::refuse, card, remove_it}},
    {42, {Kind::pass, {}, {}}},
    {73, {Kind::pass, {}, {}}},
    {75, {Kind::pass, {}, {}}},
    {76, {Kind::pass, {}, {}}},
    {77, {Kind::pass, {}, {}}},
    {80, {Kind::pass, {}, {}}},
    {81, {Kind::leave_out, "switches the power off before the printer has cooled", {}}},
    {82, {Kind::mode, {}, {}}},
    {83, {Kind::mode, {}, {}}},
    {84, {Kind::pass, {}, {}}},
    {85,
     {Kind::leave_out, "changes the time after which an idle printer cools, which this program sets", {}}},
    {92, {Kind::pass, {}, {}}},
    {98, {Kind::refuse, "runs a macro whose lines this program cannot see", remove_it}},
    {99, {Kind::refuse, "runs a macro whose lines this program cannot see", remove_it}},
    {101, {Kind::leave_out, {}, {}}},
    {103, {Kind::leave_out, {}, {}}},
    {104, {Kind::heat, {}, {}}},
    {105, {Kind::leave_out, {}, {}}},
    {106, {Kind::pass, {}, {}}},
    {107, {Kind::pass, {}, {}}},
    {108, {Kind::mode, {}, {}}},
    {109, {Kind::heat, {}, {}}},
    {110, {Kind::leave_out, {}, {}}},
    {111, {Kind::pass, {}, {}}},
    {112, {Kind::refuse, "is the emergency stop", remove_it}},
    {113, {Kind::leave_out, {}, {}}},
    {114, {Kind::pass, {}, {}}},
    {115, {Kind::pass, {}, {}}},
    {116, {Kind::heat, {}, {}}},
    {117, {Kind::pass, {}, {}}},
    {118, {Kind::pass, {}, {}}},
    {119, {Kind::pass, {}, {}}},
    {125, {Kind::wait, {}, {}}},
    {140, {Kind::heat, {}, {}}},
    {141, {Kind::pass, {}, {}}},
    {145, {Kind::pass, {}, {}}},
    {150, {Kind::pass, {}, {}}},
    {155, {Kind::leave_out, {}, {}}},
    {163, {Kind::mixture, {}, {}}},
    {164, {Kind::mixture, {}, {}}},
    {165, {Kind::mixture, {}, {}}},
    {166,
     {Kind::refuse, "lets the firmware change the mixture by itself",
      "switch the gradient off, and use a gradient of a unicursal job instead"}},
    {190, {Kind::heat, {}, {}}},
    {191, {Kind::pass, {}, {}}},
    {200, {Kind::mode, {}, {}}},
    {201, {Kind::pass, {}, {}}},
    {202, {Kind::pass, {}, {}}},
    {203, {Kind::pass, {}, {}}},
    {204, {Kind::pass, {}, {}}},
    {205, {Kind::pass, {}, {}}},
    {206, {Kind::pass, {}, {}}},
    {207, {Kind::leave_out, "sets up the firmware's own retraction; the profile's is used", {}}},
    {208, {Kind::leave_out, "sets up the firmware's own retraction; the profile's is used", {}}},
    {209, {Kind::leave_out, "sets up the firmware's own retraction; the profile's is used", {}}},
    {211, {Kind::leave_out, "may switch the limits of the axes off", {}}},
    {218, {Kind::leave_out, "sets the offset of a second nozzle", {}}},
    {220, {Kind::rate, {}, {}}},
    {221, {Kind::rate, {}, {}}},
    {226, {Kind::wait, {}, {}}},
    {240, {Kind::pass, {}, {}}},
    {280, {Kind::pass, {}, {}}},
    {290, {Kind::leave_out, "lifts or lowers the nozzle", {}}},
    {300, {Kind::pass, {}, {}}},
    {302, {Kind::refuse, "allows cold extrusion", remove_it}},
    {303, {Kind::refuse, "tunes a heater, which takes many minutes", remove_it}},
    {400, {Kind::pass, {}, {}}},
    {401, {Kind::pass, {}, {}}},
    {402, {Kind::pass, {}, {}}},
    {412, {Kind::pass, {}, {}}},
    {413, {Kind::pass, {}, {}}},
    {420, {Kind::pass, {}, {}}},
    {428, {Kind::refuse, saves, remove_it}},
    {486, {Kind::pass, {}, {}}},
    {500, {Kind::refuse, saves, remove_it}},
    {501, {Kind::pass, {}, {}}},
    {502, {Kind::refuse, "sets all of the printer's settings back", remove_it}},
    {504, {Kind::refuse, saves, remove_it}},
    {524, {Kind::refuse, "ends the print", remove_it}},
    {567, {Kind::mixture, {}, {}}},
    {568, {Kind::heat, {}, {}}},
    {569, {Kind::pass, {}, {}}},
    {572, {Kind::pass, {}, {}}},
    {575, {Kind::refuse, "changes the speed of the serial line", remove_it}},
    {600, {Kind::wait, {}, {}}},
    {601, {Kind::wait, {}, {}}},
    {603, {Kind::leave_out, loads, {}}},
    {605, {Kind::leave_out, other, {}}},
    {701, {Kind::leave_out, loads, {}}},
    {702, {Kind::leave_out, loads, {}}},
    {862, {Kind::leave_out, other, {}}},
    {900, {Kind::pass, {}, {}}},
    {907, {Kind::pass, {}, {}}},
    {928, {Kind::refuse, card, remove_it}},
    {929, {Kind::refuse, card, remove_it}},
    {997, {Kind::refuse, "writes a new firmware", remove_it}},
    {999, {Kind::refuse, "restarts the printer", remove_it}},
    {1001, {Kind::pass, {}, {}}},
    {1002, {Kind::leave_out, other, {}}},
});

const CommandUse& found(const auto& table, int code) {
  static constexpr CommandUse unknown{};
  const auto at = std::lower_bound(table.begin(), table.end(), code,
                                   [](const Entry& entry, int wanted) { return entry.code < wanted; });
  return at != table.end() && at->code == code ? at->use : unknown;
}

}  // namespace

CommandUse use_of(const SlicedCommand& command) {
  if (command.letter == 'G') return found(g_codes, command.code);
  if (command.letter == 'M') return found(m_codes, command.code);
  return {};
}

}  // namespace unicursal::gcode
