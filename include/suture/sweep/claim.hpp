// Who works on what, among any number of processes on any number of machines that share a folder. Only the exclusive
// creation of a file is relied upon (link), which every POSIX file system has; locks are not.
//
// A claim is a file NAME.GENERATION that says which process holds it. It is dead when that process is gone (same machine)
// or when its time stamp, renewed by the holder, is older than the lease (other machines). A dead claim is not
// removed but outbid: whoever creates the next generation holds it. So two processes can never both take over.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace suture {

class Claim {
 public:
  /// Empty when somebody else holds `name`. `folder` must exist; `lease_s`: seconds without a sign of life after which a holder
  /// on another machine counts as dead. Throws FileError.
  static std::optional<Claim> take(const std::filesystem::path& folder, const std::string& name, double lease_s);
  /// Whether somebody holds `name`.
  static bool held(const std::filesystem::path& folder, const std::string& name, double lease_s);

  Claim(Claim&&) noexcept;
  Claim& operator=(Claim&&) = delete;
  /// Gives the claim back; the next one may start afresh.
  ~Claim();
  /// What was claimed is finished and marked so: removes dead claims of other generations too.
  void finish();

 private:
  struct Impl;
  explicit Claim(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace suture
