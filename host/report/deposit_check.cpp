#include "host/report/deposit_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace unicursal::host {
namespace {

constexpr std::size_t most_worst = 3;

/// Removes old pictures: a longer print may have left more layers than this one has.
void remove_old_pictures(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool ours = name.starts_with("gaps-") || name.starts_with("mixtures-");
    if (ours && name.ends_with(".png")) old.push_back(entry.path());
  }
  for (const auto& file : old) std::filesystem::remove(file);
}

/// mm³
double laid_at_all(const sim::RasterFrame& frame, const RowSource& rows) {
  double fill = 0;
  std::vector<sim::RasterPixel> row(frame.columns);
  for (std::uint64_t r = 0; r < frame.rows; ++r) {
    rows(row);
    for (const sim::RasterPixel& pixel : row) fill += pixel.fill;
  }
  return fill * frame.pixel_area() * frame.height;
}

}  // namespace

DepositCheck::DepositCheck(std::vector<IntendedMaterial> materials,
                           std::optional<std::filesystem::path> pictures, const picture::Filaments& filaments)
    : materials_(std::move(materials)), pictures_(std::move(pictures)), filaments_(filaments) {
  if (pictures_) remove_old_pictures(*pictures_);
}

DepositCheck::~DepositCheck() {
  finish();
}

void DepositCheck::watch(int descriptor) {
  thread_ = std::thread([this, descriptor] { read_all(descriptor); });
}

void DepositCheck::expect(TargetLayer target) {
  const std::lock_guard lock(mutex_);
  expected_.push_back(std::move(target));
}

void DepositCheck::finish() {
  if (thread_.joinable()) thread_.join();
}

void DepositCheck::read_all(int descriptor) {
  sim::RasterReader reader(descriptor);
  try {
    while (const auto frame = reader.next()) take(*frame, reader);
  } catch (const std::exception& error) {
    // Closing the stream lets the simulator continue.
    problem_ = std::string("what was laid could not be judged to the end: ") + error.what();
  }
}

void DepositCheck::take(const sim::RasterFrame& frame, sim::RasterReader& reader) {
  const auto rows = [&reader](std::span<sim::RasterPixel> pixels) { reader.read_row(pixels); };
  const std::optional<TargetLayer> target = target_at(frame.z);
  if (!target || target->zones.empty()) {
    total_.outside += laid_at_all(frame, rows);
    return;
  }
  JudgedLayer layer = judge(*target, frame, rows, materials_, pictures_.has_value(), filaments_);
  if (pictures_) write_pictures(*target, layer);
  worst_.insert(worst_.end(), layer.worst.begin(), layer.worst.end());
  layers_[target->index] += layer.findings;
  total_ += layer.findings;
}

/// Returns the planned layer at that height and forgets those below, since the printer goes upwards.
std::optional<TargetLayer> DepositCheck::target_at(double z) {
  const std::lock_guard lock(mutex_);
  const auto here = std::find_if(expected_.begin(), expected_.end(), [z](const TargetLayer& target) {
    return std::abs(target.top - z) < target.height / 4;
  });
  if (here == expected_.end()) return std::nullopt;
  TargetLayer target = std::move(*here);
  expected_.erase(expected_.begin(), here + 1);
  return target;
}

void DepositCheck::write_pictures(const TargetLayer& target, const JudgedLayer& layer) {
  picture::write_png(*pictures_ / fmt::format("gaps-{:04}.png", target.index), *layer.gaps);
  picture::write_png(*pictures_ / fmt::format("mixtures-{:04}.png", target.index), *layer.mixtures);
  drawn_[target.index] = {target.top, target.height, layer.place};
}

std::vector<WorstPlace> DepositCheck::worst() const {
  return choose_worst(worst_, most_worst);
}

nlohmann::json DepositCheck::to_json() const {
  nlohmann::json layers = nlohmann::json::array();
  for (const auto& [index, findings] : layers_) {
    nlohmann::json layer = host::to_json(findings);
    layer["layer"] = index;
    layers.push_back(std::move(layer));
  }
  nlohmann::json worst_places = nlohmann::json::array();
  for (const WorstPlace& place : worst()) worst_places.push_back(host::to_json(place));
  nlohmann::json report = {{"layers", layers}, {"total", host::to_json(total_)}, {"worst", worst_places}};
  if (problem_) report["problem"] = *problem_;
  return report;
}

}  // namespace unicursal::host
