// Keeps the events of a closure.
#pragma once

#include <algorithm>
#include <vector>

#include "suture/simulate/closure.hpp"

namespace suture::test {

class EventLog final : public ClosureObserver {
 public:
  void sample(const ClosureSample&) override {}
  void event(const EventRecord& e) override { records.push_back(e); }
  long count(EventKind kind) const {
    return std::ranges::count_if(records, [=](const EventRecord& e) { return e.kind == kind; });
  }
  std::vector<EventRecord> records;
};

}  // namespace suture::test
