#include "suture/version.hpp"

#include <fmt/format.h>

#include "io/version_generated.hpp"

namespace suture {

const BuildInformation& build_information() {
  static constexpr BuildInformation information{
      .version = SUTURE_GENERATED_VERSION,
      .commit = SUTURE_GENERATED_COMMIT,
      .dirty = SUTURE_GENERATED_DIRTY,
      .compiler = SUTURE_GENERATED_COMPILER,
      .flags = SUTURE_GENERATED_FLAGS,
      .simd = SUTURE_GENERATED_SIMD,
      .libraries = SUTURE_GENERATED_LIBRARIES,
  };
  return information;
}

std::string version_text() {
  const BuildInformation& build = build_information();
  return fmt::format("suture {}\ncommit {}{}\ncompiler {} ({}), vector instructions: {}\nlibraries {}", build.version,
                     build.commit, build.dirty ? " with uncommitted changes" : "", build.compiler, build.flags,
                     build.simd, build.libraries);
}

}  // namespace suture
