#include "suture/errors.hpp"

#ifdef SUTURE_CONTRACTS
#include <cstdio>
#include <cstdlib>

namespace suture {

void contract_failed(const char* expression, const char* file, int line) {
  std::fprintf(stderr, "suture: internal contract violated: %s (%s:%d)\n", expression, file, line);
  std::abort();
}

}  // namespace suture
#endif
