#include "host/lookahead/low_priority.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace unicursal::host {
namespace {

/// Added to the niceness of planning threads, so that the link is served first on a busy machine.
constexpr int planner_niceness = 10;

}  // namespace

void lower_priority() {
  const sched_param parameters{};
  pthread_setschedparam(pthread_self(), SCHED_BATCH, &parameters);
  pthread_setname_np(pthread_self(), "planner");  // shown by top and the like
  const auto thread = static_cast<id_t>(gettid());
  setpriority(PRIO_PROCESS, thread, planner_niceness);
}

}  // namespace unicursal::host
