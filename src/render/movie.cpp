#include "suture/render/movie.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "suture/errors.hpp"

extern char** environ;

namespace suture {
namespace {

std::vector<std::string> codec(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".mp4") return {"-c:v", "libx264", "-crf", "18", "-preset", "medium", "-movflags", "+faststart"};
  if (ending == ".webm") return {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1"};
  throw InputError(fmt::format("{}: movies end in .mp4 or .webm", path.string()));
}

std::string program_name() {
  const char* const name = std::getenv("SUTURE_FFMPEG");
  return name != nullptr && *name != '\0' ? name : "ffmpeg";
}

// A dead ffmpeg must end in an error message, not in SIGPIPE.
class IgnorePipeSignal {
 public:
  IgnorePipeSignal() { previous_ = signal(SIGPIPE, SIG_IGN); }
  ~IgnorePipeSignal() { signal(SIGPIPE, previous_); }

 private:
  void (*previous_)(int);
};

}  // namespace

Movie::Movie(std::filesystem::path path, int width, int height, int frames_per_second)
    : path_(std::move(path)), width_(width), height_(height) {
  partial_ = path_.parent_path() / fmt::format("{}.{}.partial{}", path_.stem().string(), getpid(), path_.extension().string());
  if (width < 2 || height < 2 || width % 2 != 0 || height % 2 != 0)
    throw InputError(fmt::format("a movie of {} x {} pixels: both must be even and positive", width, height));
  if (frames_per_second < 1) throw InputError(fmt::format("{} frames per second are too few", frames_per_second));
  start(frames_per_second);
}

void Movie::start(int frames_per_second) {
  const std::string program = program_name();
  std::vector<std::string> words{program, "-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "bgr0",
                                 "-video_size", fmt::format("{}x{}", width_, height_), "-framerate",
                                 std::to_string(frames_per_second), "-i", "pipe:0"};
  for (const std::string& word : codec(path_)) words.push_back(word);
  // Half the colour resolution is what every player understands.
  for (const char* word : {"-pix_fmt", "yuv420p"}) words.emplace_back(word);
  words.push_back("file:" + partial_.string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw FileError(fmt::format("no pipe to {}: {}", program, std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  const int error = posix_spawnp(&program_, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (error == 0) return;
  program_ = -1;
  close(pipe_);
  throw InputError(fmt::format("movies are made by the program '{}', which could not be started: {} (on Debian: "
                               "apt-get install ffmpeg)",
                               program, std::strerror(error)));
}

Movie::~Movie() {
  if (program_ < 0) return;
  end_program();
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

void Movie::add(const Pixels& picture) {
  if (picture.width != width_ || picture.height != height_)
    throw InputError(fmt::format("a picture of {} x {} pixels in a movie of {} x {}", picture.width, picture.height,
                                 width_, height_));
  const IgnorePipeSignal guard;
  std::size_t written = 0;
  while (written < picture.bytes.size()) {
    const ssize_t count = write(pipe_, picture.bytes.data() + written, picture.bytes.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw FileError(fmt::format("{}: ffmpeg stopped early: {}", path_.string(), std::strerror(errno)));
    written += static_cast<std::size_t>(count);
  }
}

int Movie::end_program() {
  close(pipe_);
  int status = 0;
  while (waitpid(program_, &status, 0) < 0 && errno == EINTR) continue;
  program_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

void Movie::finish() {
  std::error_code error;
  if (const int code = end_program(); code != 0) {
    std::filesystem::remove(partial_, error);
    throw FileError(fmt::format("{}: ffmpeg failed with exit code {}", path_.string(), code));
  }
  std::filesystem::rename(partial_, path_, error);
  if (error) throw FileError(fmt::format("{}: {}", path_.string(), error.message()));
}

}  // namespace suture
