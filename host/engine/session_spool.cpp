// A session's chunks on disk: each is kept before its first line is sent.
#include <asio/co_spawn.hpp>
#include <asio/use_awaitable.hpp>

#include "host/engine/line_follower.hpp"
#include "host/engine/session_impl.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {

/// Takes the comments out of the chunk and spools it. Returns why that failed, or an empty string.
asio::awaitable<std::string> Session::State::try_to_spool(SpooledChunk& record, gcode::Chunk& chunk) {
  const bool kept = spool || settings.follower;
  if (kept) record.begun = layers_begun_in(chunk.lines);
  gcode::keep_commands(chunk);
  if (!kept) co_return std::string();
  record.lines = chunk.lines;
  record.mixtures = chunk.mixtures;
  if (!spool) co_return std::string();
  co_return co_await write(record);
}

/// The same; when the disk is full, the print waits until there is room. Returns false if it was stopped
/// meanwhile: then no line of the chunk may be sent.
asio::awaitable<bool> Session::State::spool_chunk(SpooledChunk record, gcode::Chunk& chunk) {
  std::string problem = co_await try_to_spool(record, chunk);
  if (problem.empty() && settings.follower) settings.follower->chunk_kept(record, chunk);
  if (problem.empty()) co_return true;
  announcer.notice("Error: the print waits: " + problem);
  Need room;
  room.why = problem;
  room.come = [&problem] { return problem.empty(); };
  room.look = [&]() -> asio::awaitable<void> { problem = co_await write(record); };
  co_await holding.wait_for(room);
  if (problem.empty() && settings.follower) settings.follower->chunk_kept(record, chunk);
  co_return problem.empty();
}

/// Writes on another thread. Returns why that failed, or an empty string.
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
