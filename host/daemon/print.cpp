#include "host/daemon/print.hpp"

#include <unistd.h>

#include <utility>

#include "host/cli/words.hpp"
#include "host/link/link.hpp"

namespace unicursal::host {

Print::Print(const PrintPlan& plan)
    : pause_heat_(plan.pause_heat),
      prepared_(prepare(load_job(plan.job, plan.profile), plan.layers)),
      run_(prepared_, "serve", {}),
      lookahead_(*prepared_.part, lookahead_options(prepared_)) {
  check_beginning(prepared_, lookahead_);
  PrintOrder order;
  order.job_name = prepared_.job.file.stem().string();
  order.port = plan.port.value_or(plan.own_port ? "auto" : prepared_.job.profile.port);
  order.layer_count = prepared_.count;
  if (plan.layers) order.layers = std::pair(plan.layers->first, plan.layers->last);
  port_ = open_port(order.port, prepared_.job.profile.baud);
  try {
    spool_.emplace(Spool::create(plan.spool ? *plan.spool : default_spool_root(), prepared_.job, order));
  } catch (...) {
    close(port_);
    throw;
  }
}

Print::~Print() {
  if (port_ >= 0) close(port_);
}

Session& Print::begin(asio::any_io_executor executor) {
  StreamSettings settings;
  settings.spool = &*spool_;
  settings.pause_heat = pause_heat_;
  session_.emplace(std::move(executor), std::exchange(port_, -1), lookahead_, run_, settings);
  return *session_;
}

void Print::end() {
  session_.reset();
}

}  // namespace unicursal::host
