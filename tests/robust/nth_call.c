// A library to preload: at its n-th call that changes a file under a directory, the process is killed or stopped,
// or the call fails. It stands between the program and the C library, so that the program that is tested is the
// one that is used.
//   NTH_UNDER   the directory, as the program names it
//   NTH_CALL    n, from 1; 0: nothing happens
//   NTH_ACTION  kill, stop, once (the call fails with EIO) or full (it and all later ones fail with ENOSPC)
//   NTH_MATCH   only calls whose path holds this text are counted
//   NTH_TOLD    a file that gets the path of the call before it is acted on
//   NTH_RANK    the rank of Open MPI that this is for; without it, every process
//   NTH_COUNT   a file to which each process appends the number of its calls at its end
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static long calls;

static int is_meant(const char* path) {
  const char* under = getenv("NTH_UNDER");
  const char* rank = getenv("NTH_RANK");
  const char* own = getenv("OMPI_COMM_WORLD_RANK");
  const char* match = getenv("NTH_MATCH");
  if (under == NULL || path == NULL || strncmp(path, under, strlen(under)) != 0) return 0;
  if (match != NULL && strstr(path + strlen(under), match) == NULL) return 0;
  return rank == NULL || (own != NULL && strcmp(rank, own) == 0);
}

/// Appends a line to the file that an environment variable names, if it does.
static void append(const char* variable, const char* line) {
  const char* file = getenv(variable);
  FILE* out = file == NULL ? NULL : fopen(file, "a");
  if (out == NULL) return;
  fprintf(out, "%s\n", line);
  fclose(out);
}

/// The error that the call is to fail with, 0 for none.
static int fault_at(const char* path) {
  const char* number = getenv("NTH_CALL");
  const char* action = getenv("NTH_ACTION");
  if (!is_meant(path)) return 0;
  ++calls;
  const long n = number == NULL ? 0 : atol(number);
  if (n <= 0 || action == NULL || calls < n) return 0;
  if (strcmp(action, "full") == 0) return ENOSPC;
  if (calls > n) return 0;
  append("NTH_TOLD", path);
  if (strcmp(action, "kill") == 0) kill(getpid(), SIGKILL);
  if (strcmp(action, "stop") == 0) kill(getpid(), SIGSTOP);
  return strcmp(action, "once") == 0 ? EIO : 0;
}

static int fault_of(int fd) {
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t n = readlink(link, path, sizeof path - 1);
  if (n < 0) return 0;
  path[n] = 0;
  return fault_at(path);
}

__attribute__((destructor)) static void tell(void) {
  char line[32];
  snprintf(line, sizeof line, "%ld", calls);
  if (calls > 0) append("NTH_COUNT", line);
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define FAIL_WHERE(fault)    \
  do {                       \
    const int code = fault;  \
    if (code != 0) {         \
      errno = code;          \
      return -1;             \
    }                        \
  } while (0)

#define OPEN(name)                                                                  \
  int name(const char* path, int flags, ...) {                                      \
    mode_t mode = 0;                                                                \
    if ((flags & O_CREAT) != 0) {                                                   \
      va_list rest;                                                                 \
      va_start(rest, flags);                                                        \
      mode = va_arg(rest, mode_t);                                                  \
      va_end(rest);                                                                 \
    }                                                                               \
    if ((flags & O_ACCMODE) != O_RDONLY) FAIL_WHERE(fault_at(path));                \
    return NEXT(name)(path, flags, mode);                                           \
  }
OPEN(open)
OPEN(open64)

ssize_t write(int fd, const void* bytes, size_t size) {
  FAIL_WHERE(fault_of(fd));
  return NEXT(write)(fd, bytes, size);
}
int rename(const char* from, const char* to) {
  FAIL_WHERE(fault_at(to));
  return NEXT(rename)(from, to);
}
int renameat2(int from_at, const char* from, int to_at, const char* to, unsigned flags) {
  FAIL_WHERE(fault_at(to));
  return NEXT(renameat2)(from_at, from, to_at, to, flags);
}
int fsync(int fd) {
  FAIL_WHERE(fault_of(fd));
  return NEXT(fsync)(fd);
}
int syncfs(int fd) {
  FAIL_WHERE(fault_of(fd));
  return NEXT(syncfs)(fd);
}
int ftruncate64(int fd, off64_t size) {
  FAIL_WHERE(fault_of(fd));
  return NEXT(ftruncate64)(fd, size);
}
int ftruncate(int fd, off_t size) {
  FAIL_WHERE(fault_of(fd));
  return NEXT(ftruncate)(fd, size);
}
int mkdir(const char* path, mode_t mode) {
  FAIL_WHERE(fault_at(path));
  return NEXT(mkdir)(path, mode);
}
