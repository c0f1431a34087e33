// Numbers that many states have in common.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace suture {

/// A vector that never changes and is shared by all copies, not copied with them.
class SharedValues {
 public:
  SharedValues() = default;
  SharedValues(std::vector<double> values)  // whatever gives a vector may give this
      : held_(values.empty() ? nullptr : std::make_shared<const std::vector<double>>(std::move(values))) {}

  bool empty() const { return held_ == nullptr; }
  std::size_t size() const { return held_ ? held_->size() : 0; }
  const double* data() const { return held_ ? held_->data() : nullptr; }
  const double* begin() const { return data(); }
  const double* end() const { return data() + size(); }
  double operator[](std::size_t k) const { return (*held_)[k]; }
  std::vector<double> to_vector() const { return {begin(), end()}; }
  friend bool operator==(const SharedValues& a, const SharedValues& b) {
    return a.held_ == b.held_ || (a.held_ && b.held_ && *a.held_ == *b.held_);
  }

 private:
  std::shared_ptr<const std::vector<double>> held_;  // none: empty
};

}  // namespace suture
