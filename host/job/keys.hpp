// The keys of jobs and profiles, table by table. The loaders refuse all others; a test holds these lists
// against the man pages unicursal-job(5) and unicursal-profile(5).
#pragma once

#include <string>
#include <vector>

namespace unicursal::host::keys {

using Keys = std::vector<std::string>;

inline const Keys job = {"printer", "part", "zone", "mixture"};
inline const Keys part = {"file",         "copies",
                          "gap",          "order",
                          "units",        "scale",
                          "mirror",       "lie_on",
                          "rotate",       "width",
                          "height",       "outline",
                          "layer_height", "first_layer_height",
                          "bead_width",   "seed_distance",
                          "paint_depth",  "flow",
                          "speed",        "first_layer_speed",
                          "perimeters",   "allow_bare",
                          "deposit",      "place",
                          "seam",         "change_before_border",
                          "skirt",        "fan",
                          "temperatures", "tower",
                          "stops"};
/// Of a slicer's G-code, which has decided about everything else.
inline const Keys sliced_part = {"file", "tower", "stops"};
/// Of the parts behind the first one; all other keys are those of the whole print.
inline const Keys more_part = {"file",  "units",  "scale",   "mirror",      "lie_on", "rotate",
                               "width", "height", "outline", "paint_depth", "copies"};
inline const Keys deposit = {"width"};
inline const Keys skirt = {"loops", "distance"};
inline const Keys fan = {"percent", "from"};
inline const Keys temperatures = {"layer", "nozzle", "bed"};
inline const Keys zone = {"select", "pattern", "boundary", "mixture", "transition"};
inline const Keys pattern = {"angle", "field"};
inline const Keys gradient = {"from", "to", "along", "over"};

inline const Keys profile = {"printer",     "extruder",   "filament", "colours",
                             "temperature", "transition", "gcode"};
inline const Keys printer = {"name",
                             "firmware",
                             "port",
                             "baud",
                             "receive_buffer",
                             "display",
                             "bed",
                             "overtravel",
                             "nozzle",
                             "bead_width_range",
                             "max_speed",
                             "max_acceleration",
                             "jerk",
                             "junction_deviation",
                             "acceleration",
                             "clearance_radius",
                             "clearance_height"};
inline const Keys extruder = {
    "feeders",          "filament_diameter", "max_flow", "floor_share",  "retraction_length",
    "retraction_speed", "filaments",         "z_hop",    "steps_per_mm", "flow_factors",
    "max_speed",        "max_acceleration",  "jerk",     "tube_length",  "purge_inlets"};
inline const Keys filament = {"name",  "colour",   "material",    "diameter", "density",
                              "price", "currency", "see_through", "strength"};
inline const Keys colours = {"lift", "losses"};
inline const Keys temperature = {"nozzle", "bed", "hottest_nozzle", "hottest_bed"};
inline const Keys transition = {"dead_volume", "mixing_volume", "tanks", "overshoot"};
inline const Keys gcode = {"start", "end"};

}  // namespace unicursal::host::keys
