// What program this is; written into every output file.
#pragma once

#include <string>
#include <string_view>

namespace suture {

struct BuildInformation {
  std::string_view version;    ///< "0.1.0"
  std::string_view commit;     ///< full git hash, or "unknown" outside a git checkout
  bool dirty = false;          ///< tracked files differed from the commit when this was built
  std::string_view compiler;   ///< "GNU 12.2.0"
  std::string_view flags;      ///< compiler flags of the build type
  std::string_view simd;       ///< SUTURE_SIMD
  std::string_view libraries;  ///< "SUNDIALS 6.4.1, Eigen 3.4.0, ..."
};

const BuildInformation& build_information();

/// Several lines for `suture --version`.
std::string version_text();

}  // namespace suture
