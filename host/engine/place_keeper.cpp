#include "host/engine/place_keeper.hpp"

#include <algorithm>
#include <utility>

#include "firmware_gcode/print/chunk.hpp"

namespace unicursal::host {

PlaceKeeper::PlaceKeeper(Link& link, Spool* spool) : link_(link), spool_(spool) {
  if (!spool_) return;
  link_.on_numbering([this](std::uint32_t number, std::uint64_t line) { take_numbering(number, line); });
}

/// Interposed lines that are on their way get their anchor from interpose().
void PlaceKeeper::take_numbering(std::uint32_t number, std::uint64_t line) {
  numbering_ = {number, line};
  const std::uint64_t handed = link_.statistics().lines;
  const std::uint64_t behind = interposing_ && handed > line ? handed - line : 0;
  const std::uint64_t place = interposing_ ? next_ : begin_ + line - interposed_;
  const bool fresh = std::exchange(first_numbering_, false) || number == 1;
  spool_->journal().anchor({number + static_cast<std::uint32_t>(behind), place}, fresh);
}

void PlaceKeeper::rejoin(const Anchor& next) {
  spool_->journal().begin_session();
  begin_ = next_ = next.place;
  first_numbering_ = false;
  spool_->journal().anchor(next, true);
  numbering_ = {next.number, 0};
}

asio::awaitable<void> PlaceKeeper::send(std::vector<std::string> lines) {
  co_await link_.send(std::move(lines));
  if (left_) co_return;
  next_ = begin_ + link_.statistics().lines - interposed_;  // a stop makes the link forget some
  record_progress();
}

/// The anchor is written before the lines are sent: a printer that asks for one of them wants the print's
/// next line.
asio::awaitable<void> PlaceKeeper::interpose(std::vector<std::string> lines) {
  gcode::keep_commands(lines);
  if (lines.empty()) co_return;
  if (on_interposed_ && !left_) on_interposed_(lines);
  const std::uint64_t before = link_.statistics().lines;
  interposed_ += lines.size();
  interposing_ = true;
  if (spool_ && !left_) {
    const std::uint64_t behind = before + lines.size() - numbering_.place;
    spool_->journal().anchor({numbering_.number + static_cast<std::uint32_t>(behind), next_}, false);
  }
  co_await link_.send(std::move(lines));
  interposing_ = false;
}

std::uint64_t PlaceKeeper::acknowledged() const {
  const std::uint64_t taken = link_.statistics().acknowledged;
  const std::uint64_t of_print = taken > interposed_ ? taken - interposed_ : 0;
  return std::min(next_, begin_ + of_print);
}

void PlaceKeeper::record_progress() {
  if (spool_ && !left_) spool_->journal().progress(next_, acknowledged());
}

void PlaceKeeper::record_way(const std::vector<std::string>& lines) {
  if (spool_) spool_->journal().park(lines);
}

void PlaceKeeper::record_aside() {
  if (spool_) spool_->journal().aside();
}

void PlaceKeeper::leave_print(const std::vector<std::string>& end) {
  record_progress();
  record_way(end);
  left_ = true;
}

void PlaceKeeper::record_end(const Ended& ended) {
  if (!spool_) return;
  record_progress();
  spool_->journal().end(ended);
}

}  // namespace unicursal::host
