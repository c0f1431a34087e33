#include "suture/sweep/claim.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <thread>
#include <vector>

#include "suture/errors.hpp"

namespace suture {

namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

/// Machine, boot and process-id namespace: where a process id means the same process.
std::string machine() {
  char host[256] = "unknown";
  ::gethostname(host, sizeof host - 1);
  std::error_code ignored;
  return fmt::format("{} {} {}", host, first_line("/proc/sys/kernel/random/boot_id"),
                     fs::read_symlink("/proc/self/ns/pid", ignored).string());
}

/// When a process started, in clock ticks; empty when there is none of that number or it is only waiting to be reaped.
/// Together with the number this names one process, although numbers are used again.
std::string start_time(const std::string& pid) {
  const std::string line = first_line("/proc/" + pid + "/stat");
  const auto name_end = line.rfind(')');
  if (name_end == std::string::npos) return "";
  std::vector<std::string> fields;
  for (std::size_t at = name_end + 2; at < line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    fields.push_back(line.substr(at, end - at));
    at = end + 1;
  }
  constexpr std::size_t state = 0, start = 19;  // fields 3 and 22 of proc(5)
  return fields.size() > start && fields[state] != "Z" && fields[state] != "X" ? fields[start] : "";
}

double modified_s(const struct stat& status) {
  return static_cast<double>(status.st_mtim.tv_sec) + 1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

/// A file of our own, unique among all processes, from which claims are made by a link. Its time stamp is "now" by the
/// clock of the file system, so that clocks that differ between machines do no harm.
class Ticket {
 public:
  explicit Ticket(const fs::path& folder) {
    static int count = 0;
    char host[256] = "unknown";
    ::gethostname(host, sizeof host - 1);
    path_ = folder / fmt::format(".{}.{}.{}", host, ::getpid(), ++count);
    const std::string pid = fmt::format("{}", ::getpid());
    std::ofstream stream(path_);
    stream << machine() << '\n' << pid << '\n' << start_time(pid) << '\n';
    stream.close();
    if (!stream) throw FileError(fmt::format("{}: cannot write: {}", path_.string(), std::strerror(errno)));
  }
  Ticket(const Ticket&) = delete;
  Ticket& operator=(const Ticket&) = delete;
  ~Ticket() { ::unlink(path_.c_str()); }
  const fs::path& path() const { return path_; }
  double now() const {
    struct stat status{};
    return ::stat(path_.c_str(), &status) == 0 ? modified_s(status) : 0.0;
  }

 private:
  fs::path path_;
};

bool alive(const fs::path& claim, double now, double lease_s) {
  std::ifstream stream(claim);
  std::string where, pid, start;
  std::getline(stream, where), std::getline(stream, pid), std::getline(stream, start);
  struct stat status{};
  if (!stream || ::stat(claim.c_str(), &status) != 0) return false;  // given back meanwhile
  if (where == machine()) return !start.empty() && start_time(pid) == start;
  return now - modified_s(status) < lease_s;
}

/// The generations of claims on `name` that exist.
std::vector<long> generations(const fs::path& folder, const std::string& name) {
  std::vector<long> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with(name + ".")) continue;
    long generation = 0;
    const char* end = file.data() + file.size();
    if (std::from_chars(file.data() + name.size() + 1, end, generation).ptr == end) found.push_back(generation);
  }
  if (error) throw FileError(fmt::format("{}: cannot list: {}", folder.string(), error.message()));
  return found;
}

long newest(const std::vector<long>& all) { return all.empty() ? 0 : *std::max_element(all.begin(), all.end()); }

fs::path claim_path(const fs::path& folder, const std::string& name, long generation) {
  return folder / fmt::format("{}.{}", name, generation);
}

}  // namespace

struct Claim::Impl {
  fs::path folder;
  std::string name;
  long generation;
  std::mutex mutex;
  std::condition_variable_any wake;
  std::jthread heartbeat;

  Impl(fs::path in, std::string what, long number, double lease_s)
      : folder(std::move(in)), name(std::move(what)), generation(number), heartbeat([this, lease_s](std::stop_token stop) {
          const fs::path file = path();
          std::unique_lock lock(mutex);
          const auto interval = std::chrono::duration<double>(lease_s / 6.0);
          while (!wake.wait_for(lock, stop, interval, [&] { return stop.stop_requested(); }))
            ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);
        }) {}
  fs::path path() const { return claim_path(folder, name, generation); }
};

Claim::Claim(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Claim::Claim(Claim&&) noexcept = default;

Claim::~Claim() {
  if (impl_) ::unlink(impl_->path().c_str());
}

void Claim::finish() {
  for (const long generation : generations(impl_->folder, impl_->name))
    if (generation < impl_->generation) ::unlink(claim_path(impl_->folder, impl_->name, generation).c_str());
}

std::optional<Claim> Claim::take(const fs::path& folder, const std::string& name, double lease_s) {
  const Ticket ticket(folder);
  const long last = newest(generations(folder, name));
  if (last > 0 && alive(claim_path(folder, name, last), ticket.now(), lease_s)) return std::nullopt;
  const fs::path mine = claim_path(folder, name, last + 1);
  if (::link(ticket.path().c_str(), mine.c_str()) != 0) {
    if (errno == EEXIST) return std::nullopt;  // another process was faster
    throw FileError(fmt::format("{}: cannot create: {}", mine.string(), std::strerror(errno)));
  }
  Claim claim(std::make_unique<Impl>(folder, name, last + 1, lease_s));
  // A holder that gave its claim back between our look and our link lets a third process in below us: the later steps back.
  for (const long other : generations(folder, name))
    if (other != last + 1 && alive(claim_path(folder, name, other), ticket.now(), lease_s)) return std::nullopt;
  return claim;
}

bool Claim::held(const fs::path& folder, const std::string& name, double lease_s) {
  const long last = newest(generations(folder, name));
  if (last == 0) return false;
  const Ticket ticket(folder);
  return alive(claim_path(folder, name, last), ticket.now(), lease_s);
}

}  // namespace suture
