#include "host/daemon/print.hpp"

#include <unistd.h>

#include <utility>

#include "host/job/load_job.hpp"
#include "host/link/link.hpp"

namespace unicursal::host {

namespace {

PreparedJob checked(const PrintPlan& plan) {
  PreparedJob prepared = prepare(load_job(plan.job, plan.profile), plan.layers);
  check_beginning(prepared);
  return prepared;
}

}  // namespace

Print::Print(const PrintPlan& plan)
    : prepared_(checked(plan)),
      run_(prepared_, "serve", {}),
      lookahead_(*prepared_.part, paced(lookahead_options(prepared_), settings_.clock)),
      source_(lookahead_, run_) {
  settings_.pause_heat = plan.pause_heat;
  settings_.profile = prepared_.job.profile.file;
  settings_.link = link_options(prepared_.job.profile, {});
  PrintOrder order;
  order.job_name = prepared_.job.file.stem().string();
  order.port = plan.port.value_or(plan.own_port ? "auto" : prepared_.job.profile.port);
  order.layer_count = prepared_.count;
  if (plan.layers) order.layers = std::pair(plan.layers->first, plan.layers->last);
  port_ = open_port(order.port, prepared_.job.profile.baud, settings_.link);
  order.device = device_of(port_);
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
  settings_.spool = &*spool_;
  session_.emplace(std::move(executor), std::exchange(port_, -1), source_, settings_);
  return *session_;
}

void Print::end() {
  session_.reset();
}

}  // namespace unicursal::host
