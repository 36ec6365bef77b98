#include "firmware_gcode/sliced/comments.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/text/printable.hpp"
#include "firmware_gcode/sliced/words.hpp"

namespace unicursal::gcode {
namespace {

constexpr std::size_t most_tools = 256;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

/// Removes the prefix if it is there.
bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

/// Words and the features that they mean; the first that the name holds counts. All in lower case.
constexpr std::array<std::pair<std::string_view, Feature>, 44> features{{
    {"wipe tower", Feature::tower},
    {"prime tower", Feature::tower},
    {"prime-tower", Feature::tower},
    {"prime pillar", Feature::tower},
    {"flush", Feature::tower},
    {"support", Feature::support},
    {"raft", Feature::aside},
    {"skirt", Feature::aside},
    {"brim", Feature::aside},
    {"ooze shield", Feature::aside},
    {"draft shield", Feature::aside},
    {"crown", Feature::outer_wall},
    {"external perimeter", Feature::outer_wall},
    {"overhang perimeter", Feature::outer_wall},
    {"overhang wall", Feature::outer_wall},
    {"external single", Feature::outer_wall},
    {"internal single", Feature::inner_wall},
    {"floating vertical", Feature::inner_wall},
    {"solid-fill", Feature::top},
    {"outer wall", Feature::outer_wall},
    {"wall-outer", Feature::outer_wall},
    {"outer perimeter", Feature::outer_wall},
    {"thin wall", Feature::outer_wall},
    {"perimeter path", Feature::outer_wall},
    {"loop path", Feature::inner_wall},
    {"inner wall", Feature::inner_wall},
    {"wall-inner", Feature::inner_wall},
    {"perimeter", Feature::inner_wall},
    {"gap fill", Feature::inner_wall},
    {"gap infill", Feature::inner_wall},
    {"ironing", Feature::top},
    {"top ", Feature::top},
    {"skin", Feature::top},
    {"solid path", Feature::top},
    {"solid layer", Feature::top},
    {"bottom ", Feature::bottom},
    {"internal bridge", Feature::solid},
    {"bridge", Feature::bottom},
    {"sparse", Feature::sparse},
    {"internal infill", Feature::sparse},
    {"solid", Feature::solid},
    {"infill", Feature::sparse},
    {"fill", Feature::sparse},
    {"custom", Feature::custom},
}};

std::optional<Feature> feature_named(std::string_view name) {
  const std::string wanted = lower(name);
  for (const auto& [words, feature] : features) {
    if (wanted.find(words) != std::string::npos) return feature;
  }
  return std::nullopt;
}

void enter(CommentState& state, std::string_view name) {
  state.any_feature = true;
  state.feature = feature_named(name).value_or(Feature::unknown);
}

std::optional<double> number_in(std::string_view text) {
  text = trimmed(text);
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || !(value > 0) || value > 1000) return std::nullopt;
  return value;
}

bool is_colour(std::string_view text) {
  return (text.size() == 7 || text.size() == 9) && text.front() == '#' &&
         text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos;
}

/// "#FF0000;#00ff00"
void take_colours(std::vector<std::string>& colours, std::string_view list) {
  for (std::size_t tool = 0; tool < most_tools; ++tool) {
    const auto end = list.find(';');
    std::string_view one = trimmed(list.substr(0, end));
    if (one.size() > 1 && one.front() == '"' && one.back() == '"') one = one.substr(1, one.size() - 2);
    if (colours.size() <= tool) colours.resize(tool + 1);
    if (is_colour(one)) colours[tool] = lower(one.substr(0, 7));
    if (end == std::string_view::npos) return;
    list.remove_prefix(end + 1);
  }
}

/// "key = value" of PrusaSlicer and its relatives.
CommentMeaning read_setting(std::string_view comment, CommentState& state) {
  const auto equals = comment.find(" = ");
  if (equals == std::string_view::npos) return CommentMeaning::none;
  const std::string_view key = trimmed(comment.substr(0, equals)), value = comment.substr(equals + 3);
  if (key.empty() || key.find(' ') != std::string_view::npos) return CommentMeaning::none;
  if (key == "extruder_colour") take_colours(state.extruder_colours, value);
  if (key == "filament_colour") take_colours(state.filament_colours, value);
  if (key == "default_filament_colour") state.filaments_first = true;  // OrcaSlicer and Bambu Studio
  if (key == "filament_diameter") state.filament_diameter = number_in(value.substr(0, value.find(',')));
  if (key == "use_volumetric_e") state.volumetric = value == "1";
  return CommentMeaning::config;
}

/// The parts of PrusaSlicer's wipe tower: "CP TOOLCHANGE UNLOAD".
void read_tower(std::string_view words, CommentState& state) {
  if (words.ends_with("START")) state.tower = true;
  if (words.ends_with("END")) state.tower = state.ramming = false;
  if (words == "TOOLCHANGE UNLOAD" || words == "TOOLCHANGE LOAD") state.tower = state.ramming = true;
  if (words == "TOOLCHANGE WIPE") state.ramming = false;
}

bool read_slicer(std::string_view comment, CommentState& state) {
  if (!state.slicer.empty()) return false;
  std::string_view name = comment;
  if (!take(name, "generated by ") && !take(name, "Generated with ") && !take(name, "G-Code generated by ") &&
      !take(name, "Generated by ") && !take(name, "Sliced by ") && !name.starts_with("KISSlicer") &&
      !name.starts_with("BambuStudio") && !name.starts_with("OrcaSlicer"))
    return false;
  if (const auto on = name.find(" on "); on != std::string_view::npos) name = name.substr(0, on);
  state.slicer = core::printable(trimmed(name), 60);
  return true;
}

bool is_simplify3d(std::string_view slicer) {
  return slicer.find("Simplify3D") != std::string_view::npos;
}

/// "feature outer perimeter" of version 4, the bare "outer perimeter" of older ones, "tool H0.200 W0.480".
/// Several processes print one layer after the other, each with a mark of the layer.
CommentMeaning read_simplify3d(std::string_view comment, CommentState& state) {
  if (comment.starts_with("layer ") && comment.find("Z =") != std::string_view::npos) {
    std::string z(trimmed(comment.substr(comment.find("Z =") + 3)));
    if (z == state.layer_z) return CommentMeaning::layer_mark;
    state.layer_z = std::move(z);
    return CommentMeaning::layer;
  }
  if (comment.starts_with("tool H") && comment.find(" W") != std::string_view::npos) {
    state.height = number_in(comment.substr(6, comment.find(' ', 6) - 6));
    state.width = number_in(comment.substr(comment.find(" W") + 2));
    return CommentMeaning::layer_mark;
  }
  take(comment, "feature ");
  const bool setting = comment.find(',') != std::string_view::npos;
  if (!setting && comment.size() < 32 && feature_named(comment)) enter(state, comment);
  return CommentMeaning::none;
}

/// "shell", "layer:0.20"
CommentMeaning read_flashprint(std::string_view comment, CommentState& state) {
  if (comment.starts_with("layer:")) return CommentMeaning::layer;
  if (comment == "shell") enter(state, "outer wall");
  if (comment == "infill" || comment == "raft" || comment == "support") enter(state, comment);
  return CommentMeaning::none;
}

}  // namespace

std::string CommentState::colour(int tool) const {
  const auto in = [tool](const std::vector<std::string>& colours) {
    return tool >= 0 && static_cast<std::size_t>(tool) < colours.size()
               ? colours[static_cast<std::size_t>(tool)]
               : std::string();
  };
  const std::string extruder = in(extruder_colours), filament = in(filament_colours);
  return filaments_first ? (filament.empty() ? extruder : filament)
                         : (extruder.empty() ? filament : extruder);
}

CommentMeaning read_comment(std::string_view raw, CommentState& state) {
  std::string_view comment = trimmed(raw);
  if (comment.empty()) return CommentMeaning::none;
  if (take(comment, "TYPE:") || take(comment, "FEATURE:")) {
    enter(state, trimmed(comment));
    return CommentMeaning::none;
  }
  if (take(comment, "WIDTH:") || take(comment, "LINE_WIDTH:")) {
    state.width = number_in(comment);
    return CommentMeaning::none;
  }
  if (take(comment, "HEIGHT:") || take(comment, "LAYER_HEIGHT:")) {
    state.height = number_in(comment);
    return CommentMeaning::layer_mark;
  }
  if (comment == "LAYER_CHANGE" || comment == "CHANGE_LAYER" || comment.starts_with("LAYER:") ||
      comment.starts_with("BEGIN_LAYER_OBJECT") || comment.starts_with("BEGIN_LAYER_RAFT"))
    return CommentMeaning::layer;
  if (comment.starts_with("Z:") || comment.starts_with("Z_HEIGHT:")) return CommentMeaning::layer_mark;
  if (take(comment, "COLOR_CHANGE,")) {  // "T0,#ff0000"
    const auto colour = comment.find('#');
    if (colour == std::string_view::npos || !is_colour(comment.substr(colour, 7)))
      return CommentMeaning::none;
    state.changed_to = lower(comment.substr(colour, 7));
    return CommentMeaning::colour;
  }
  if (take(comment, "CP ")) {
    read_tower(trimmed(comment), state);
    return CommentMeaning::none;
  }
  if (comment == "FLUSH_START" || comment == "FLUSH_END") {
    state.ramming = comment.ends_with("START");
    return CommentMeaning::none;
  }
  if (comment == "WIPE_TOWER_START" || comment == "WIPE_TOWER_END") {
    state.tower = comment.ends_with("START");
    return CommentMeaning::none;
  }
  if (read_slicer(comment, state)) return CommentMeaning::none;
  if (is_simplify3d(state.slicer)) return read_simplify3d(comment, state);
  if (state.slicer.starts_with("ffslicer")) return read_flashprint(comment, state);
  if (comment.front() == '\'' && comment.find("Path'") != std::string_view::npos) {  // KISSlicer
    enter(state, comment.substr(1, comment.find('\'', 1) - 1));
    return CommentMeaning::none;
  }
  return read_setting(comment, state);
}

}  // namespace unicursal::gcode
