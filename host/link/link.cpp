#include "host/link/link.hpp"

#include <fcntl.h>

#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <cassert>

#include "host/link/state.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t longest_command = 80;  ///< Bytes; at most 95 with number and checksum.

/// Returns why a line cannot be sent; empty if it can.
std::string defect(const std::string& line) {
  if (line.empty()) return "it is empty, and the printer would not acknowledge it";
  if (line.size() > longest_command) return "it is longer than 80 characters";
  for (char c : line) {
    if (c < ' ' || c > '~') return "it holds a byte that is not printable ASCII";
    if (c == ';' || c == '*') return "it holds a comment or a checksum";
  }
  if (line.front() == 'N' || line.front() == ' ') return "it begins with a line number or a space";
  if (line.starts_with("M110")) return "it would change the line number";
  return {};
}

}  // namespace

Link::Link(asio::any_io_executor executor, int descriptor, LinkOptions options)
    : state_(std::make_shared<LinkState>(std::move(executor), descriptor, options)) {}

Link::~Link() {
  if (state_) state_->close();
}

Link::Link(Link&&) noexcept = default;

asio::awaitable<void> Link::connect() {
  const auto state = state_;
  asio::co_spawn(state->executor, state->listen(state), asio::detached);
  co_await state->greet();
  asio::co_spawn(state->executor, state->supervise(state), asio::detached);
}

asio::awaitable<Rejoined> Link::rejoin(std::uint32_t beyond) {
  const auto state = state_;
  asio::co_spawn(state->executor, state->listen(state), asio::detached);
  co_return co_await state->find_again(beyond);
}

void Link::go_on(std::uint32_t next) {
  state_->go_on(next);
  asio::co_spawn(state_->executor, state_->supervise(state_), asio::detached);
}

asio::awaitable<void> Link::send(std::vector<std::string> lines) {
  const auto state = state_;
  assert(state->phase == LinkState::Phase::streaming || state->failure);
  for (const std::string& line : lines) {
    if (const std::string why = defect(line); !why.empty()) {
      throw std::invalid_argument("the line \"" + line + "\" cannot be sent: " + why);
    }
  }
  state->statistics.lines += lines.size();
  for (std::string& line : lines) state->ledger.push(std::move(line));
  state->pump();
  state->signal.notify();  // the time by which an answer is due has changed
  const std::function<bool()> written = [state] { return state->ledger.all_written(); };
  co_await state->until(written);
}

asio::awaitable<void> Link::drain() {
  const auto state = state_;
  assert(state->phase == LinkState::Phase::streaming || state->failure);
  state->draining = true;
  const std::function<bool()> settled = [state] { return state->settled(); };
  state->signal.notify();
  co_await state->until(settled);
  state->draining = false;
}

asio::awaitable<void> Link::until_failure() {
  const auto state = state_;
  const std::function<bool()> never = [] { return false; };
  co_await state->until(never);
}

int Link::take_port() {
  const int descriptor = ::fcntl(state_->port.native_handle(), F_DUPFD_CLOEXEC, 0);
  state_->close();
  return descriptor;
}

void Link::cool_down() noexcept {
  state_->cool_down();
}

bool Link::waits_for_user() const {
  return state_->waits_for_user;
}

void Link::end_wait_for_user() noexcept {
  state_->end_wait_for_user();
}

void Link::answer_prompt(std::size_t button) noexcept {
  state_->answer_prompt(button);
}

bool Link::cut_wait_short() const {
  return state_->cut_wait_short;
}

void Link::emergency_stop() noexcept {
  state_->emergency_stop();
}

const LinkStatistics& Link::statistics() const {
  return state_->statistics;
}

const std::string& Link::firmware() const {
  return state_->firmware;
}

const gcode::Identity& Link::identity() const {
  return state_->identity;
}

const gcode::Temperatures& Link::temperatures() const {
  return state_->temperatures;
}

const std::optional<PrinterQueues>& Link::queues() const {
  return state_->queues;
}

void Link::on_numbering(std::function<void(std::uint32_t, std::uint64_t)> listener) {
  state_->numbering = std::move(listener);
}

void Link::on_message(std::function<void(const std::string&)> listener) {
  state_->listener = std::move(listener);
}

}  // namespace unicursal::host
