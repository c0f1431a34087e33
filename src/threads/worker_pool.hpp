// Threads that share the work of one large tissue. What is divided is divided the same way for every number of threads
// (ranges.hpp, contact_schedule.hpp); threads only decide who works on which part, so results have the same bits.
#pragma once

#include <atomic>
#include <exception>
#include <thread>
#include <type_traits>
#include <vector>

namespace suture {

class WorkerPool {
 public:
  /// threads: how many work at once, the caller among them; 0 for as many as the machine has cores. 1 starts none.
  explicit WorkerPool(int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int threads() const { return 1 + static_cast<int>(workers_.size()); }

  /// Calls task(0) .. task(count - 1), in any order and on any thread, and returns when all are done. Tasks must not touch
  /// what another one writes, nor call for_each. What a task throws is thrown here (one of them, when several do), and the
  /// remaining tasks may then be left out. Called by one thread at a time; allocates nothing.
  template <class Task>
  void for_each(int count, Task&& task) {
    if (count <= 1 || workers_.empty()) {
      for (int k = 0; k < count; ++k) task(k);
      return;
    }
    using Plain = std::remove_reference_t<Task>;
    run(count, [](const void* t, int k) { (*const_cast<Plain*>(static_cast<const Plain*>(t)))(k); }, &task);
  }

  /// The calling thread without help.
  static WorkerPool& alone();

 private:
  using Call = void (*)(const void* task, int k);
  void run(int count, Call call, const void* task);
  /// Takes tasks until none is left.
  void work();
  void serve();

  // One word says whether there is work and who is at it, so that nobody waits for a thread that has not woken up in
  // time: it finds the run closed. Low bits: threads at work; then `open`; the rest numbers the runs.
  std::atomic<unsigned> state_{0};
  std::atomic<int> next_{0};
  std::atomic<bool> failed_{false}, stopping_{false};
  Call call_ = nullptr;
  const void* task_ = nullptr;
  int count_ = 0;
  std::exception_ptr exception_;
  std::vector<std::thread> workers_;
};

}  // namespace suture
