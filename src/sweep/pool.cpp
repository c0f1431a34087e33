#include "suture/sweep/pool.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <iostream>
#include <map>
#include <thread>
#include <vector>

#include "suture/errors.hpp"

namespace suture {

namespace {

using Clock = std::chrono::steady_clock;

enum ChildCode { child_finished = 0, child_failed_to_write = 4, child_stopped = 75, child_busy = 76 };

volatile std::sig_atomic_t child_stop = 0;
void ask_child_to_stop(int) { child_stop = 1; }

int child_code(const SweepFolder& folder, const SweepRun& run) {
  try {
    switch (execute_run(folder, run, [] { return child_stop != 0; })) {
      case RunEnd::finished: return child_finished;
      case RunEnd::stopped: return child_stopped;
      case RunEnd::busy: return child_busy;
    }
  } catch (const std::exception& error) {
    std::cerr << fmt::format("suture: error: run {} ({}): {}\n", run.index, run.key, error.what());
  }
  return child_failed_to_write;
}

pid_t start_child(const SweepFolder& folder, const SweepRun& run) {
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw FileError(fmt::format("cannot start a process: {}", std::strerror(errno)));
  if (child > 0) return child;
  // Ctrl-C reaches the whole group; the parent passes it on as SIGTERM. A child must not outlive a parent that was killed.
  std::signal(SIGINT, SIG_IGN);
  child_stop = 0;
  std::signal(SIGTERM, ask_child_to_stop);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::_exit(::getppid() == parent ? child_code(folder, run) : child_stopped);
}

/// A signal that comes from outside and says nothing about the run.
bool from_outside(int signal) { return signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP; }

class Pool {
 public:
  Pool(const SweepFolder& folder, const SweepPlan& plan, const PoolOptions& options)
      : folder_(folder), plan_(plan), options_(options) {}

  bool run() {
    look_for_finished();
    progress_.finished_before = progress_.finished;
    report("");
    while (!waiting_.empty() || !children_.empty()) {
      if (!stopping_ && options_.stop && options_.stop()) stop_children();
      if (stopping_ && children_.empty()) break;
      if (!stopping_) start_children();
      if (!reap()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      if (Clock::now() - reported_ > std::chrono::seconds(1)) report("");
    }
    if (broken_) throw FileError("the sweep was ended because a run could not be carried out, see above");
    return !stopping_;
  }

 private:
  struct Waiting {
    const SweepRun* run;
    Clock::time_point not_before;
  };

  void look_for_finished() {
    progress_.total = static_cast<int>(plan_.runs.size());
    for (const SweepRun& run : plan_.runs)
      if (!count_if_finished(run)) waiting_.push_back({&run, Clock::now()});
  }

  bool count_if_finished(const SweepRun& run) {
    const auto record = finished_record(folder_, run);
    if (!record) return false;
    ++progress_.finished;
    if (record->status == "failed") ++progress_.failed;
    return true;
  }

  void start_children() {
    for (std::size_t looked_at = waiting_.size(); looked_at > 0 && running() < options_.jobs; --looked_at) {
      const Waiting next = waiting_.front();
      waiting_.pop_front();
      if (next.not_before > Clock::now())
        waiting_.push_back(next);
      else
        children_[start_child(folder_, *next.run)] = next.run;
    }
  }

  void stop_children() {
    stopping_ = true;
    for (const auto& [child, run] : children_) ::kill(child, SIGTERM);
  }

  int running() const { return static_cast<int>(children_.size()); }

  bool reap() {
    bool any = false;
    for (auto child = children_.begin(); child != children_.end();) {
      int status = 0;
      const pid_t ended = ::waitpid(child->first, &status, WNOHANG);
      if (ended == 0 || (ended < 0 && errno == EINTR)) {
        ++child;
        continue;
      }
      const SweepRun* run = child->second;
      child = children_.erase(child);
      ended_child(*run, status);
      any = true;
    }
    return any;
  }

  void ended_child(const SweepRun& run, int status) {
    if (WIFSIGNALED(status)) return killed_child(run, WTERMSIG(status));
    switch (WEXITSTATUS(status)) {
      case child_finished: return finished_run(run);
      case child_busy: return again(run, std::chrono::milliseconds(1000));
      case child_stopped: return again(run, std::chrono::milliseconds(0));
      default:
        broken_ = true;
        if (!stopping_) stop_children();
    }
  }

  void again(const SweepRun& run, std::chrono::milliseconds delay) { waiting_.push_back({&run, Clock::now() + delay}); }

  void killed_child(const SweepRun& run, int signal) {
    constexpr int most_kills = 3;
    if (stopping_ || (from_outside(signal) && ++kills_[run.index] < most_kills)) return again(run, std::chrono::milliseconds(0));
    record_failure(folder_, run,
                   from_outside(signal) ? fmt::format("its process was killed {} times ({}; out of memory?)", most_kills, strsignal(signal))
                                        : fmt::format("its process crashed ({})", strsignal(signal)));
    finished_run(run);
  }

  void finished_run(const SweepRun& run) {
    const auto record = finished_record(folder_, run);
    if (!record) return again(run, std::chrono::milliseconds(1000));  // another worker is recording it
    ++progress_.finished;
    if (record->status == "failed") ++progress_.failed;
    report(fmt::format("run {} {}{}{}", run.index, record->status, record->reason.empty() ? "" : ": ", record->reason));
  }

  void report(std::string last) {
    reported_ = Clock::now();
    progress_.running = running();
    progress_.last = std::move(last);
    if (options_.progress) options_.progress(progress_);
  }

  const SweepFolder& folder_;
  const SweepPlan& plan_;
  const PoolOptions& options_;
  std::deque<Waiting> waiting_;
  std::map<pid_t, const SweepRun*> children_;
  std::map<int, int> kills_;
  SweepProgress progress_;
  Clock::time_point reported_;
  bool stopping_ = false, broken_ = false;
};

}  // namespace

bool execute_sweep(const SweepFolder& folder, const SweepPlan& plan, const PoolOptions& options) {
  return Pool(folder, plan, options).run();
}

}  // namespace suture
