#include "host/cli/status_line.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>
#include <vector>

#include "host/cli/columns.hpp"
#include "host/cli/for_terminal.hpp"

namespace unicursal::host {
namespace {

using std::chrono::system_clock;

constexpr double clock_from = 60;  ///< s left, from which on the time of day is worth a field
constexpr std::size_t swatch_width = 2;

/// Higher ranks stay longer.
enum Rank { queue, bed, nozzle, ahead, mixture, change, clock, layer, percent, left, heat, state };

struct Field {
  Rank rank{};
  std::vector<std::string> forms;  ///< from the longest to the shortest; each with its separator
  std::string swatch = {};         ///< behind the separator
  std::size_t form = 0;
  bool present = true;

  std::size_t width() const {
    return present ? columns(forms[form]) + (swatch.empty() ? 0 : swatch_width) : 0;
  }
};

class Line {
 public:
  void add(Rank rank, std::vector<std::string> forms) { fields_.push_back({rank, std::move(forms)}); }
  /// The form is a separator of two characters and the text behind the swatch.
  void add(Rank rank, std::string form, std::string swatch) {
    fields_.push_back({rank, {std::move(form)}, std::move(swatch)});
  }

  std::string fitting(std::size_t most) {
    std::vector<Field*> by_rank;
    for (Field& field : fields_) by_rank.push_back(&field);
    std::stable_sort(by_rank.begin(), by_rank.end(),
                     [](const Field* a, const Field* b) { return a->rank < b->rank; });
    for (Field* field : by_rank) {
      if (width() > most) field->form = field->forms.size() - 1;
    }
    for (Field* field : by_rank) {
      if (width() > most && field->rank != state) field->present = false;
    }
    // Where fields have gone, the others have room again.
    for (auto field = by_rank.rbegin(); field != by_rank.rend(); ++field) {
      const std::size_t shorter = std::exchange((*field)->form, 0);
      if (width() > most) (*field)->form = shorter;
    }
    return text();
  }

 private:
  std::size_t width() const {
    std::size_t sum = 0;
    for (const Field& field : fields_) sum += field.width();
    return sum;
  }
  std::string text() const {
    std::string line;
    for (const Field& field : fields_) {
      if (!field.present) continue;
      const std::string safe = for_terminal(field.forms[field.form]);
      line += field.swatch.empty() ? safe : safe.substr(0, 2) + field.swatch + safe.substr(2);
    }
    return line;
  }

  std::vector<Field> fields_;
};

std::vector<std::string> heat_forms(const char* what, double actual, const std::optional<double>& target) {
  std::string now = fmt::format(", {} {:.0f} °C", what, actual);
  if (!target || *target <= 0) return {std::move(now)};
  return {fmt::format(", {} {:.0f}/{:.0f} °C", what, actual, *target), std::move(now)};
}

std::string state_words(const SessionStatus& s, const StatusLook& look) {
  const bool under_way = s.state == SessionState::printing || s.state == SessionState::heating ||
                         s.state == SessionState::connecting;
  if (look.feeds && s.state == SessionState::printing) return "feeding";
  if (!look.dry || !under_way) return name(s.state);
  return s.layer > 0 ? "dry run" : "dry run, planning";
}

}  // namespace

std::string rough_duration(double seconds) {
  const auto s = static_cast<long>(std::lround(std::max(seconds, 0.0)));
  constexpr long minute = 60, hour = 3600, day = 24 * hour;
  if (s < minute) return fmt::format("{} s", s);
  if (s < 10 * minute) return fmt::format("{} min {:02} s", s / minute, s % minute);
  if (s < hour) return fmt::format("{} min", s / minute);
  if (s < day) return fmt::format("{} h {:02} min", s / hour, s % hour / minute);
  return fmt::format("{} d {} h", s / day, s % day / hour);
}

std::string time_of_day(system_clock::time_point at, system_clock::time_point now) {
  const auto local = [](system_clock::time_point time) {
    const std::time_t seconds = system_clock::to_time_t(time);
    std::tm parts{};
    localtime_r(&seconds, &parts);
    return parts;
  };
  const std::tm then = local(at), today = local(now);
  const bool same_day = then.tm_year == today.tm_year && then.tm_yday == today.tm_yday;
  return same_day ? fmt::format("{:%H:%M}", then) : fmt::format("{:%a %H:%M}", then);
}

std::string status_line(const SessionStatus& s, const StatusLook& look, std::size_t width,
                        system_clock::time_point now) {
  Line line;
  line.add(state, {state_words(s, look)});
  if (s.layer > 0) {
    if (!look.feeds)
      line.add(layer, {fmt::format(" layer {} of {}", s.layer, s.layers),
                       fmt::format(" layer {}/{}", s.layer, s.layers)});
    line.add(percent, {fmt::format(", {:.0f} %", s.percent)});
  }
  const std::optional<double> seconds = look.dry ? look.dry_left : s.left;
  if (seconds && !has_ended(s.state)) {
    line.add(left, {", " + rough_duration(*seconds) + " left"});
    if (*seconds >= clock_from) {
      const auto ready = now + std::chrono::seconds(std::lround(*seconds));
      line.add(clock, {" (" + time_of_day(ready, now) + ")"});
    }
  }
  const gcode::Temperatures& t = s.temperatures;
  const bool heats = s.state == SessionState::heating || s.state == SessionState::resuming;
  const bool shows_heat = !look.dry;
  if (shows_heat && t.nozzle)
    line.add(heats ? heat : nozzle, heat_forms("nozzle", *t.nozzle, t.nozzle_target));
  if (shows_heat && t.bed && heats) line.add(heat, heat_forms("bed", *t.bed, t.bed_target));
  if (!s.mixture.empty()) {
    const auto colour = look.colour_of ? look.colour_of(s.mixture) : std::nullopt;
    const std::string patch = colour ? swatch(*colour, look.colours) : "";
    line.add(mixture, patch.empty() ? ", " + s.mixture : ",  " + s.mixture, patch);
  }
  if (s.lookahead_layers > 0 && !look.feeds) {
    const std::string time = rough_duration(s.lookahead);
    line.add(ahead, {fmt::format(", {} planned ahead", time), fmt::format(", {} ahead", time)});
  }
  if (s.speed_percent != 100) line.add(change, {fmt::format(", speed {:.0f} %", s.speed_percent)});
  if (s.flow_percent != 100) line.add(change, {fmt::format(", flow {:.0f} %", s.flow_percent)});
  if (shows_heat && t.bed && !heats) line.add(bed, heat_forms("bed", *t.bed, t.bed_target));
  if (s.queue) line.add(queue, {fmt::format(", queue {:.0f} %", 100 * *s.queue)});
  return line.fitting(width);
}

}  // namespace unicursal::host
