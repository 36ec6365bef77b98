// What a session keeps on disk: chunks before they are sent, and in the journal how far it has come.
#include <array>
#include <asio/co_spawn.hpp>
#include <asio/use_awaitable.hpp>

#include "host/engine/session_impl.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {

/// Lines of the session's own that are on their way get their anchor from interpose().
void Session::State::keep_journal() {
  link.on_numbering([this](std::uint32_t number, std::uint64_t line) {
    numbered = {number, line};
    const std::uint64_t handed = link.statistics().lines;
    const std::uint64_t behind = interposing && handed > line ? handed - line : 0;
    const std::uint64_t at = interposing ? place : first + line - extra;
    spool->journal().anchor({number + static_cast<std::uint32_t>(behind), at},
                            std::exchange(anew, false) || number == 1);
  });
}

void Session::State::note_progress() {
  if (!spool || parking) return;
  const std::uint64_t taken = link.statistics().acknowledged;
  const std::uint64_t own = taken > extra ? taken - extra : 0;
  spool->journal().progress(place, std::min(place, first + own));
}

void Session::State::end_journal(const StreamResult& ended) {
  note_progress();
  constexpr std::array outcomes{Outcome::completed, Outcome::stopped, Outcome::failed};
  spool->journal().end({outcomes.at(static_cast<std::size_t>(ended.ending)), ended.reason});
}

/// Strips the chunk of its comments, and spools it. Returns why it could not be done, if so.
asio::awaitable<std::string> Session::State::try_to_keep(SpooledChunk& record, gcode::Chunk& chunk) {
  if (spool) record.begun = layers_begun_in(chunk.lines);
  gcode::keep_commands(chunk.lines);
  if (!spool) co_return std::string();
  record.lines = chunk.lines;
  co_return co_await write(record);
}

/// The same; when the disk is full, the print waits until there is room. False when it was stopped meanwhile,
/// so that nothing of the chunk may be sent.
asio::awaitable<bool> Session::State::keep(SpooledChunk record, gcode::Chunk& chunk) {
  std::string problem = co_await try_to_keep(record, chunk);
  if (problem.empty()) co_return true;
  tell(SessionEvent::Kind::notice, "Error: the print waits: " + problem);
  Need room;
  room.why = problem;
  room.come = [&problem] { return problem.empty(); };
  room.look = [&]() -> asio::awaitable<void> { problem = co_await write(record); };
  co_await wait_for(room);
  co_return problem.empty();
}

/// Off the loop. Returns why it could not be done, if so.
asio::awaitable<std::string> Session::State::write(const SpooledChunk& record) {
  const Clock::Hold hold(*clock);
  const auto work = [&]() -> asio::awaitable<std::string> {
    try {
      spool->append(record);
    } catch (const SpoolFull& error) {
      co_return error.what();
    }
    co_return std::string();
  };
  co_return co_await asio::co_spawn(disk, work, asio::use_awaitable);
}

}  // namespace unicursal::host
