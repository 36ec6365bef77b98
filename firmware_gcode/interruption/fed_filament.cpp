#include "firmware_gcode/interruption/fed_filament.hpp"

#include <charconv>
#include <cmath>
#include <numeric>

#include "firmware_gcode/sliced/words.hpp"

namespace unicursal::gcode {
namespace {

constexpr double most_filament = 1e6;  ///< mm in one move; more is damage
constexpr int most_tools = 255;        ///< of any firmware

}  // namespace

FedFilament::FedFilament(std::size_t feeders)
    : turned_(PerFeeder::zeros(feeders)), collected_(turned_), shares_(turned_) {
  choose(PerFeeder::all(feeders, 1));
}

void FedFilament::choose(const PerFeeder& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0) || !std::isfinite(sum)) return;
  shares_ = weights;
  for (double& share : shares_) share /= sum;
}

void FedFilament::feed(double e) {
  const double way = relative_ ? e : e - e_;
  if (!relative_) e_ = e;
  if (!(std::abs(way) <= most_filament)) return;
  for (std::size_t f = 0; f < turned_.size(); ++f) turned_[f] += way * shares_[f];
}

void FedFilament::run(std::string_view line) {
  const SlicedCommand command = parse_command(split_comment(line).command);
  if (command.damaged && !command.is('M', 567)) return;  // M567 has lists, which are not words
  const auto tool = [](double number) { return number >= 0 && number <= most_tools; };
  if (command.letter == 'T' && tools_.contains(command.code)) choose(tools_.at(command.code));
  if (command.letter == 'G' && command.code <= 3 && command.valued('E')) feed(command.value('E'));
  if (command.is('G', 92) && command.valued('E')) e_ = command.value('E');
  if (command.is('G', 90) || command.is('G', 91)) relative_ = command.code == 91;  // as in Marlin
  if (command.is('M', 82) || command.is('M', 83)) relative_ = command.code == 83;
  if (command.is('M', 163)) {
    const double feeder = command.value_or('S', 0);
    if (feeder >= 0 && feeder < static_cast<double>(collected_.size()))
      collected_[static_cast<std::size_t>(feeder)] = command.value_or('P', 0);
  }
  if (command.is('M', 164) && tool(command.value_or('S', -1)))
    tools_[static_cast<int>(command.value('S'))] = collected_;
  if (!command.is('M', 567)) return;
  PerFeeder shares = PerFeeder::zeros(turned_.size());
  const auto list = line.find('E');
  if (list == std::string_view::npos) return;
  line.remove_prefix(list + 1);
  for (double& share : shares) {
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), share);
    if (error != std::errc()) break;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    if (!line.starts_with(':')) break;
    line.remove_prefix(1);
  }
  choose(shares);
}

}  // namespace unicursal::gcode
