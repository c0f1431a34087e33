#include "suture/io/provenance.hpp"

#include <ctime>

#include "io/build_information.hpp"
#include "io/commit.hpp"

namespace suture {

const BuildInformation& build_information() {
#ifdef NDEBUG
  static const BuildInformation information{SUTURE_VERSION, SUTURE_COMMIT, SUTURE_COMPILER, "optimised", SUTURE_LIBRARIES};
#else
  static const BuildInformation information{SUTURE_VERSION, SUTURE_COMMIT, SUTURE_COMPILER, "debug", SUTURE_LIBRARIES};
#endif
  return information;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[sizeof "2026-11-22T08:47:31Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace suture
