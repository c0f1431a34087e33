#include "threads/worker_pool.hpp"

#include <csignal>
#include <utility>

namespace suture {

namespace {

constexpr unsigned at_work = 0x7ff, open = 0x800, one_run = 0x1000;
// Runs follow each other within microseconds during an evaluation; sleeping and waking up would take longer.
constexpr int spins = 400;

/// Returns when `state` is no longer `seen`.
void wait_for_change(const std::atomic<unsigned>& state, unsigned seen) {
  for (int k = 0; k < spins; ++k) {
    if (state.load(std::memory_order_acquire) != seen) return;
    __builtin_ia32_pause();
  }
  state.wait(seen, std::memory_order_acquire);
}

}  // namespace

WorkerPool::WorkerPool(int threads) {
  if (threads == 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  // Signals are for the program's own thread, which asks the run to stop.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  for (int k = 1; k < threads; ++k) workers_.emplace_back([this] { serve(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

WorkerPool::~WorkerPool() {
  stopping_.store(true, std::memory_order_relaxed);
  state_.fetch_add(one_run, std::memory_order_release);
  state_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

WorkerPool& WorkerPool::alone() {
  static WorkerPool pool(1);
  return pool;
}

void WorkerPool::run(int count, Call call, const void* task) {
  call_ = call;
  task_ = task;
  count_ = count;
  next_.store(0, std::memory_order_relaxed);
  state_.store(((state_.load(std::memory_order_relaxed) & ~at_work) + one_run) | open, std::memory_order_release);
  state_.notify_all();
  work();
  unsigned now = state_.fetch_and(~open, std::memory_order_acq_rel) & ~open;
  while ((now & at_work) != 0) {
    wait_for_change(state_, now);
    now = state_.load(std::memory_order_acquire);
  }
  if (failed_.load(std::memory_order_relaxed)) {
    failed_.store(false, std::memory_order_relaxed);
    std::rethrow_exception(std::exchange(exception_, nullptr));
  }
}

void WorkerPool::work() {
  for (int k; (k = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) {
    try {
      call_(task_, k);
    } catch (...) {
      if (!failed_.exchange(true, std::memory_order_relaxed)) exception_ = std::current_exception();
      next_.store(count_, std::memory_order_relaxed);
    }
  }
}

void WorkerPool::serve() {
  unsigned finished = 0;  // number of the last run worked on
  unsigned now = state_.load(std::memory_order_acquire);
  while (!stopping_.load(std::memory_order_relaxed)) {
    const unsigned run = now / one_run;
    if ((now & open) == 0 || run == finished) {
      wait_for_change(state_, now);
      now = state_.load(std::memory_order_acquire);
    } else if (state_.compare_exchange_weak(now, now + 1, std::memory_order_acq_rel, std::memory_order_acquire)) {
      finished = run;
      work();
      const unsigned left = state_.fetch_sub(1, std::memory_order_acq_rel) - 1;
      if ((left & at_work) == 0 && (left & open) == 0) state_.notify_all();
      now = state_.load(std::memory_order_acquire);
    }
  }
}

}  // namespace suture
