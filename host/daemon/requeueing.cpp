// How a daemon queues jobs that it knows already, and puts them into another order.
#include "core/error.hpp"
#include "host/daemon/daemon.hpp"
#include "host/daemon/refused.hpp"

namespace unicursal::host {

asio::awaitable<std::uint64_t> Daemon::print_again(PastPrint print) {
  std::string name = print.file;
  if (name.starts_with('/')) name = files_.name_of(name);
  if (name.empty())
    throw Refused(Why::not_found, "file_gone",
                  "the job of that print is not in the daemon's folders any more; send it once more");
  return add(std::move(name), print.range);
}

asio::awaitable<std::uint64_t> Daemon::copy(std::uint64_t id) {
  const QueuedJob* job = queue_.find(id);
  if (!job) throw Refused(Why::not_found, "there is no job with that number");
  return add(job->name, job->layers);
}

asio::awaitable<void> Daemon::arrange(std::vector<std::uint64_t> ids) {
  const std::vector<std::uint64_t> before = queue_.order();
  if (!queue_.arrange(ids))
    throw Refused(Why::conflict, "order_changed",
                  "one of these jobs does not wait any more; look at the queue again");
  std::string problem;
  try {
    co_await save();
  } catch (const core::DataError& error) {
    problem = error.what();
  }
  if (!problem.empty()) {
    queue_.arrange(before);  // unless it has changed meanwhile
    throw Refused(Why::no_room, problem);
  }
  broadcast({{"event", "queue"}, {"order", queue_.order()}});
}

}  // namespace unicursal::host
