#include "host/live/live_line.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "host/live/line_run.hpp"
#include "host/lookahead/low_priority.hpp"
#include "host/spool/chunk_reader.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t lines_at_once = 256;  ///< that are read while nobody else can look

/// Moves that a printer's queue takes: BLOCK_BUFFER_SIZE of Marlin less one, PRINTLINE_CACHE_SIZE of
/// Repetier, the ring of RepRapFirmware 3 (DdaRingLength of a Duet 2).
std::size_t longest_queue_of(const std::string& firmware) {
  if (firmware == "reprapfirmware") return 40;
  return firmware == "repetier" ? 16 : 15;
}

/// Whether a line of the session's own changes what the nozzle does.
bool changes_feed(const std::string& line) {
  constexpr std::array words{"G0 ", "G1 ", "G9", "M221", "T", "M163", "M164", "M567", "M82", "M83"};
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return line.starts_with(word); });
}

std::uint8_t number_asked_for(std::size_t material) {
  return static_cast<std::uint8_t>(std::min<std::size_t>(material, LaidPath::nothing_asked));
}

LineBatch batch_of(const SpooledChunk& kept, const gcode::Chunk* made) {
  LineBatch batch;
  std::size_t bytes = 0;
  for (const std::string& line : kept.lines) bytes += line.size();
  batch.text.reserve(bytes);
  batch.ends.reserve(kept.lines.size());
  for (const std::string& line : kept.lines) {
    batch.text += line;
    batch.ends.push_back(static_cast<std::uint32_t>(batch.text.size()));
  }
  batch.begun = kept.begun;
  batch.mixtures = kept.mixtures;
  batch.ends_layer = kept.kind == SpooledChunk::Kind::rest || kept.kind == SpooledChunk::Kind::finish;
  if (!made) return batch;
  batch.asked = made->asked;
  batch.seconds = made->seconds;
  return batch;
}

}  // namespace

struct LiveLine::State {
  explicit State(LiveSubject of);

  struct Chunk {
    LineBatch batch;
    gcode::PlacedLayer planned;  ///< what the encoder was given besides; without paths if there is none
  };
  struct Interposed {
    std::vector<std::string> lines;
    std::uint64_t line = 0;
  };
  using Work = std::variant<Chunk, Interposed>;

  void give(Work work);
  void work(const std::stop_token& stop);
  void read_kept(const std::stop_token& stop);
  void take(Chunk chunk, const std::stop_token& stop);
  void take(Interposed interposed, const std::stop_token& stop);
  void make_room();
  void run(const std::stop_token& stop);
  void plan(const gcode::PlacedLayer& layer);
  std::optional<LaidPath> planned_path(const gcode::PlacedLayer& layer) const;
  gcode::Shares asked_at(std::size_t material, const core::Vec2& place, double z) const;
  NamedMixture named(std::string name, const gcode::Shares& shares) const;
  std::string nearest(const gcode::Shares& shares) const;
  NamedMixture leaving(const LineTable::Where& where) const;

  const LiveSubject subject;
  const picture::Filaments colours;
  std::atomic<std::uint64_t> executed = 0;
  std::atomic<bool> up_to_date = false;  ///< the spool has been read

  mutable std::mutex mutex;  ///< of what follows
  LiveLayers layers;
  LineTable table;
  LineRun lines;

  mutable std::mutex work_mutex;  ///< of what follows
  mutable std::condition_variable_any wake;
  std::deque<Work> waiting;
  bool busy = true;

  std::jthread thread;  ///< the last member: it uses the others
};

LiveLine::State::State(LiveSubject of)
    : subject(std::move(of)),
      colours(subject.filaments.colours()),
      layers(subject.folder),
      table(longest_queue_of(subject.printer.firmware)),
      lines(subject.printer, colours, layers, table),
      thread([this](const std::stop_token& stop) { work(stop); }) {}

void LiveLine::State::give(Work work) {
  {
    const std::lock_guard lock(work_mutex);
    waiting.push_back(std::move(work));
    busy = true;
  }
  wake.notify_all();
}

void LiveLine::State::work(const std::stop_token& stop) {
  lower_priority();
  if (subject.kept) read_kept(stop);
  up_to_date = true;
  while (!stop.stop_requested()) {
    std::optional<Work> next;
    {
      std::unique_lock lock(work_mutex);
      busy = !waiting.empty();
      if (!busy) wake.notify_all();
      wake.wait(lock, stop, [this] { return !waiting.empty(); });
      if (waiting.empty()) continue;
      next = std::move(waiting.front());
      waiting.pop_front();
    }
    std::visit([&](auto& work) { take(std::move(work), stop); }, *next);
  }
}

/// A spool that cannot be read any more leaves the layers unknown; the session will say why.
void LiveLine::State::read_kept(const std::stop_token& stop) {
  const LiveSubject::Kept& kept = *subject.kept;
  executed = std::min(kept.executed, kept.leg.begins_at);
  try {
    ChunkReader reader(kept.chunks);
    for (std::size_t i = 0; i < kept.count && !stop.stop_requested(); ++i) {
      std::optional<SpooledChunk> chunk = reader.next();
      if (!chunk) break;
      take(Chunk{batch_of(*chunk, nullptr), std::move(chunk->layer)}, stop);
    }
  } catch (const core::DataError&) {
    return;
  }
  if (!kept.leg.lead_in.empty()) take(Interposed{kept.leg.lead_in, kept.leg.begins_at}, stop);
  executed = kept.executed;
}

void LiveLine::State::take(Chunk chunk, const std::stop_token& stop) {
  plan(chunk.planned);
  {
    const std::lock_guard lock(mutex);
    const std::uint64_t done = executed;
    lines.drop_before(done);
    lines.append(std::move(chunk.batch));
  }
  make_room();
  run(stop);
}

/// Only this thread changes layers; others may look at them while one is written to the disk.
void LiveLine::State::make_room() {
  for (;;) {
    std::unique_lock lock(mutex);
    const auto next = layers.next_to_move(lines.first_open_layer());
    if (!next) return;
    lock.unlock();
    const auto offset = layers.write_out(*next);
    lock.lock();
    layers.moved(*next, offset);
  }
}

void LiveLine::State::take(Interposed interposed, const std::stop_token& stop) {
  {
    const std::lock_guard lock(mutex);
    lines.interpose(interposed.lines, interposed.line);
  }
  run(stop);
}

void LiveLine::State::run(const std::stop_token& stop) {
  for (bool more = true; more && !stop.stop_requested();) {
    const std::lock_guard lock(mutex);
    more = lines.run(lines_at_once);
  }
}

gcode::Shares LiveLine::State::asked_at(std::size_t material, const core::Vec2& place, double z) const {
  const gcode::Material& of = subject.asked.materials.at(material);
  gcode::Shares shares = of.mixture.shares();
  if (!of.gradient) return shares;
  const double part = of.gradient->part_at(place, z);
  for (std::size_t f = 0; f < shares.size(); ++f) shares[f] += part * (of.gradient->to.share(f) - shares[f]);
  return shares;
}

/// Most layers are known from the look-ahead when their chunk comes.
void LiveLine::State::plan(const gcode::PlacedLayer& layer) {
  {
    const std::lock_guard lock(mutex);
    if (layers.knows(layer.index)) return;
  }
  std::optional<LaidPath> path = planned_path(layer);
  if (!path) return;
  const std::lock_guard lock(mutex);
  if (!layers.knows(layer.index)) layers.plan(layer.index, layer.top, std::move(*path));
}

/// The layer's beads in the order in which they were planned, in the colours asked for.
std::optional<LaidPath> LiveLine::State::planned_path(const gcode::PlacedLayer& layer) const {
  std::optional<LaidPath> path;
  std::optional<gcode::Shares> coloured;
  picture::Colour colour;
  for (const core::BeadPath& beads : layer.paths) {
    if (beads.size() == 0) continue;
    if (!path)
      path.emplace(beads.start(0));
    else
      path->travel(beads.start(0));
    for (std::size_t i = 0; i < beads.size(); ++i) {
      const std::size_t zone = beads.beads[i].zone;
      if (zone >= subject.asked.zone_materials.size()) return std::nullopt;
      const std::size_t material = subject.asked.zone_materials[zone];
      const core::Vec2 middle = (beads.start(i) + beads.end(i)) / 2;
      const gcode::Shares shares = asked_at(material, middle, layer.top - layer.height / 2);
      if (coloured != shares) colour = picture::colour_of({shares.begin(), shares.size()}, colours);
      coloured = shares;
      path->lay(beads.end(i), beads.width(i), number_asked_for(material), colour);
    }
  }
  return path;
}

NamedMixture LiveLine::State::named(std::string name, const gcode::Shares& shares) const {
  return {std::move(name), shares, picture::colour_of({shares.begin(), shares.size()}, colours)};
}

std::string LiveLine::State::nearest(const gcode::Shares& shares) const {
  const auto farther = [&](const gcode::Material& a, const gcode::Material& b) {
    return gcode::squared_distance(a.mixture.shares(), shares) <
           gcode::squared_distance(b.mixture.shares(), shares);
  };
  const auto& materials = subject.asked.materials;
  const auto found = std::min_element(materials.begin(), materials.end(), farther);
  return found == materials.end() ? "" : found->name;
}

NamedMixture LiveLine::State::leaving(const LineTable::Where& where) const {
  const gcode::Shares shares = table.leaving(where, subject.printer.feeders);
  return named(nearest(shares), shares);
}

// ---- the public functions

LiveLine::LiveLine(LiveSubject subject) : state_(std::make_unique<State>(std::move(subject))) {}
LiveLine::~LiveLine() = default;

void LiveLine::chunk_kept(const SpooledChunk& kept, const gcode::Chunk& made) {
  state_->give(State::Chunk{batch_of(kept, &made), kept.layer});
}

void LiveLine::layer_planned(const gcode::PlacedLayer& layer) {
  state_->plan(layer);
}

void LiveLine::interposed(const std::vector<std::string>& lines, std::uint64_t line) {
  if (std::any_of(lines.begin(), lines.end(), changes_feed)) state_->give(State::Interposed{lines, line});
}

void LiveLine::executed(std::uint64_t line) {
  if (state_->up_to_date) state_->executed = line;
}

LiveOverview LiveLine::overview() const {
  const State& s = *state_;
  LiveOverview overview;
  overview.layers = s.subject.layers;
  for (std::size_t f = 0; f < s.subject.printer.feeders; ++f) {
    gcode::Shares pure = gcode::Shares::zeros(s.subject.printer.feeders);
    pure[f] = 1;
    overview.filaments.push_back(
        {s.subject.filaments.of_feeders.at(f).name, pure, s.subject.filaments.of_feeders.at(f).colour});
  }
  for (const gcode::Material& material : s.subject.asked.materials)
    overview.mixtures.push_back(s.named(material.name, material.mixture.shares()));
  const std::lock_guard lock(s.mutex);
  overview.known = s.layers.known();
  return overview;
}

std::optional<PathPiece> LiveLine::path(std::size_t layer, std::size_t from) const {
  std::optional<LiveLayers::Found> found;
  {
    const std::lock_guard lock(state_->mutex);
    found = state_->layers.find(layer);
  }
  if (!found) return std::nullopt;
  return state_->layers.piece(std::move(*found), from);
}

std::optional<PathPiece> LiveLine::plan(std::size_t layer) const {
  const std::lock_guard lock(state_->mutex);
  return state_->layers.plan_of(layer);
}

std::optional<LiveNozzle> LiveLine::nozzle(const LinePlace& place, TimePoint now, double speed) {
  State& s = *state_;
  if (!s.up_to_date) return std::nullopt;
  const std::lock_guard lock(s.mutex);
  const auto where = s.table.look(place, now, speed);
  if (!where) return std::nullopt;
  const LineStep& step = *where->step;
  LiveNozzle nozzle;
  if (step.layer != LineStep::no_layer) nozzle.layer = step.layer;
  nozzle.bead = step.first_bead;
  if (step.beads > 0)
    nozzle.bead += std::min<std::size_t>(static_cast<std::size_t>(where->part * step.beads), step.beads - 1);
  const core::Vec2 to(static_cast<double>(step.x), static_cast<double>(step.y));
  const core::Vec2 from =
      where->before ? core::Vec2(static_cast<double>(where->before->x), static_cast<double>(where->before->y))
                    : to;
  nozzle.at = from + (to - from) * where->part;
  nozzle.z = static_cast<double>(step.z);
  const auto fed = [&s](std::uint16_t number) {
    const FedMixture& one = s.lines.fed().at(number);
    return s.named(one.name, one.shares);
  };
  nozzle.fed = s.lines.fed().empty() ? s.leaving(*where) : fed(step.fed);
  nozzle.leaving = s.leaving(*where);
  if (const auto change = s.table.next_change(speed))
    nozzle.change = LiveNozzle::Change{change->seconds, fed(change->fed)};
  return nozzle;
}

std::vector<KnownLayer> LiveLine::take_changed() {
  const std::lock_guard lock(state_->mutex);
  return state_->layers.take_changed();
}

void LiveLine::wait() const {
  std::unique_lock lock(state_->work_mutex);
  state_->wake.wait(lock, [this] { return !state_->busy; });
}

}  // namespace unicursal::host
