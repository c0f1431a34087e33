// The compilations of the kernels that this processor can run.
#pragma once

#include <vector>

#include "kernels/kernels.hpp"

namespace suture::test {

inline std::vector<const kernels::Table*> runnable_tables() {
  std::vector<const kernels::Table*> tables{&kernels::baseline};
  if (__builtin_cpu_supports("x86-64-v3")) tables.push_back(&kernels::avx2);
  if (__builtin_cpu_supports("x86-64-v4")) tables.push_back(&kernels::avx512);
  return tables;
}

}  // namespace suture::test
