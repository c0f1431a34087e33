// The two kinds of error a user can meet, and the contract check for the ones they cannot.
#pragma once

#include <stdexcept>
#include <string>

namespace suture {

/// The user's input is wrong: message says where, what was found, what is allowed. Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The computation failed (inverted cell, zero-length segment, no convergence). Exit code 3.
/// The message names time, step size and the worst components in physical words.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file could not be written. Exit code 3.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A developer's mistake; active in builds with SUTURE_CONTRACTS (dev, asan, audit).
#ifdef SUTURE_CONTRACTS
void contract_failed(const char* expression, const char* file, int line);
#define SUTURE_EXPECTS(condition) \
  ((condition) ? static_cast<void>(0) : ::suture::contract_failed(#condition, __FILE__, __LINE__))
#else
#define SUTURE_EXPECTS(condition) static_cast<void>(0)
#endif

}  // namespace suture
