#include "firmware_gcode/sliced/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/numeric/vec2.hpp"
#include "core/text/printable.hpp"
#include "firmware_gcode/dialect/number.hpp"

namespace unicursal::gcode {
namespace {

constexpr double beyond_bed = 0.05;    ///< mm that a position may lie outside, by rounding
constexpr double below_bed = 0.5;      ///< mm; some slicers lower the first layer by an offset
constexpr double cold = 170;           ///< °C; firmwares refuse to extrude below (Marlin: EXTRUDE_MINTEMP)
constexpr double least_cold = 150;     ///< °C; a printer that extrudes from here on is not harmed
constexpr double chord_error = 0.005;  ///< mm between an arc and its chords
constexpr double radius_error = 0.05;  ///< mm by which the ends of an arc may differ in radius
constexpr double longest_filament = 1000;  ///< mm in one move; more is a typing error
constexpr double new_layer = 0.04;         ///< mm by which a layer is higher, if no comment says so
constexpr double farthest = 1e5;           ///< mm
constexpr int most_tools = 255;
constexpr std::size_t most_layers = 1'000'000;
constexpr std::size_t most_notes = 100;    ///< a hostile file may have any number of unknown words
constexpr int first_own_number = 1000;     ///< of tools whose mixture the file changes as it goes
constexpr int first_colour_number = 2000;  ///< of tools whose filament the file changes as it goes
constexpr std::array<char, 3> axes{'X', 'Y', 'Z'};

std::string shown(std::string_view text) {
  return core::printable(text, 40);
}

}  // namespace

SlicedReader::SlicedReader(std::istream& file, std::string name, const Printer& printer,
                           const SlicedLimits& limits, bool marked)
    : source_(file, name), name_(std::move(name)), printer_(printer), limits_(limits), marked_(marked) {}

void SlicedReader::refuse(const std::string& problem, const std::string& remedy) const {
  throw core::DataError(name_, fmt::format("line {}", source_.number()), problem, remedy);
}

void SlicedReader::note(const std::string& key, const std::string& sentence) {
  if (noted_.size() >= most_notes && !noted_.contains(key)) return;
  Noted& noted = noted_[key];
  if (noted.count++ == 0) noted.line = source_.number(), noted.sentence = sentence;
}

std::vector<std::string> SlicedReader::notes() const {
  std::vector<Noted> sorted;
  for (const auto& [key, noted] : noted_) sorted.push_back(noted);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Noted& a, const Noted& b) { return a.line < b.line; });
  std::vector<std::string> sentences;
  for (const auto& [line, count, sentence] : sorted) {
    const std::string more = count == 1 ? "" : fmt::format(" (and {} more)", count - 1);
    sentences.push_back(fmt::format("line {}: {}{}", line, sentence, more));
  }
  return sentences;
}

std::optional<SlicedStep> SlicedReader::next() {
  while (steps_.empty()) {
    const auto line = source_.next();
    if (!line) return std::nullopt;
    read(*line);
  }
  SlicedStep step = std::move(steps_.front());
  steps_.pop_front();
  return step;
}

void SlicedReader::read(std::string_view line) {
  const SplitLine split = split_comment(line);
  if (!split.command.empty() && split.command.front() != '(' && split.command.front() != '%')
    command(parse_command(split.command));
  if (split.has_comment && split.command.empty()) comment(split.comment);
}

void SlicedReader::comment(std::string_view text) {
  constexpr std::size_t most_shown = 200;
  switch (read_comment(text, comments_)) {
    case CommentMeaning::layer:
      marked_late_ = marked_late_ || (!marked_ && layers_ > 0);
      marked_ = true;
      return begin_layer();
    case CommentMeaning::layer_mark:
      return;
    case CommentMeaning::colour:
      change_colour();
      break;
    case CommentMeaning::config:
      if (comments_.volumetric)
        refuse("E is measured in mm³",
               "switch volumetric E off in the slicer's printer settings, and slice again");
      break;
    case CommentMeaning::none:
      break;
  }
  std::string safe(trimmed(text).substr(0, most_shown));
  for (char& c : safe) {
    if (c < ' ' || c > '~') c = '?';
  }
  steps_.emplace_back(SlicedRemark{"; " + safe});
  // Viewers know these words without a space.
  if (safe.starts_with("TYPE:") || safe.starts_with("WIDTH:"))
    std::get<SlicedRemark>(steps_.back()).text = ";" + safe;
}

void SlicedReader::begin_layer() {
  if (layers_ == most_layers)
    refuse(fmt::format("begins layer {}", most_layers + 1), "check that the file is one print");
  steps_.emplace_back(SlicedLayer{layers_++, source_.number()});
}

/// Without comments, a layer begins where plastic is laid at another height.
void SlicedReader::begin_layer_by_height(double z) {
  if (marked_) return;
  if (layers_ > 0 && z < layer_z_ + new_layer && z > layer_z_ - new_layer) return;
  layer_z_ = z;
  begin_layer();
}

void SlicedReader::pass(std::string text) {
  steps_.emplace_back(
      SlicedPass{source_.number(), std::move(text), comments_.tower || comments_.feature == Feature::tower});
}

void SlicedReader::command(const SlicedCommand& line) {
  if (line.letter == 'T') return change_tool(line);
  if (line.letter == 'G' && line.code >= 0 && line.code <= 3 && line.sub == 0) return motion(line);
  if (line.letter == 'G' && (line.code == 10 || line.code == 11)) {
    if (line.code == 10 && (line.valued('P') || line.valued('R'))) return heat(line);  // RepRapFirmware
    return retract_by_firmware(line.code == 10);
  }
  if (line.letter != 'G' && line.letter != 'M') {
    if (macro_.empty())
      macro_ = fmt::format("; \"{}\" in line {} is a macro of another printer", shown(line.name),
                           source_.number());
    note("word " + std::string(line.name),
         fmt::format("\"{}\" is not a G-code that this printer knows; it is left out", shown(line.name)));
    return;
  }
  const CommandUse use = use_of(line);
  std::string word(line.name);
  word.front() = line.letter;
  switch (use.kind) {
    case CommandKind::mode:
      return set_mode(line);
    case CommandKind::heat:
      return heat(line);
    case CommandKind::wait:
      return wait_for_person(line);
    case CommandKind::mixture:
      return mixture(line);
    case CommandKind::homes:
      return home(line);
    case CommandKind::rate:
      if (!rates_.take(line))
        refuse(fmt::format("{} sets a rate that is not 1 to 999 %", shown(line.text)), "repair this line");
      return;
    case CommandKind::refuse:
      if (line.is('G', 5) && !line.has('X') && !line.has('Y') && !line.has('E')) return;
      if (line.is('M', 302) && line.value_or('S', 0) >= least_cold && line.value_or('P', 0) == 0) return;
      refuse(fmt::format("{} {}", shown(line.name), use.why), std::string(use.remedy));
    case CommandKind::leave_out:
      if (use.why.empty()) return;
      return note("out " + word, fmt::format("{} {}; it is left out", shown(line.name), use.why));
    case CommandKind::unknown:
      note("unknown " + word,
           fmt::format("{} is not known to this program; it is sent as it is", shown(line.name)));
      break;
    case CommandKind::pass:
      break;
  }
  constexpr std::size_t longest = 90;  // characters that every firmware takes with a number and a checksum
  if (line.text.size() > longest) {
    return note("long " + word,
                fmt::format("{} is longer than the printer's buffer; it is left out", shown(line.name)));
  }
  if (line.is('M', 117) || line.is('M', 118)) {
    std::string words(line.text);
    for (char& c : words) {
      if (c < ' ' || c > '~' || c == '*') c = '?';
    }
    return pass(std::move(words));
  }
  if (std::any_of(line.text.begin(), line.text.end(), [](char c) { return c < ' ' || c > '~' || c == '*'; }))
    return note(
        "odd " + word,
        fmt::format("{} has characters that a serial line cannot carry; it is left out", shown(line.name)));
  std::string words(line.text);
  words.front() = line.letter;  // the file may write it small
  pass(std::move(words));
}

// ---- motion

double SlicedReader::filament_of(const SlicedCommand& line) {
  if (!line.valued('E')) return 0;
  const double value = unit(line.value('E'));
  const double filament = relative_ || relative_filament_ ? value : value - e_;
  e_ = relative_ || relative_filament_ ? e_ + value : value;
  if (std::abs(filament) > longest_filament) {
    refuse(fmt::format("feeds {:.0f} mm of filament in one move", filament),
           relative_filament_ ? "check whether the file mixes relative and absolute extrusion"
                              : "check that the file resets E (G92 E0) where it should");
  }
  return filament;
}

Place SlicedReader::target_of(const SlicedCommand& line) const {
  Place to = at_;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!line.valued(axes[i])) continue;
    const double value = unit(line.value(axes[i]));
    to[i] = relative_ ? *at_[i] + value : value;
  }
  return to;
}

void SlicedReader::motion(const SlicedCommand& line) {
  if (line.damaged)
    refuse(fmt::format("\"{}\" cannot be read", shown(line.text)),
           "slice the part again, or repair this line");
  if (line.valued('F')) {
    const double feed = unit(line.value('F'));
    if (feed < 0) refuse("has a negative feed rate", "slice the part again, or repair this line");
    if (feed > 0) feed_ = feed;
  }
  const bool nowhere = relative_ && std::any_of(axes.begin(), axes.end(), [&](const char& axis) {
                         return line.valued(axis) && !at_[static_cast<std::size_t>(&axis - axes.data())];
                       });
  const double filament = filament_of(line);
  if (nowhere) return relative_from_nowhere(line, filament);
  const Place to = target_of(line);
  if (line.code <= 1) return move(to, filament);
  arc(line, to, filament, line.code == 2);
}

void SlicedReader::check_inside(const Place& place) const {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!place[i]) continue;
    const double native = *place[i] + offset_[i];
    const double least = i == 2 ? -below_bed : -printer_.overtravel[i] - beyond_bed;
    if (std::isfinite(native) && native >= least && native <= printer_.bed[i] + beyond_bed) continue;
    if (!std::isfinite(native) || std::abs(native) > farthest)
      refuse("moves farther than any printer can", "slice the part again, or repair this line");
    refuse(fmt::format("moves to {} = {:g} mm, outside the bed of the profile ({:g} to {:g} mm)",
                       static_cast<char>(axes[i] - 'A' + 'a'), native,
                       i == 2 ? 0 : 0 - printer_.overtravel[i], printer_.bed[i]),
           "slice for this printer, with the origin at the bed's front left corner and without another "
           "printer's purge line, or correct `bed` or `overtravel` in the profile");
  }
}

void SlicedReader::check_warm() const {
  if (nozzle_ >= cold) return;
  refuse(nozzle_ == 0 ? "extrudes before the file has heated the nozzle" + macro_
                      : fmt::format("extrudes with the nozzle set to {:g} °C", nozzle_),
         "add M109 to the slicer's start G-code, as every slicer's own profiles have it");
}

/// A host's macro may have homed, which this program does not know.
void SlicedReader::check_homed() const {
  if (homed_[0] && homed_[1] && homed_[2]) return;
  refuse("prints before the file has homed the axes" + macro_,
         "add G28 to the slicer's start G-code, as every slicer's own profiles have it");
}

/// Some files rely on a firmware that waits by itself.
void SlicedReader::wait_for_heat() {
  if (std::exchange(waited_, true) || layers_ > 0) return;
  note("no wait", "the file extrudes without waiting for the nozzle's heat; the print waits there");
  pass(fmt::format("M109 S{}", short_number(nozzle_, 1)));
}

void SlicedReader::move(const Place& to, double filament) {
  check_inside(to);
  if (filament > 0) check_warm(), wait_for_heat();
  SlicedMove step;
  step.line = source_.number();
  step.from = at_;
  step.to = to;
  step.filament = filament * rates_.flow();
  step.feed = feed_ * rates_.speed();
  step.feature = comments_.present();
  step.width = comments_.width.value_or(0);
  step.height = comments_.height.value_or(0);
  step.ramming = comments_.ramming;
  at_ = to;
  if (!step.moves() && filament == 0) return;
  if (step.lays()) check_homed();
  // What is laid before the first mark is the user's own.
  const bool beside = step.feature == Feature::custom || step.feature == Feature::tower || step.ramming;
  if (step.lays() && !beside && to[2]) begin_layer_by_height(*to[2]);
  if (layers_ == 0 && step.feature != Feature::tower) step.feature = Feature::custom;
  if (layers_ == 1 && step.feature == Feature::solid) step.feature = Feature::bottom;
  laid_ = laid_ || (layers_ > 0 && step.lays());
  steps_.emplace_back(std::move(step));
}

/// A relative move whose beginning is not known stays relative.
void SlicedReader::relative_from_nowhere(const SlicedCommand& line, double filament) {
  if (line.code > 1) refuse("draws an arc from a place that is not known", "home the axes before it");
  if (filament > 0) check_warm();
  std::string words = "G1";
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!line.valued(axes[i])) continue;
    const double value = unit(line.value(axes[i]));
    if (std::abs(value) > farthest) refuse("moves farther than any printer can", "repair this line");
    words += fmt::format(" {}{}", axes[i], short_number(value, 5));
    if (at_[i]) *at_[i] += value;
  }
  if (feed_ > 0) words += " F" + short_number(feed_ * rates_.speed(), 1);
  pass("G91");
  pass(std::move(words));
  pass("G90");
  pass("M83");
  if (filament == 0) return;
  SlicedMove step;
  step.line = source_.number();
  step.from = step.to = at_;
  step.filament = filament * rates_.flow();
  step.feed = feed_ * rates_.speed();
  step.feature = Feature::custom;
  steps_.emplace_back(std::move(step));
}

/// The centre comes from I and J, relative to the beginning, or from R (NIST RS274/NGC, 3.5.3).
void SlicedReader::arc(const SlicedCommand& line, const Place& to, double filament, bool clockwise) {
  const auto bad = [&](const char* why) {
    refuse(fmt::format("is an arc {}", why), "switch arcs off in the slicer, and slice again");
  };
  if (!at_[0] || !at_[1]) bad("from a place that is not known");
  check_inside(to);
  const core::Vec2 from(*at_[0], *at_[1]), end(*to[0], *to[1]);
  core::Vec2 centre = from;
  const double turn = clockwise ? -1 : 1;
  if (line.valued('R')) {
    const double radius = unit(line.value('R')), half = (end - from).norm() / 2;
    if (half <= 0 || std::abs(radius) < half - radius_error) bad("whose radius is too small");
    const core::Vec2 along = (end - from) / (2 * half), left(-along.y(), along.x());
    const double rise = std::sqrt(std::max(0.0, radius * radius - half * half));
    centre = (from + end) / 2 + left * (turn * (radius > 0 ? 1 : -1) * rise);
  } else {
    if (!line.valued('I') && !line.valued('J')) bad("without a centre");
    centre += core::Vec2(unit(line.value_or('I', 0)), unit(line.value_or('J', 0)));
  }
  const core::Vec2 a = from - centre, b = end - centre;
  const double radius = a.norm();
  if (!(radius > 0) || radius > farthest) bad("without a radius");
  if (std::abs(radius - b.norm()) > radius_error)
    bad("whose ends lie at different distances from its centre");
  double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)) * turn;
  constexpr double whole = 2 * std::numbers::pi, tiny = 1e-9;
  if (angle <= tiny) angle += whole;  // equal ends: a whole circle
  const double step = 2 * std::acos(std::max(0.0, 1 - std::min(1.0, chord_error / radius)));
  const auto pieces = static_cast<int>(std::clamp(std::ceil(angle / step), 1.0, 10000.0));
  const Place begin = at_;
  for (int i = 1; i <= pieces; ++i) {
    Place next = to;
    const double part = double(i) / pieces;
    if (i < pieces) {
      const double phi = turn * angle * part, radius_here = radius + (b.norm() - radius) * part;
      const core::Vec2 direction = a / radius;
      next[0] = centre.x() + radius_here * (direction.x() * std::cos(phi) - direction.y() * std::sin(phi));
      next[1] = centre.y() + radius_here * (direction.x() * std::sin(phi) + direction.y() * std::cos(phi));
      if (begin[2] && to[2]) next[2] = *begin[2] + (*to[2] - *begin[2]) * part;
    }
    move(next, filament / pieces);
  }
}

void SlicedReader::retract_by_firmware(bool back) {
  note("firmware retraction",
       "G10 and G11 leave the length of retraction to the firmware; the profile's is used");
  if (std::exchange(drawn_by_firmware_, back) == back) return;
  SlicedMove step;
  step.line = source_.number();
  step.from = step.to = at_;
  step.filament = back ? -printer_.retraction_length : printer_.retraction_length;
  step.feed = printer_.retraction_speed * 60;
  step.feature = comments_.present();
  if (step.filament != 0) steps_.emplace_back(std::move(step));
}

// ---- modes

void SlicedReader::set_mode(const SlicedCommand& line) {
  if (line.letter == 'M' && (line.code == 6 || line.code == 108)) {  // FlashPrint's change of tool
    if (line.valued('T')) change_tool(parse_command(fmt::format("T{}", line.value('T'))));
    return;
  }
  if (line.is('G', 20)) inches_ = true;
  if (line.is('G', 21)) inches_ = false;
  if (line.is('G', 90)) relative_ = false;
  if (line.is('G', 91)) relative_ = true;
  if (line.is('M', 82)) relative_filament_ = false;
  if (line.is('M', 83)) relative_filament_ = true;
  if (line.is('M', 200) && line.value_or('D', 0) > 0 && line.value_or('S', 1) > 0)
    refuse("M200 makes E a volume",
           "switch volumetric E off in the slicer's printer settings, and slice again");
  if (line.is('G', 92)) set_position(line);
}

void SlicedReader::set_position(const SlicedCommand& line) {
  if (line.sub != 0) refuse("changes the offset of the axes for good", "remove this line");
  const bool all = !line.has('X') && !line.has('Y') && !line.has('Z') && !line.has('E');
  if (line.has('E') || all) e_ = unit(line.value_or('E', 0));
  std::string words;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!line.has(axes[i]) && !all) continue;
    const double value = unit(line.value_or(axes[i], 0));
    if (std::abs(value) > farthest) refuse("sets a position that no printer has", "repair this line");
    if (at_[i]) offset_[i] += *at_[i] - value;
    at_[i] = value;
    homed_[i] = true;
    words += fmt::format(" {}{}", axes[i], short_number(value, 5));
  }
  if (!words.empty()) pass("G92" + words);
}

/// The firmware chooses where the nozzle stands afterwards.
void SlicedReader::home(const SlicedCommand& line) {
  const bool some = std::any_of(axes.begin(), axes.end(), [&](char axis) { return line.has(axis); });
  const bool homes = line.is('G', 28) || line.is('G', 161) || line.is('G', 162);
  if (homes && laid_ && (!some || line.has('Z')))
    note("home", "G28 homes z although plastic was laid; see that the head cannot strike the part");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (homes && some && !line.has(axes[i])) continue;
    at_[i].reset();
    offset_[i] = 0;
    homed_[i] = homed_[i] || homes;
  }
  if (!line.is('G', 161) && !line.is('G', 162)) return pass(std::string(line.text.substr(0, 90)));
  std::string words = "G28";  // FlashPrint
  for (const char axis : axes) {
    if (line.has(axis)) words += fmt::format(" {}", axis);
  }
  pass(std::move(words));
}

void SlicedReader::heat(const SlicedCommand& line) {
  if (line.is('M', 116)) {  // waits for all heaters
    if (layers_ > 0) return note("wait", "M116 would wait over the part; it is left out");
    if (bed_ > 0) pass("M190 S" + short_number(bed_, 1));
    if (nozzle_ > 0) pass("M109 S" + short_number(nozzle_, 1));
    waited_ = true;
    return;
  }
  const bool bed = line.is('M', 140) || line.is('M', 190);
  const bool standby =
      line.is('G', 10) || line.is('M', 568);  // their R is the temperature of a tool that waits
  const double target = line.value_or('S', standby ? -1 : line.value_or('R', -1));
  if (target < 0) return;  // only a wait, or a question
  const double most = bed ? limits_.hottest_bed : limits_.hottest_nozzle;
  if (target > most) {
    refuse(fmt::format("heats the {} to {:g} °C; the most is {:g} °C", bed ? "bed" : "nozzle", target, most),
           "correct the temperature in the slicer");
  }
  const char which = standby ? 'P' : 'T';
  if (!bed && line.valued(which) && static_cast<int>(line.value(which)) != tool_ && target < nozzle_) {
    return note(
        "other nozzle",
        "the file cools a nozzle that waits; this printer has one nozzle for all tools, which stays hot");
  }
  double& hottest = bed ? hottest_bed_ : hottest_nozzle_;
  hottest = std::max(hottest, target);
  bool wait = line.is('M', 109) || line.is('M', 190);
  if (wait && layers_ > 0) {
    note("wait", fmt::format("{} would wait over the part; the temperature is set without waiting",
                             shown(line.name)));
    wait = false;
  }
  if (!bed) waited_ = wait || (waited_ && target <= nozzle_);
  const bool same = std::exchange(bed ? bed_ : nozzle_, target) == target;
  // Slicers repeat it at each change of tool, which would undo what a person has set.
  if (same && !wait && layers_ > 0) return;
  const bool only_up = line.valued('S');
  pass(fmt::format("M{} {}{}", bed ? (wait ? 190 : 140) : (wait ? 109 : 104), wait && !only_up ? 'R' : 'S',
                   short_number(target, 1)));
}

void SlicedReader::wait_for_person(const SlicedCommand& line) {
  if (std::exchange(changes_colour_, false)) return;
  const bool timed =
      (line.is('M', 0) || line.is('M', 1)) && (line.value_or('S', 0) > 0 || line.value_or('P', 0) > 0);
  if (!timed && !limits_.allow_stops) {
    refuse(fmt::format("{} waits for a person, with the nozzle hot over the part", shown(line.name)),
           "remove it, or allow it with part.stops = true or --allow-stops and stay beside the printer");
  }
  if (timed) return pass(std::string(line.text.substr(0, 90)));
  note("stop", fmt::format("{} waits for a person", shown(line.name)));
  pass(std::string(line.name));
}

// ---- tools

void SlicedReader::enter_tool(int tool) {
  mixture_tool_ = tool;
  steps_.emplace_back(SlicedToolChange{tool, comments_.ramming});
}

void SlicedReader::change_tool(const SlicedCommand& line) {
  const bool word = line.text.find_first_of("?_") != std::string_view::npos ||
                    line.text.find_first_of("xXcC") != std::string_view::npos;
  if (line.code < 0 || line.code >= most_tools || word) {
    return note("tool " + std::string(line.name),
                fmt::format("{} is not a tool of this printer; it is left out", shown(line.name)));
  }
  tool_ = line.code;
  const auto own = numbers_.find(tool_);
  enter_tool(own == numbers_.end() ? tool_ : own->second);
}

/// A pause for filament of another colour becomes a change of mixture.
void SlicedReader::change_colour() {
  changes_colour_ = true;
  note("colour",
       fmt::format("the file waits for filament of the colour {}; the mixture changes there instead",
                   comments_.changed_to));
  const auto same = std::find_if(own_colours_.begin(), own_colours_.end(),
                                 [&](const auto& known) { return known.second == comments_.changed_to; });
  if (same == own_colours_.end() && own_colours_.size() >= most_tools)
    refuse("is one colour too many", "use fewer colours in one file");
  const int number =
      same == own_colours_.end() ? first_colour_number + static_cast<int>(own_colours_.size()) : same->first;
  own_colours_.emplace(number, comments_.changed_to);
  numbers_[tool_] = number;
  enter_tool(number);
}

/// A file that mixes already: each mixture that it gives to a tool counts as a tool of its own.
void SlicedReader::mixture(const SlicedCommand& line) {
  Shares shares = Shares::zeros(printer_.feeders);
  int tool = tool_;
  if (line.is('M', 163)) {
    const double feeder = line.value_or('S', -1), share = line.value_or('P', -1);
    if (!(feeder >= 0) || feeder >= static_cast<double>(shares.size()) || !(share >= 0))
      refuse("M163 names a feeder or a share that this printer does not have",
             "correct it, or remove this line");
    collected_[static_cast<std::size_t>(feeder)] = share;
    return;
  }
  if (line.is('M', 164)) {
    tool = static_cast<int>(line.value_or('S', tool_));
    for (std::size_t f = 0; f < shares.size(); ++f) shares[f] = collected_[f].value_or(0);
    collected_ = {};
  }
  if (line.is('M', 165)) {
    constexpr std::array<char, 6> letters{'A', 'B', 'C', 'D', 'H', 'I'};
    for (std::size_t f = 0; f < letters.size(); ++f) {
      if (const double share = line.value_or(letters[f], 0); f < shares.size())
        shares[f] = share;
      else if (share > 0)
        refuse("M165 names a feeder that this printer does not have", "correct it, or remove this line");
    }
  }
  if (line.is('M', 567)) {
    tool = static_cast<int>(line.value_or('P', tool_));
    const auto list = line.text.find('E');
    if (list == std::string_view::npos) return;
    std::string_view rest = line.text.substr(list + 1);
    for (std::size_t f = 0; f < most_feeders && !rest.empty(); ++f) {
      const SlicedCommand one = parse_command("G0 E" + std::string(rest.substr(0, rest.find(':'))));
      if (const double share = one.value_or('E', 0); f < shares.size())
        shares[f] = share;
      else if (share > 0)
        refuse("M567 names a feeder that this printer does not have", "correct it, or remove this line");
      rest = rest.find(':') == std::string_view::npos ? std::string_view() : rest.substr(rest.find(':') + 1);
    }
  }
  if (tool < 0 || tool > most_tools)
    refuse("names a tool that no printer has", "correct it, or remove this line");
  const bool none = std::all_of(shares.begin(), shares.end(), [](double share) { return !(share > 0); });
  const bool bad = std::any_of(shares.begin(), shares.end(), [](double share) { return share < 0; });
  if (none || bad)
    refuse("is a mixture without shares, which would stop the printer", "correct it, or remove this line");
  if (own_mixtures_.size() >= most_tools) refuse("is one mixture too many", "use fewer mixtures in one file");
  const int number = first_own_number + static_cast<int>(own_mixtures_.size());
  const Mixture mixture(shares);
  const auto same = std::find_if(own_mixtures_.begin(), own_mixtures_.end(),
                                 [&](const auto& known) { return known.second == mixture; });
  if (same == own_mixtures_.end()) own_mixtures_.emplace(number, mixture);
  numbers_[tool] = same == own_mixtures_.end() ? number : same->first;
  if (tool == tool_ && !line.is('M', 164)) enter_tool(numbers_[tool]);
  if (line.is('M', 164) && tool == tool_) enter_tool(numbers_[tool]);
}

}  // namespace unicursal::gcode
