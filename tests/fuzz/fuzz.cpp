// Throws damaged input at the readers, where there is no clang and so no libFuzzer. Build it with the asan preset
// (scripts/fuzz does).
//
//     suture_fuzz READER SECONDS CORPUS_FOLDER WORK_FOLDER [SEED]
//     suture_fuzz READER --replay FILE
//
// Every input lies in WORK_FOLDER/current-READER while it is tried, so a crash leaves the culprit there. Inputs come from the
// corpus by random changes; there is no coverage feedback.
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "fuzz/readers.hpp"
#include "support/file_bytes.hpp"

namespace suture::test {
namespace {

using Random = std::mt19937_64;
constexpr std::size_t largest_input = 1 << 20;

std::size_t below(Random& random, std::size_t limit) { return limit == 0 ? 0 : random() % limit; }

void change_once(std::string& input, const std::string& other, Random& random) {
  static constexpr std::uint64_t interesting[] = {0, 1, 0x7f, 0x80, 0xff, 0xffff, 0x7fffffff, 0xffffffff, 0x7fffffffffffffff, ~0ull, 1ull << 40};
  const std::size_t at = below(random, input.size());
  switch (random() % 8) {
    case 0:
      if (!input.empty()) input[at] = static_cast<char>(input[at] ^ (1 << random() % 8));
      break;
    case 1:
      if (!input.empty()) input[at] = static_cast<char>(random());
      break;
    case 2: {
      const std::uint64_t value = interesting[random() % std::size(interesting)];
      const std::size_t width = std::size_t{1} << random() % 4;
      if (input.size() >= at + width) std::memcpy(input.data() + at, &value, width);
      break;
    }
    case 3: input.erase(at, 1 + below(random, 64)); break;
    case 4: input.insert(at, input.substr(below(random, input.size()), 1 + below(random, 64))); break;
    case 5: input.insert(at, other.substr(below(random, other.size()), 1 + below(random, 256))); break;
    case 6:
      if (random() % 8 == 0) input.resize(at);
      break;
    default: input.insert(at, 1, "0123456789.,=-+eE\"[]{}#\n\t\\x"[random() % 27]); break;
  }
}

std::string mutate(const std::vector<std::string>& corpus, Random& random) {
  std::string input = corpus[below(random, corpus.size())];
  const std::string& other = corpus[below(random, corpus.size())];
  for (std::uint64_t changes = 1 + random() % 6; changes > 0; --changes) change_once(input, other, random);
  if (input.size() > largest_input) input.resize(largest_input);
  return input;
}

/// As try_input, within a limit of time.
bool try_in_time(const Reader& reader, const std::filesystem::path& path) {
  constexpr unsigned longest = 20;  // s
  alarm(longest);
  const bool accepted = try_input(reader, path);
  alarm(0);
  return accepted;
}

int fuzz(const std::string& name, const Reader& reader, double seconds, const std::filesystem::path& folder,
         const std::filesystem::path& work, std::uint64_t seed) {
  std::vector<std::string> corpus;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) corpus.push_back(read_bytes(entry.path()));
  if (corpus.empty()) return std::fprintf(stderr, "%s: empty corpus\n", folder.c_str()), 2;
  const std::filesystem::path input = work / ("current-" + name);
  Random random(seed);
  long tried = 0, accepted = 0;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  for (; elapsed() < seconds; ++tried) {
    std::string bytes = tried < static_cast<long>(corpus.size()) ? corpus[static_cast<std::size_t>(tried)] : mutate(corpus, random);
    if (reader.mend && random() % 4 != 0) reader.mend(bytes);
    write_bytes(input, bytes);
    accepted += try_in_time(reader, input);
  }
  std::filesystem::remove(input);
  std::printf("%s: %ld inputs in %.0f s, %ld accepted, seed %llu\n", name.c_str(), tried, elapsed(), accepted,
              static_cast<unsigned long long>(seed));
  return 0;
}

}  // namespace
}  // namespace suture::test

int main(int argc, char** argv) {
  using namespace suture::test;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 3 || !fuzzed_readers().contains(arguments[0]))
    return std::fprintf(stderr, "usage: suture_fuzz toml|state_csv|trajectory|journal|checkpoint SECONDS CORPUS WORK [SEED]\n"), 2;
  const Reader& reader = fuzzed_readers().at(arguments[0]);
#ifndef SUTURE_SANITIZED
  const rlimit limit{rlim_t{4} << 30, rlim_t{4} << 30};  // an allocation beyond all measure ends in bad_alloc, a crash
  setrlimit(RLIMIT_AS, &limit);
#endif
  if (arguments[1] == "--replay") {
    std::printf("%s\n", try_in_time(reader, arguments[2]) ? "accepted" : "refused");
    return 0;
  }
  const std::uint64_t seed = arguments.size() > 4 ? std::stoull(arguments[4]) : std::random_device{}();
  return fuzz(arguments[0], reader, std::stod(arguments[1]), arguments[2], arguments[3], seed);
}
