// Preloaded into a program (LD_PRELOAD), makes a call on a regular file fail:
//
//     SUTURE_FAIL_CALL   write (also pwrite), fsync (also fdatasync) or rename
//     SUTURE_FAIL_AT     which one, counted from 1
//     SUTURE_FAIL_EVER   set: all later ones too, with ENOSPC, as on a full disk; else that one only, with EIO
//     SUTURE_FAIL_LOG    file that receives the number of such calls at the end
#include <dlfcn.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

long calls = 0;

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool fails(const char* call) {
  static const char* const wanted = std::getenv("SUTURE_FAIL_CALL");
  static const char* const at = std::getenv("SUTURE_FAIL_AT");
  static const bool ever = std::getenv("SUTURE_FAIL_EVER") != nullptr;
  if (wanted == nullptr || std::strcmp(call, wanted) != 0) return false;
  ++calls;
  const long which = at != nullptr ? std::atol(at) : 0;
  if (which <= 0 || calls < which || (!ever && calls > which)) return false;
  errno = ever ? ENOSPC : EIO;
  return true;
}

bool is_file(int descriptor) {
  struct stat status {};
  return descriptor > 2 && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

struct Log {
  ~Log() {
    const char* const path = std::getenv("SUTURE_FAIL_LOG");
    if (path == nullptr) return;
    if (FILE* const file = std::fopen(path, "w")) {
      std::fprintf(file, "%ld\n", calls);
      std::fclose(file);
    }
  }
} log_at_exit;

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* data, size_t size) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  if (is_file(descriptor) && fails("write")) return -1;
  return real(descriptor, data, size);
}

ssize_t pwrite(int descriptor, const void* data, size_t size, off_t offset) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  if (is_file(descriptor) && fails("write")) return -1;
  return real(descriptor, data, size, offset);
}

ssize_t pwrite64(int descriptor, const void* data, size_t size, off64_t offset) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
  if (is_file(descriptor) && fails("write")) return -1;
  return real(descriptor, data, size, offset);
}

int fsync(int descriptor) {
  static const auto real = next<int (*)(int)>("fsync");
  if (fails("fsync")) return -1;
  return real(descriptor);
}

int fdatasync(int descriptor) {
  static const auto real = next<int (*)(int)>("fdatasync");
  if (fails("fsync")) return -1;
  return real(descriptor);
}

int rename(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  if (fails("rename")) return -1;
  return real(from, to);
}
}
