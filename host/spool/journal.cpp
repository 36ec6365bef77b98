#include "host/spool/journal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "host/spool/bytes.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

/// A power cut can hit printer and computer at once; the journal is then at most this old.
constexpr auto sync_interval = 1s;
constexpr std::uint64_t reserve = 1 << 16;  ///< Bytes reserved for writing events on a full disk.
constexpr std::int64_t repetier_modulus = 65536;
constexpr std::uint64_t most_lines = 1'000'000'000'000;  ///< Lines of one print; more means damage.

/// First byte of a record. The numbers belong to the format and never change their meaning.
enum class Event : std::uint8_t { session = 1, leg, anchor, progress, park, end, superseded, aside };

ByteWriter event(Event what) {
  ByteWriter bytes;
  bytes.put(static_cast<std::uint8_t>(what));
  return bytes;
}

void put(ByteWriter& bytes, const std::vector<std::string>& lines) {
  bytes.put(static_cast<std::uint32_t>(lines.size()));
  for (const std::string& line : lines) bytes.put(std::string_view(line));
}

std::vector<std::string> lines_in(ByteReader& bytes) {
  std::vector<std::string> lines(bytes.count(4));
  for (std::string& line : lines) line = bytes.text();
  return lines;
}

std::uint64_t place_in(ByteReader& bytes) {
  const auto place = bytes.take<std::uint64_t>();
  if (place > most_lines) throw DamagedBytes("names a line that no print can have");
  return place;
}

Leg leg_in(ByteReader& bytes) {
  Leg leg;
  leg.begins_at = place_in(bytes);
  leg.height = bytes.number();
  if (!std::isfinite(leg.height)) throw DamagedBytes("holds a height that is not a number");
  leg.lead_in = lines_in(bytes);
  return leg;
}

void begin(JournalState& state, Leg leg) {
  JournalState next;
  next.legs = state.legs + 1;
  next.leg = std::move(leg);
  next.given_up = std::move(state.given_up);
  if (state.legs > 0) next.given_up.push_back({std::move(state.leg), state.acknowledged});
  next.connected = state.connected;
  next.furthest = state.furthest;
  state = std::move(next);
}

Ended ended_in(ByteReader& bytes) {
  const auto outcome = bytes.take<std::uint8_t>();
  if (outcome > static_cast<std::uint8_t>(LegOutcome::failed)) throw DamagedBytes("holds an unknown outcome");
  return {static_cast<LegOutcome>(outcome), bytes.text()};
}

void apply(JournalState& state, ByteReader bytes) {
  switch (static_cast<Event>(bytes.take<std::uint8_t>())) {
    case Event::session:
      state.ended.reset();
      break;
    case Event::leg:
      begin(state, leg_in(bytes));
      break;
    case Event::anchor: {
      if (bytes.take<std::uint8_t>() != 0) state.anchors.clear();
      const auto number = bytes.take<std::uint32_t>();
      state.anchors.push_back({number, place_in(bytes)});
      state.connected = true;
      break;
    }
    case Event::progress:
      state.handed = place_in(bytes);
      state.acknowledged = place_in(bytes);
      state.furthest = std::max(state.furthest, state.leg.line(state.handed));
      break;
    case Event::park:
      state.parking = lines_in(bytes);
      state.aside = false;
      break;
    case Event::aside:
      state.aside = true;
      break;
    case Event::end:
      state.ended = ended_in(bytes);
      break;
    case Event::superseded:
      state.superseded = true;
      state.superseded_by = bytes.text();
      break;
    default:
      throw DamagedBytes("holds an event that this version does not know");
  }
  if (!bytes.empty()) throw DamagedBytes("holds more than it should");
}

/// Of the numbers that `number`, perhaps modulo 65536, can mean: the one nearest to `expected`.
std::int64_t nearest_line(std::uint32_t number, std::int64_t expected) {
  std::int64_t best = number;
  if (number >= repetier_modulus) return best;
  const std::int64_t turns = (expected - number + repetier_modulus / 2) / repetier_modulus;
  const std::int64_t other = number + turns * repetier_modulus;
  return other >= 0 && std::abs(other - expected) < std::abs(best - expected) ? other : best;
}

}  // namespace

std::optional<std::uint64_t> JournalState::place_of(std::uint32_t number) const {
  if (anchors.empty()) return std::nullopt;
  const Anchor& last = anchors.back();
  const std::int64_t expected =
      last.number + static_cast<std::int64_t>(handed) - static_cast<std::int64_t>(last.place);
  const std::int64_t meant = nearest_line(number, expected);
  const auto after = std::find_if(anchors.begin(), anchors.end(),
                                  [&](const Anchor& anchor) { return anchor.number > meant; });
  if (after == anchors.begin()) return std::nullopt;
  const Anchor& anchor = *std::prev(after);
  const std::uint64_t place = anchor.place + static_cast<std::uint64_t>(meant - anchor.number);
  // Numbers just before an anchor may belong to lines that are not part of the leg.
  return after == anchors.end() ? place : std::min(place, after->place);
}

JournalState read_journal(const std::filesystem::path& file, std::uint64_t* sound) {
  RecordReader reader(file);
  JournalState state;
  try {
    while (const auto content = reader.next()) apply(state, ByteReader(*content));
  } catch (const DamagedBytes& error) {
    throw SpoolError(file.string(), "byte " + std::to_string(reader.sound()), error.what(),
                     "resume with the version of this program that the print was begun with");
  }
  if (reader.damaged_within(static_cast<unsigned char>(Event::aside))) {
    throw SpoolError(
        file.string(), "byte " + std::to_string(reader.sound()),
        fmt::format("is damaged, and more was written behind the damage; up to there the printer had "
                    "taken {} lines, but it has gone on since",
                    state.leg.line(state.acknowledged)),
        "clear the bed, and print the job again from the beginning");
  }
  if (sound) *sound = reader.sound();
  return state;
}

Journal::Journal(const std::filesystem::path& file, std::uint64_t sound)
    : writer_(file, sound, reserve), thread_([this](std::stop_token stop) { work(std::move(stop)); }) {}

Journal::~Journal() = default;

/// Returns false if there was no room.
bool Journal::append(const std::string& content) {
  try {
    writer_.append(content);
    unsynced_ = true;
    return true;
  } catch (const SpoolFull& error) {
    problem_ = error.what();
    return false;
  }
}

/// Progress for which there was no room is kept for sync(), which reports that.
void Journal::write_latest() {
  if (const auto last = std::exchange(latest_, std::nullopt)) {
    const bool written = append(event(Event::progress).put(last->handed).put(last->acknowledged).bytes());
    if (!written)
      unwritten_ = last;
    else
      unwritten_.reset();
  }
}

void Journal::write_now(const std::string& content) {
  {
    const std::lock_guard lock(mutex_);
    write_latest();
    append(content);
  }
  wake_.notify_one();
}

void Journal::begin_session() {
  write_now(event(Event::session).bytes());
}

void Journal::begin_leg(const Leg& leg) {
  ByteWriter bytes = event(Event::leg);
  bytes.put(leg.begins_at).put(leg.height);
  put(bytes, leg.lead_in);
  write_now(bytes.bytes());
}

void Journal::anchor(const Anchor& anchor, bool restarts) {
  write_now(event(Event::anchor)
                .put(static_cast<std::uint8_t>(restarts))
                .put(anchor.number)
                .put(anchor.place)
                .bytes());
}

void Journal::park(const std::vector<std::string>& lines) {
  ByteWriter bytes = event(Event::park);
  put(bytes, lines);
  write_now(bytes.bytes());
}

void Journal::aside() {
  write_now(event(Event::aside).bytes());
}

void Journal::end(const Ended& ended) {
  write_now(event(Event::end)
                .put(static_cast<std::uint8_t>(ended.outcome))
                .put(std::string_view(ended.reason))
                .bytes());
}

void Journal::supersede(const std::string& by) {
  write_now(event(Event::superseded).put(std::string_view(by)).bytes());
}

void Journal::sync() {
  const std::lock_guard lock(mutex_);
  if (const auto last = latest_ ? latest_ : unwritten_) {
    writer_.append(event(Event::progress).put(last->handed).put(last->acknowledged).bytes());
    latest_.reset();
    unwritten_.reset();
  }
  writer_.sync();
}

void Journal::progress(std::uint64_t handed, std::uint64_t acknowledged) {
  {
    const std::lock_guard lock(mutex_);
    latest_ = {handed, acknowledged};
  }
  wake_.notify_one();
}

std::optional<std::string> Journal::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

/// Releases the lock while it syncs, which takes long on a memory card.
void Journal::work(std::stop_token stop) {
  std::unique_lock lock(mutex_);
  auto due = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    wake_.wait(lock, stop, [&] { return latest_ || unsynced_; });
    write_latest();
    if (!unsynced_) continue;
    if (std::chrono::steady_clock::now() < due) {
      wake_.wait_until(lock, stop, due, [&] { return latest_.has_value(); });
      if (latest_) continue;
    }
    unsynced_ = false;
    lock.unlock();
    try {
      writer_.sync();
    } catch (const SpoolFull&) {
      // The system has the record; this program cannot do more to bring it to the disk.
    }
    lock.lock();
    due = std::chrono::steady_clock::now() + sync_interval;
  }
  write_latest();
}

}  // namespace unicursal::host
