#include "host/doctor/examine.hpp"

#include <algorithm>
#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <charconv>
#include <exception>
#include <string_view>

#include "firmware_gcode/reply/phrases.hpp"
#include "host/engine/printer_check.hpp"
#include "host/loop/signal.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr unsigned most_tools = 16;      ///< A print uses no more.
constexpr int questions = 11;            ///< Questions to measure the answer time; odd, for the median.
constexpr auto late_answers = 500ms;     ///< Wait after the ok of firmwares whose answer follows it.
constexpr std::size_t most_lines = 500;  ///< Lines of an answer that are kept; M503 has about forty.

/// The number after a letter that begins a word.
std::optional<double> word_value(std::string_view line, char letter) {
  for (auto at = line.find(letter); at != std::string_view::npos; at = line.find(letter, at + 1)) {
    if (at == 0 || line[at - 1] != ' ') continue;
    double value = 0;
    const auto [end, error] = std::from_chars(line.data() + at + 1, line.data() + line.size(), value);
    if (error == std::errc()) return value;
  }
  return std::nullopt;
}

std::optional<std::array<double, 4>> axes_in(std::string_view line) {
  std::array<double, 4> values{};
  constexpr std::string_view letters = "XYZE";
  for (std::size_t i = 0; i < letters.size(); ++i) {
    const auto value = word_value(line, letters[i]);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return values;
}

bool has_word(std::string_view line, std::string_view word) {
  const auto at = line.find(word);
  if (at == std::string_view::npos || (at > 0 && line[at - 1] != ' ' && line[at - 1] != ':')) return false;
  return at + word.size() == line.size() || line[at + word.size()] == ' ';
}

/// Asks one question after the other, and collects the lines of each answer.
class Interview {
 public:
  Interview(Link& link, asio::any_io_executor executor, std::shared_ptr<Clock> clock)
      : link_(link), clock_(clock), pause_(executor, clock) {
    link_.on_message([this](const std::string& line) {
      if (heard_.size() < most_lines) heard_.push_back(line);
    });
  }
  ~Interview() { link_.on_message(nullptr); }
  Interview(const Interview&) = delete;
  Interview& operator=(const Interview&) = delete;

  asio::awaitable<void> connect() { co_await link_.connect(); }

  asio::awaitable<std::vector<std::string>> ask(std::string line) {
    heard_.clear();
    std::vector<std::string> lines;
    lines.push_back(std::move(line));
    co_await link_.send(std::move(lines));
    co_await link_.drain();
    const std::function<bool()> never = [] { return false; };
    if (link_.identity().family != gcode::Family::marlin)
      co_await pause_.wait(clock_->now() + late_answers, never);
    co_return std::move(heard_);
  }

  /// Returns the number of virtual tools, up to `most`. A Marlin refuses a tool that it does not have.
  asio::awaitable<unsigned> tools(unsigned most) {
    unsigned count = most;
    for (; count > 1; --count) {
      const std::vector<std::string> answer = co_await ask("T" + std::to_string(count - 1));
      const bool denied = std::any_of(answer.begin(), answer.end(), [](const std::string& line) {
        return gcode::meaning_of(line) == gcode::Meaning::no_such_tool;
      });
      if (!denied) break;
    }
    co_await ask("T0");
    co_return count;
  }

  /// Returns whether the printer knows the command.
  asio::awaitable<bool> knows(std::string line) {
    const std::vector<std::string> answer = co_await ask(std::move(line));
    co_return std::none_of(answer.begin(), answer.end(), [](const std::string& said) {
      return said.find("nknown command") != std::string::npos;
    });
  }

  asio::awaitable<double> answer_seconds() {
    std::vector<double> seconds;
    std::vector<std::string> query;
    query.push_back("M105");
    for (int i = 0; i < questions; ++i) {
      const TimePoint asked = clock_->now();
      co_await link_.send(query);
      co_await link_.drain();
      seconds.push_back(std::chrono::duration<double>(clock_->now() - asked).count());
    }
    std::sort(seconds.begin(), seconds.end());
    co_return seconds[seconds.size() / 2];
  }

  bool heard(std::string_view line) const {
    return std::find(heard_.begin(), heard_.end(), line) != heard_.end();
  }

 private:
  Link& link_;
  std::shared_ptr<Clock> clock_;
  Signal pause_;
  std::vector<std::string> heard_;
};

/// "Steps/mm: X: 80.000, Y: 80.000, Z: 400.000, E: 420.000:420.000", divided by `unit`.
std::optional<std::array<double, 4>> spoken_axes(std::string_view line, double unit) {
  std::array<double, 4> values{};
  constexpr std::array<std::string_view, 4> labels{" X: ", " Y: ", " Z: ", " E: "};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto at = line.find(labels[i]);
    if (at == std::string_view::npos) return std::nullopt;
    const std::string_view rest = line.substr(at + labels[i].size());
    if (std::from_chars(rest.data(), rest.data() + rest.size(), values[i]).ec != std::errc())
      return std::nullopt;
    values[i] /= unit;
  }
  return values;
}

/// It accepts M85 and ignores it. M503 shows the text of its configuration, which is not what is in force.
asio::awaitable<void> ask_reprapfirmware(Interview& interview, Examination& found) {
  const std::vector<std::string> mix = co_await interview.ask(mixing_question("reprapfirmware"));
  for (const std::string& line : mix) {
    if (const auto count = mixing_feeders(line)) found.feeders = count;
  }
  found.mixes = found.feeders.has_value();
  std::vector<std::string> answers;
  std::vector<std::string> limits{"M92", "M203", "M201", "M200"};
  for (std::string& question : limits) {
    const std::vector<std::string> lines = co_await interview.ask(std::move(question));
    answers.insert(answers.end(), lines.begin(), lines.end());
  }
  found.settings = spoken_settings(answers);
  found.tells_settings = found.settings.max_speed.has_value();
}

}  // namespace

MachineSettings settings_in(const std::vector<std::string>& lines) {
  MachineSettings settings;
  for (const std::string& line : lines) {
    if (has_word(line, "M92")) settings.steps_per_mm = axes_in(line);
    if (has_word(line, "M203")) settings.max_speed = axes_in(line);
    if (has_word(line, "M201")) settings.max_acceleration = axes_in(line);
    if (has_word(line, "M200")) {
      // Older firmwares have no S: D0 means off.
      const auto on = word_value(line, 'S'), diameter = word_value(line, 'D');
      settings.volumetric = on ? *on != 0 : diameter.value_or(0) != 0;
    }
  }
  return settings;
}

MachineSettings spoken_settings(const std::vector<std::string>& lines) {
  constexpr double seconds_per_minute = 60;
  MachineSettings settings;
  for (const std::string& line : lines) {
    if (line.starts_with("Steps/mm:")) settings.steps_per_mm = spoken_axes(line, 1);
    if (line.starts_with("Max speeds (mm/min):")) settings.max_speed = spoken_axes(line, seconds_per_minute);
    if (line.starts_with("Accelerations (mm/sec^2):")) settings.max_acceleration = spoken_axes(line, 1);
    if (line.starts_with("Volumetric extrusion is "))
      settings.volumetric = line.starts_with("Volumetric extrusion is enabled");
  }
  return settings;
}

asio::awaitable<Examination> examine(Link& link, asio::any_io_executor executor,
                                     std::shared_ptr<Clock> clock) {
  Interview interview(link, executor, clock);
  Examination found;
  co_await interview.connect();
  found.reset_by_opening = interview.heard("start");
  if (link.identity().family == gcode::Family::reprapfirmware) {
    co_await ask_reprapfirmware(interview, found);
  } else {
    found.mixes = co_await interview.knows(mixing_question("marlin"));
    if (found.mixes && link.identity().family == gcode::Family::marlin)
      found.tools = co_await interview.tools(most_tools);
    found.shuts_down = co_await interview.knows("M85 S0");
    found.tells_settings = co_await interview.knows("M503 S0");
    if (found.tells_settings) {
      const std::vector<std::string> lines = co_await interview.ask("M503 S0");
      found.settings = settings_in(lines);
    }
  }
  found.answer_seconds = co_await interview.answer_seconds();
  found.identity = link.identity();
  found.temperatures = link.temperatures();
  found.queues = link.queues();
  co_return found;
}

Examination examine_port(int port, const LinkOptions& options) {
  asio::io_context loop{1};
  Link link(loop.get_executor(), port, options);
  Examination found;
  std::exception_ptr failure;
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> { found = co_await examine(link, loop.get_executor(), options.clock); },
      [&](std::exception_ptr thrown) {
        failure = thrown;
        loop.stop();
      });
  loop.run();
  if (failure) std::rethrow_exception(failure);
  return found;
}

}  // namespace unicursal::host
