// Runs the program as a user would, and collects what it says.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace suture::test {

struct Outcome {
  int exit_code = -1;  ///< -1: did not exit by itself
  std::string output;  ///< stdout
  std::string errors;  ///< stderr
};

/// Runs `program` (tests pass SUTURE_PROGRAM) with these arguments, without a shell, in `directory`.
Outcome run_suture(const std::string& program, const std::vector<std::string>& arguments,
                   const std::filesystem::path& directory);

/// A fresh directory, removed with everything in it at the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// Writes a file in it.
  void write(const std::string& name, const std::string& text) const;
  /// Names of everything in it, sorted.
  std::vector<std::string> contents() const;

 private:
  std::filesystem::path path_;
};

}  // namespace suture::test
