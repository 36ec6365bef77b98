#include "host/daemon/child_limits.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace unicursal::host {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool limits_memory = false;  // the sanitizer itself reserves terabytes of addresses
#else
constexpr bool limits_memory = true;
#endif

void limit_resource(__rlimit_resource which, rlim_t soft, rlim_t hard) {
  const rlimit limits{soft, hard};
  ::setrlimit(which, &limits);
}

void offer_first() {
  const int score = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (score < 0) return;
  [[maybe_unused]] const auto written = ::write(score, "1000", 4);
  ::close(score);
}

}  // namespace

void take_on(const ChildLimits& limits) {
  ::prctl(PR_SET_PDEATHSIG, limits.death_signal);
  ::setpriority(PRIO_PROCESS, 0, 19);  // the printer comes first
  offer_first();
  limit_resource(RLIMIT_CORE, 0, 0);
  if (limits.memory && limits_memory) limit_resource(RLIMIT_AS, *limits.memory, *limits.memory);
  if (limits.soft_seconds)
    limit_resource(RLIMIT_CPU, *limits.soft_seconds, *limits.soft_seconds + limits.grace_seconds);
  if (limits.largest_file) limit_resource(RLIMIT_FSIZE, *limits.largest_file, *limits.largest_file);
}

}  // namespace unicursal::host
