// SPDX-License-Identifier: Apache-2.0
#include "shot_queue.h"

#include <chrono>

#include "signals.h"

namespace halfspace::python {

/// Counts a thread that renders.
class ShotQueue::Rendering {
 public:
  explicit Rendering(ShotQueue& queue) : queue_(queue) { add(1); }
  ~Rendering() {
    add(-1);
    queue_.ended_.notify_all();
  }
  Rendering(const Rendering&) = delete;
  Rendering& operator=(const Rendering&) = delete;

 private:
  void add(int threads) {
    const std::lock_guard lock(queue_.mutex_);
    queue_.running_ += threads;
  }

  ShotQueue& queue_;
};

void ShotQueue::work(const std::function<void(std::size_t)>& render) {
  try {
    for (std::size_t i = next_++; i < end_ && !stopped_; i = next_++) {
      const Rendering rendering(*this);
      render(i);
    }
    wait_for_others();
  } catch (const Stopped&) {  // another thread throws the reason
  } catch (...) {
    stopped_ = true;
    throw;
  }
}

void ShotQueue::check() const {
  if (stopped_) throw Stopped();
  check_signals();
}

void ShotQueue::wait_for_others() {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, std::chrono::milliseconds(50), [this] { return running_ == 0; })) {
    lock.unlock();
    check();
    lock.lock();
  }
}

}  // namespace halfspace::python
