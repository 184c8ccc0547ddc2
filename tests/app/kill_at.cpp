// The library kills a program between two system calls, for tests (LD_PRELOAD). A signal comes just before
// the n-th call that changes files or folders. With KILL_TORN it comes in the midst of one, when half of the
// bytes are written.
//
// KILL_AT is n, from 1 on. KILL_SIGNAL is the signal's number (9). KILL_LOG is a file that gets the names of
// all such calls.
#include <dlfcn.h>
#include <fcntl.h>
#include <stdio_ext.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace {

long number_of(const char* variable, long otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::atol(text) : otherwise;
}

// The first call may come before the constructors of this library.
struct Plan {
  long at = number_of("KILL_AT", 0);
  int signal = static_cast<int>(number_of("KILL_SIGNAL", SIGKILL));
  bool torn = std::getenv("KILL_TORN") != nullptr;
  const char* log = std::getenv("KILL_LOG");
  pid_t process = ::getpid();  // a child that is about to become ffmpeg does not count
};
const Plan& plan() {
  static const Plan one;
  return one;
}
std::atomic<long> calls{0};

template <class Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool is_next(const char* name) {
  if (::getpid() != plan().process) return false;
  if (plan().log != nullptr) {
    static const auto real = original<int(const char*, int, ...)>("open");
    const int log = real(plan().log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    (void)::dprintf(log, "%s\n", name);
    ::close(log);
  }
  return ++calls == plan().at;
}

void die() { (void)std::raise(plan().signal); }

void meet(const char* name) {
  if (is_next(name)) die();
}

bool creates(int flags) { return (flags & (O_CREAT | O_TRUNC)) != 0; }

}  // namespace

#define ORIGINAL(name, type) static const auto real = original<type>(name)

// These calls are handed on as they are.
#define PASS(result, name, parameters, types, ...) \
  extern "C" result name parameters {              \
    ORIGINAL(#name, result types);                 \
    meet(#name);                                   \
    return real(__VA_ARGS__);                      \
  }

PASS(int, fsync, (int file), (int), file)
PASS(int, ftruncate, (int file, off_t length) noexcept, (int, off_t), file, length)
PASS(int, fchmod, (int file, mode_t mode) noexcept, (int, mode_t), file, mode)
PASS(int, chmod, (const char* path, mode_t mode) noexcept, (const char*, mode_t), path, mode)
PASS(int, rename, (const char* from, const char* to) noexcept, (const char*, const char*), from, to)
PASS(int, renameat2, (int a, const char* from, int b, const char* to, unsigned flags) noexcept,
     (int, const char*, int, const char*, unsigned), a, from, b, to, flags)
PASS(int, mkdir, (const char* path, mode_t mode) noexcept, (const char*, mode_t), path, mode)
PASS(char*, mkdtemp, (char* path) noexcept, (char*), path)
PASS(int, mkostemp, (char* path, int flags), (char*, int), path, flags)
PASS(int, link, (const char* from, const char* to) noexcept, (const char*, const char*), from, to)
PASS(int, unlink, (const char* path) noexcept, (const char*), path)
PASS(int, unlinkat, (int at, const char* path, int flags) noexcept, (int, const char*, int), at, path, flags)
PASS(int, rmdir, (const char* path) noexcept, (const char*), path)
PASS(int, remove, (const char* path) noexcept, (const char*), path)
PASS(ssize_t, sendfile, (int to, int from, off_t* offset, std::size_t count) noexcept,
     (int, int, off_t*, std::size_t), to, from, offset, count)

// These calls change something only sometimes.
extern "C" int open(const char* path, int flags, ...) {
  ORIGINAL("open", int(const char*, int, ...));
  va_list more;
  va_start(more, flags);
  const int mode = creates(flags) ? va_arg(more, int) : 0;
  va_end(more);
  if (creates(flags)) meet("open");
  return real(path, flags, mode);
}

extern "C" std::FILE* fopen(const char* path, const char* mode) {
  ORIGINAL("fopen", std::FILE * (const char*, const char*));
  if (mode[0] != 'r') meet("fopen");
  return real(path, mode);
}

extern "C" std::FILE* fopen64(const char* path, const char* mode) {
  ORIGINAL("fopen64", std::FILE * (const char*, const char*));
  if (mode[0] != 'r') meet("fopen64");
  return real(path, mode);
}

extern "C" int fclose(std::FILE* file) {
  ORIGINAL("fclose", int(std::FILE*));
  if (__fwriting(file) != 0) meet("fclose");
  return real(file);
}

// Half of the bytes are in the file when the signal comes. Without KILL_TORN none of them is.
extern "C" std::size_t fwrite(const void* from, std::size_t size, std::size_t count, std::FILE* to) {
  ORIGINAL("fwrite", std::size_t(const void*, std::size_t, std::size_t, std::FILE*));
  if (to == stdout || to == stderr || !is_next("fwrite")) return real(from, size, count, to);
  if (plan().torn && size * count > 1) {
    real(from, 1, size * count / 2, to);
    std::fflush(to);
    die();
    const std::size_t left = size * count - size * count / 2;
    return real(static_cast<const char*>(from) + size * count / 2, 1, left, to) == left ? count : 0;
  }
  die();
  return real(from, size, count, to);
}

extern "C" int fflush(std::FILE* file) {
  ORIGINAL("fflush", int(std::FILE*));
  if (file != nullptr && file != stdout && file != stderr) meet("fflush");
  return real(file);
}

extern "C" ssize_t write(int to, const void* from, std::size_t count) {
  ORIGINAL("write", ssize_t(int, const void*, std::size_t));
  if (to > STDERR_FILENO) meet("write");
  return real(to, from, count);
}
