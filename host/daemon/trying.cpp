// The daemon's dry runs: which job, and whether the print that goes on can spare the processor.
#include "host/daemon/daemon.hpp"
#include "host/daemon/refused.hpp"

namespace unicursal::host {
namespace {

constexpr double enough_ahead = 60;  ///< s that a print must have planned ahead

}  // namespace

asio::awaitable<std::uint64_t> Daemon::try_job(std::string name, std::optional<LayerRange> layers) {
  const auto check_spare_time = [this] {
    if (!current_) return;
    const nlohmann::json print = status().value("print", nlohmann::json::object());
    if (print.value("lookahead_seconds", 0.0) < enough_ahead)
      throw Refused(
          Why::printing, "short_of_layers",
          "a print is going on that has less than a minute planned ahead; try again when it has more");
  };
  check_spare_time();
  if (dry_runs_.running())
    throw Refused(Why::conflict, "dry_run_going_on",
                  "another dry run is going on; wait for its end, or remove it");
  if (being_added_->size() >= most_checks)
    throw Refused(Why::conflict, "checking", "other jobs are being checked; try this one in a moment");
  {
    const auto place = being_added_->insert(name);
    const std::shared_ptr<void> checked(nullptr, [all = being_added_, place](void*) { all->erase(place); });
    co_await check(name, layers);
  }
  check_spare_time();
  DryRuns::Wish wish{name, files_.find(name), options_.profile, layers};
  co_return co_await dry_runs_.begin(std::move(wish));
}

}  // namespace unicursal::host
