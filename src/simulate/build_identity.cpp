// Apart from the rest of the checkpoint: clang 14, which compiles the readers for scripts/fuzz, does not know these levels.
#include <fmt/format.h>

#include "simulate/run_checkpoint.hpp"
#include "suture/version.hpp"

namespace suture {

std::string build_identity() {
  const BuildInformation& build = build_information();
  const char* vectors = __builtin_cpu_supports("x86-64-v4") ? "v4" : __builtin_cpu_supports("x86-64-v3") ? "v3" : "v2";
  return fmt::format("{} {}{} {} {} {} {} x86-64-{}", build.version, build.commit, build.dirty ? "-dirty" : "",
                     build.compiler, build.flags, build.simd, build.libraries, vectors);
}

}  // namespace suture
