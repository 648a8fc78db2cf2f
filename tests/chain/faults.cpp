// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program by fault_test: from the Nth call on by which it changes what lies below
// a folder, every such call fails, as on a disk that is full or has gone; or it is interrupted
// there. Calls are told through the environment:
//   FAULT_FOLDER  absolute, without a slash at its end
//   FAULT_ERRNO   what the calls fail with; 0: the Nth raises SIGINT and goes on
//   FAULT_AT      N, from 1; 0: none fails
//   FAULT_COUNT   a file outside of the folder, which the number of calls is written to at the end
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

struct Faults {
  std::string folder = setting("FAULT_FOLDER") + "/";
  std::string counted = setting("FAULT_COUNT");
  int error = std::atoi(setting("FAULT_ERRNO").c_str());
  long at = std::atol(setting("FAULT_AT").c_str());
  pid_t process = getpid();
  std::atomic<long> calls{0};
};

// Never destroyed: programs write until their very end.
Faults& faults() {
  static Faults& only = *new Faults;
  return only;
}

__attribute__((constructor)) void begin() { faults(); }

__attribute__((destructor)) void end() {
  if (getpid() != faults().process) return;
  const int file = open(faults().counted.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  dprintf(file, "%ld\n", faults().calls.load());
  close(file);
}

// What a descriptor is open for, or "".
std::string path_of(int descriptor) {
  std::string path(4096, '\0');
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = readlink(link.c_str(), path.data(), path.size());
  path.resize(length < 0 ? 0 : static_cast<std::size_t>(length));
  return path;
}

std::string absolute(int folder, const char* path) {
  if (path[0] == '/') return path;
  return (folder == AT_FDCWD ? std::string(get_current_dir_name()) : path_of(folder)) + "/" + path;
}

// Counts a call that changes `path`; whether it is to fail, errno then set.
bool fails(std::string_view path) {
  Faults& all = faults();
  if (!path.starts_with(all.folder)) return false;
  const long call = ++all.calls;
  if (all.at == 0 || call < all.at) return false;
  if (all.error == 0) {
    if (call == all.at) kill(getpid(), SIGINT);
    return false;
  }
  errno = all.error;
  return true;
}

bool fails(int folder, const char* path) {
  const int before = errno;
  const bool failing = fails(absolute(folder, path));
  if (!failing) errno = before;
  return failing;
}

bool fails(int descriptor) {
  const int before = errno;
  const bool writable = (fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY;
  const bool failing = writable && fails(path_of(descriptor));
  if (!failing) errno = before;
  return failing;
}

bool fails(FILE* file) {
  const bool failing = fails(fileno(file));
  if (failing) file->_flags |= _IO_ERR_SEEN;  // as the C library does
  return failing;
}

bool changes(int flags) { return (flags & (O_CREAT | O_TRUNC)) != 0; }

bool changes(const char* mode) {
  return std::string_view(mode).find_first_of("wa+") != std::string_view::npos;
}

// The C library's own function of that name.
template <class Function>
Function* real(Function* /*ours*/, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// The arguments in parentheses, as they are declared and as they are handed on.
#define PLOTSCAN_FAULT(TYPE, NAME, DECLARED, PASSED, FAILING, FAILED) \
  extern "C" TYPE NAME DECLARED {                                     \
    static const auto original = real(&NAME, #NAME);                  \
    if (FAILING) return FAILED;                                       \
    return original PASSED;                                           \
  }

// A mode follows where a file may be made; elsewhere it is of no account.
#define PLOTSCAN_FAULT_OPEN(NAME, FOLDER, DECLARED, ...)                                     \
  extern "C" int NAME DECLARED {                                                             \
    static const auto original = reinterpret_cast<int(*) DECLARED>(dlsym(RTLD_NEXT, #NAME)); \
    va_list rest;                                                                            \
    va_start(rest, flags);                                                                   \
    const mode_t mode = va_arg(rest, mode_t);                                                \
    va_end(rest);                                                                            \
    if (changes(flags) && fails(FOLDER, path)) return -1;                                    \
    return original(__VA_ARGS__, mode);                                                      \
  }

PLOTSCAN_FAULT_OPEN(open, AT_FDCWD, (const char* path, int flags, ...), path, flags)
PLOTSCAN_FAULT_OPEN(open64, AT_FDCWD, (const char* path, int flags, ...), path, flags)
PLOTSCAN_FAULT_OPEN(openat, folder, (int folder, const char* path, int flags, ...), folder, path,
                    flags)
PLOTSCAN_FAULT_OPEN(openat64, folder, (int folder, const char* path, int flags, ...), folder, path,
                    flags)
PLOTSCAN_FAULT(FILE*, fopen, (const char* path, const char* mode), (path, mode),
               changes(mode) && fails(AT_FDCWD, path), nullptr)
PLOTSCAN_FAULT(FILE*, fopen64, (const char* path, const char* mode), (path, mode),
               changes(mode) && fails(AT_FDCWD, path), nullptr)
PLOTSCAN_FAULT(ssize_t, write, (int file, const void* bytes, size_t count), (file, bytes, count),
               fails(file), -1)
PLOTSCAN_FAULT(ssize_t, writev, (int file, const iovec* parts, int count), (file, parts, count),
               fails(file), -1)
PLOTSCAN_FAULT(ssize_t, pwrite64, (int file, const void* bytes, size_t count, off64_t offset),
               (file, bytes, count, offset), fails(file), -1)
PLOTSCAN_FAULT(size_t, fwrite, (const void* bytes, size_t size, size_t count, FILE* file),
               (bytes, size, count, file), fails(file), 0)
PLOTSCAN_FAULT(int, fflush, (FILE * file), (file), file != nullptr && fails(file), EOF)
PLOTSCAN_FAULT(int, ftruncate64, (int file, off64_t length), (file, length), fails(file), -1)
PLOTSCAN_FAULT(int, posix_fallocate64, (int file, off64_t offset, off64_t length),
               (file, offset, length), fails(file), errno)
PLOTSCAN_FAULT(int, fsync, (int file), (file), fails(file), -1)
PLOTSCAN_FAULT(int, mkdir, (const char* path, mode_t mode), (path, mode), fails(AT_FDCWD, path), -1)
PLOTSCAN_FAULT(int, rename, (const char* from, const char* to), (from, to), fails(AT_FDCWD, to), -1)
PLOTSCAN_FAULT(int, renameat2,
               (int from_folder, const char* from, int to_folder, const char* to, unsigned flags),
               (from_folder, from, to_folder, to, flags), fails(to_folder, to), -1)
PLOTSCAN_FAULT(int, link, (const char* from, const char* to), (from, to), fails(AT_FDCWD, to), -1)
PLOTSCAN_FAULT(int, symlink, (const char* from, const char* to), (from, to), fails(AT_FDCWD, to),
               -1)

// What fails to close is closed all the same.
extern "C" int close(int file) {
  static const auto original = real(&close, "close");
  const bool failing = fails(file);
  const int error = errno;
  const int closed = original(file);
  if (failing) errno = error;
  return failing ? -1 : closed;
}

extern "C" int fclose(FILE* file) {
  static const auto original = real(&fclose, "fclose");
  const bool failing = fails(file);
  const int error = errno;
  const int closed = original(file);
  if (failing) errno = error;
  return failing ? EOF : closed;
}
