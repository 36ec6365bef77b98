#include "host/report/history.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/picture/hex_colour.hpp"
#include "firmware_gcode/interruption/fed_filament.hpp"
#include "host/spool/chunk_reader.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* file_name = "history";
constexpr std::size_t longest_line = 64 * 1024;  ///< characters; a longer one is damage

const char* word(LegOutcome outcome) {
  switch (outcome) {
    case LegOutcome::completed:
      return "completed";
    case LegOutcome::stopped:
      return "stopped";
    case LegOutcome::failed:
      break;
  }
  return "failed";
}

/// What the printer turned for the print's lines before `end`.
gcode::PerFeeder turned(const fs::path& chunks, std::uint64_t end, std::size_t feeders) {
  gcode::FedFilament fed(feeders);
  ChunkReader reader(chunks);
  while (const std::optional<SpooledChunk> chunk = reader.next()) {
    std::uint64_t number = reader.first_line();
    for (const std::string& line : chunk->lines) {
      if (number++ >= end) return fed.turned();
      fed.run(line);
    }
  }
  return fed.turned();
}

json filament_json(const Filament& filament, const FilamentAmount& amount) {
  json one = to_json(amount);
  one["name"] = filament.name;
  one["material"] = filament.material;
  one["colour"] = picture::hex_of(filament.colour);
  return one;
}

json line_for(const Spool& spool, const Profile& profile, const JournalState& state) {
  const gcode::Printer& printer = profile.printer;
  const gcode::PerFeeder lengths = turned(spool.chunks(), state.furthest, printer.feeders);
  const double area = std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter;
  json filaments = json::array();
  for (std::size_t f = 0; f < printer.feeders; ++f) {
    const double volume = lengths[f] * area / printer.flow_factors[f];
    if (volume <= 0) continue;
    const Filament& filament = profile.filaments.of_feeders[f];
    filaments.push_back(filament_json(filament, amount_of(volume, filament)));
  }
  return {{"print", spool.folder().filename().string()},
          {"ended", state.ended ? word(state.ended->outcome) : "failed"},
          {"currency", profile.filaments.currency},
          {"filaments", filaments}};
}

PastPrint print_in(const std::string& line) {
  const json object = json::parse(line);
  PastPrint print{object.at("print"), object.at("ended"), object.at("currency"), {}};
  for (const json& one : object.at("filaments")) {
    PastFilament filament{one.at("name"), one.at("material"), one.at("colour"), {}};
    filament.amount.metres = one.at("metres");
    filament.amount.grams = one.at("grams");
    if (one.contains("cost")) filament.amount.cost = one.at("cost").get<double>();
    print.filaments.push_back(std::move(filament));
  }
  return print;
}

}  // namespace

void note_in_history(Spool& spool, const Profile& profile) noexcept {
  try {
    spool.journal().sync();
    const JournalState state = read_journal(spool.folder() / "journal");
    if (!state.connected || state.furthest == 0) return;
    const json line = line_for(spool, profile, state);
    std::ofstream file(spool.folder().parent_path() / file_name, std::ios::app);
    // One piece, so that two programs do not mix their lines.
    const std::string text = line.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
  } catch (...) {
    // The print is over, and its part is on the bed.
  }
}

std::vector<PastPrint> history(const fs::path& root) {
  std::vector<PastPrint> prints;
  std::ifstream file(root / file_name);
  for (std::string line; std::getline(file, line);) {
    if (line.size() > longest_line) continue;
    try {
      PastPrint print = print_in(line);
      std::erase_if(prints, [&](const PastPrint& before) { return before.name == print.name; });
      prints.push_back(std::move(print));
    } catch (const json::exception&) {
      continue;
    }
  }
  return prints;
}

}  // namespace unicursal::host
