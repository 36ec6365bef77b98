#include "host/engine/step_wait.hpp"

namespace unicursal::host {

StepWait::StepWait(Source& source) : source_(source) {
  source.on_ready([this] {
    ++calls_;
    calls_.notify_all();
  });
}

// Holds no lock while it asks the source: the listener may be called under the source's own lock.
void StepWait::wait() {
  for (;;) {
    const unsigned calls = calls_;
    if (source_.ready()) return;
    calls_.wait(calls);
  }
}

}  // namespace unicursal::host
