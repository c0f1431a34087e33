// The readers under libFuzzer (clang, preset fuzz; scripts/fuzz builds and runs it). SUTURE_FUZZ_READER names the reader,
// SUTURE_FUZZ_INPUT the file it reads from.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include "fuzz/readers.hpp"
#include "support/file_bytes.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

std::string required(const char* name) {
  const char* const value = std::getenv(name);
  if (value == nullptr) std::fprintf(stderr, "libfuzzer: %s is not set\n", name), std::exit(2);
  return value;
}

const suture::test::Reader& reader() {
  static const suture::test::Reader& chosen = suture::test::fuzzed_readers().at(required("SUTURE_FUZZ_READER"));
  return chosen;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path input = required("SUTURE_FUZZ_INPUT");
  suture::test::write_bytes(input, {reinterpret_cast<const char*>(data), size});
  suture::test::try_input(reader(), input);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  const std::size_t mutated = LLVMFuzzerMutate(data, size, max_size);
  if (!reader().mend || std::minstd_rand(seed)() % 4 == 0) return mutated;
  std::string bytes(reinterpret_cast<const char*>(data), mutated);
  reader().mend(bytes);  // keeps the length
  std::memcpy(data, bytes.data(), mutated);
  return mutated;
}
