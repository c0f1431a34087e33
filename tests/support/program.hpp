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
  long peak_kB = 0;    ///< most memory it held at any time (resident)
};

/// Runs `program` (tests pass SUTURE_PROGRAM) with these arguments, without a shell, in `directory`.
Outcome run_suture(const std::string& program, const std::vector<std::string>& arguments,
                   const std::filesystem::path& directory);

/// A program that is running; killed at the end of its life.
class RunningProgram {
 public:
  /// As run_suture; what it says goes into `directory`/stdout and stderr. environment: "NAME=value", added.
  RunningProgram(const std::string& program, const std::vector<std::string>& arguments,
                 const std::filesystem::path& directory, const std::vector<std::string>& environment = {});
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;
  ~RunningProgram();
  void send(int signal) const;
  /// Waits for the end. Exit code, or -signal.
  int wait();

 private:
  int process_ = -1;
};

/// A fresh directory, removed with everything in it at the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  /// In memory, where flushing costs nothing, if the system offers that: for tests that flush thousands of times.
  static TemporaryDirectory in_memory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// Writes a file in it.
  void write(const std::string& name, const std::string& text) const;
  /// Names of everything in it, sorted.
  std::vector<std::string> contents() const;

 private:
  explicit TemporaryDirectory(const std::filesystem::path& parent);
  std::filesystem::path path_;
};

}  // namespace suture::test
