// Throws damaged input at the readers. What they must do with it: an InputError or FileError, or a result; never a crash,
// a hang or an allocation beyond all measure. Build it with the asan preset (scripts/fuzz does).
//
//     suture_fuzz TARGET SECONDS CORPUS_FOLDER WORK_FOLDER [SEED]
//     suture_fuzz TARGET --replay FILE
//
// Every input lies in WORK_FOLDER/current-TARGET while it is tried, so a crash leaves the culprit there. Inputs come from the
// corpus by random changes. GCC 12 has no libFuzzer, hence this driver; there is no coverage feedback.
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "io/checkpoint_file.hpp"
#include "io/content_hash.hpp"
#include "simulate/run_checkpoint.hpp"
#include "support/file_bytes.hpp"
#include "suture/errors.hpp"
#include "suture/io/config.hpp"
#include "suture/io/state_csv.hpp"
#include "suture/io/trajectory_check.hpp"

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

/// Most changes would only ever meet the hash. With it set right again they get to what lies behind.
void mend_checkpoint(std::string& bytes) {
  if (bytes.size() < 40) return;
  const std::uint64_t length = bytes.size() - 32;
  std::memcpy(bytes.data() + 16, &length, 8);
  const std::uint64_t hash = content_hash(std::string_view(bytes).substr(0, bytes.size() - 8));
  std::memcpy(bytes.data() + bytes.size() - 8, &hash, 8);
}

void mend_journal(std::string& bytes) {
  // One block as long as it goes: the payload is a sequence of items anyway.
  if (bytes.size() < 48) return;
  const std::uint64_t length = bytes.size() - 40;
  std::memcpy(bytes.data() + 24, &length, 8);
  const std::uint64_t hash = content_hash(std::string_view(bytes).substr(32, length), 16 * 0x9e3779b97f4a7c15 + length);
  std::memcpy(bytes.data() + bytes.size() - 8, &hash, 8);
}

struct Target {
  std::function<void(const std::filesystem::path& input)> read;
  std::function<void(std::string& bytes)> mend = {};
  const char* name_of_input = "input";
};

void read_checkpoint_file(const std::filesystem::path& path) {
  const std::string payload = read_checkpoint(path);
  RunCheckpoint checkpoint;
  ByteReader reader(payload);
  reader(checkpoint);
  if (!checkpoint.resolved_config.empty()) expect_same_configuration(path, checkpoint.resolved_config, Config{});
}

const std::map<std::string, Target>& targets() {
  static const std::map<std::string, Target> all{
      {"toml", {[](const auto& path) { parse_config(read_bytes(path), "fuzz.toml"); }}},
      {"state_csv", {[](const auto& path) { read_state_csv(path); }}},
      {"trajectory", {[](const auto& path) { check_file(path); }}},
      {"journal", {[](const auto& path) { check_file(path); }, mend_journal}},
      {"checkpoint", {read_checkpoint_file, mend_checkpoint}},
  };
  return all;
}

/// True when the input was accepted.
bool try_input(const Target& target, const std::filesystem::path& path) {
  constexpr unsigned longest = 20;  // s
  alarm(longest);
  bool accepted = true;
  try {
    target.read(path);
  } catch (const InputError&) {
    accepted = false;
  } catch (const FileError&) {
    accepted = false;
  }
  alarm(0);
  return accepted;
}

int fuzz(const std::string& name, const Target& target, double seconds, const std::filesystem::path& folder,
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
    if (target.mend && random() % 4 != 0) target.mend(bytes);
    write_bytes(input, bytes);
    accepted += try_input(target, input);
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
  if (arguments.size() < 3 || !targets().contains(arguments[0]))
    return std::fprintf(stderr, "usage: suture_fuzz toml|state_csv|trajectory|journal|checkpoint SECONDS CORPUS WORK [SEED]\n"), 2;
  const Target& target = targets().at(arguments[0]);
#ifndef SUTURE_SANITIZED
  const rlimit limit{rlim_t{4} << 30, rlim_t{4} << 30};  // an allocation beyond all measure ends in bad_alloc, a crash
  setrlimit(RLIMIT_AS, &limit);
#endif
  if (arguments[1] == "--replay") {
    std::printf("%s\n", try_input(target, arguments[2]) ? "accepted" : "refused");
    return 0;
  }
  const std::uint64_t seed = arguments.size() > 4 ? std::stoull(arguments[4]) : std::random_device{}();
  return fuzz(arguments[0], target, std::stod(arguments[1]), arguments[2], arguments[3], seed);
}
