#include "host/daemon/live_json.hpp"

#include <bit>
#include <cmath>

#include "core/picture/hex_colour.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

double rounded(double value, double steps) {
  return std::round(value * steps) / steps;
}

json shares_of(const NamedMixture& mixture) {
  json shares = json::array();
  for (const double share : mixture.shares) shares.push_back(rounded(share, 1000));
  return shares;
}

json named(const NamedMixture& mixture, const char* name) {
  return {{name, mixture.name}, {"shares", shares_of(mixture)}, {"colour", picture::hex_of(mixture.colour)}};
}

void put32(std::string& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(value >> shift & 0xff));
}

}  // namespace

json to_json(const LiveOverview& overview) {
  json filaments = json::array(), mixtures = json::array(), known = json::array();
  for (const NamedMixture& one : overview.filaments)
    filaments.push_back({{"name", one.name}, {"colour", picture::hex_of(one.colour)}});
  for (const NamedMixture& one : overview.mixtures) mixtures.push_back(named(one, "name"));
  for (const KnownLayer& one : overview.known) known.push_back(to_json(one));
  return {{"layers", overview.layers}, {"filaments", filaments}, {"mixtures", mixtures}, {"known", known}};
}

json to_json(const KnownLayer& layer) {
  return {{"layer", layer.layer},
          {"top", rounded(layer.top, 1000)},
          {"beads", layer.beads},
          {"complete", layer.complete},
          {"planned", layer.planned}};
}

json to_json(const LiveNozzle& nozzle) {
  json now = {{"bead", nozzle.bead},
              {"at", {rounded(nozzle.at.x(), 100), rounded(nozzle.at.y(), 100)}},
              {"z", rounded(nozzle.z, 1000)},
              {"fed", named(nozzle.fed, "name")},
              {"leaving", named(nozzle.leaving, "nearest")}};
  if (nozzle.layer) now["layer"] = *nozzle.layer;
  if (nozzle.change) {
    now["change"] = {{"seconds", rounded(nozzle.change->seconds, 10)},
                     {"name", nozzle.change->to.name},
                     {"colour", picture::hex_of(nozzle.change->to.colour)}};
  }
  return now;
}

std::string to_bytes(const PathPiece& piece) {
  constexpr std::int32_t micrometres = 10;  ///< of a step
  std::string bytes = "UCL1";
  put32(bytes, static_cast<std::uint32_t>(piece.layer));
  put32(bytes, static_cast<std::uint32_t>(piece.first));
  put32(bytes, static_cast<std::uint32_t>(piece.records.size() / LaidPath::record));
  put32(bytes, static_cast<std::uint32_t>(piece.begin.x * micrometres));
  put32(bytes, static_cast<std::uint32_t>(piece.begin.y * micrometres));
  put32(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(piece.top)));
  bytes.push_back(static_cast<char>((piece.complete ? 1 : 0) | (piece.planned ? 2 : 0)));
  bytes.push_back(static_cast<char>(piece.revision));
  bytes.append(2, '\0');
  return bytes + piece.records;
}

}  // namespace unicursal::host
