/* Preloaded library: makes one system call that changes files below a folder fail, as a full or failing disk does.
 *   SVNET_FAULT_FOLDER  the folder, without links in its path
 *   SVNET_FAULT_AT      the number of the call, from 1 on; 0 or empty: none
 *   SVNET_FAULT_KIND    enospc, eio: that call fails; full: it and all later ones fail with ENOSPC; short: that call,
 * if it writes, writes half of its bytes SVNET_FAULT_COUNT   a file outside of the folder that receives the number of
 * calls at exit SVNET_FAULT_TRACE   if set, every call is named on stderr Counted are write, pwrite, writev, fwrite,
 * ftruncate, fsync, fdatasync, syncfs, rename, mkdir, and open with O_CREAT. stdio calls the kernel without going through these
 * names, so fwrite itself fails instead. svnet maps files for reading only. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long calls;
static const char* folder;
static long fault_at;
static enum { NONE, ENOSPC_ONCE, EIO_ONCE, FULL, SHORT } kind;

__attribute__((constructor)) static void read_environment(void) {
  const char* at = getenv("SVNET_FAULT_AT");
  const char* name = getenv("SVNET_FAULT_KIND");
  folder = getenv("SVNET_FAULT_FOLDER");
  fault_at = at ? atol(at) : 0;
  if (!name || !*name) name = "none";
  kind = !strcmp(name, "enospc")  ? ENOSPC_ONCE
         : !strcmp(name, "eio")   ? EIO_ONCE
         : !strcmp(name, "full")  ? FULL
         : !strcmp(name, "short") ? SHORT
                                  : NONE;
}

__attribute__((destructor)) static void write_count(void) {
  const char* path = getenv("SVNET_FAULT_COUNT");
  char text[32];
  if (!path) return;
  const int length = snprintf(text, sizeof text, "%ld\n", atomic_load(&calls));
  const int file = (int)syscall(SYS_openat, AT_FDCWD, path, O_CREAT | O_WRONLY | O_TRUNC, 0666);
  if (file < 0) return;
  syscall(SYS_write, file, text, (size_t)length);
  syscall(SYS_close, file);
}

static int is_below_folder(const char* path) {
  const size_t length = folder ? strlen(folder) : 0;
  return length > 0 && !strncmp(path, folder, length) && (path[length] == '/' || path[length] == '\0');
}

static int path_is_below(const char* path) {
  char parent[PATH_MAX], real[PATH_MAX];
  if (!folder || !path || strlen(path) >= sizeof parent) return 0;
  strcpy(parent, path);
  size_t length = strlen(parent);
  while (length > 1 && parent[length - 1] == '/') parent[--length] = '\0';
  char* slash = strrchr(parent, '/');
  if (!slash) {
    strcpy(parent, ".");
  } else {
    slash[slash == parent] = '\0';
  }
  return realpath(parent, real) && is_below_folder(real);
}

static int descriptor_is_below(int descriptor) {
  char link[32], path[PATH_MAX];
  if (!folder) return 0;
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length <= 0) return 0;
  path[length] = '\0';
  return is_below_folder(path);
}

/* Counts a call. 0: it goes on; -1: it fails with errno; 1: it writes half. */
static int verdict(const char* name, int is_below, int writes) {
  const int saved = errno;
  if (!is_below) return 0;
  const long number = atomic_fetch_add(&calls, 1) + 1;
  if (getenv("SVNET_FAULT_TRACE")) dprintf(STDERR_FILENO, "call %ld: %s\n", number, name);
  errno = saved;
  if (fault_at <= 0 || number < fault_at || (number > fault_at && kind != FULL)) return 0;
  switch (kind) {
    case NONE:
      return 0;
    case SHORT:
      return writes ? 1 : 0;
    case ENOSPC_ONCE:
    case FULL:
      errno = ENOSPC;
      return -1;
    case EIO_ONCE:
      errno = EIO;
      return -1;
  }
  return 0;
}

static size_t half_of(size_t size) { return size > 1 ? size / 2 : size; }

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int descriptor, const void* bytes, size_t size) {
  const int is_below = descriptor_is_below(descriptor);
  const int result = verdict("write", is_below, 1);
  if (result < 0) return -1;
  return NEXT(write)(descriptor, bytes, result ? half_of(size) : size);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  const int result = verdict("pwrite", descriptor_is_below(descriptor), 1);
  if (result < 0) return -1;
  return NEXT(pwrite)(descriptor, bytes, result ? half_of(size) : size, offset);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t offset) {
  const int result = verdict("pwrite", descriptor_is_below(descriptor), 1);
  if (result < 0) return -1;
  return NEXT(pwrite64)(descriptor, bytes, result ? half_of(size) : size, offset);
}

ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  const int result = verdict("writev", descriptor_is_below(descriptor), 1);
  if (result < 0) return -1;
  if (result && count > 0) return NEXT(write)(descriptor, parts[0].iov_base, half_of(parts[0].iov_len));
  return NEXT(writev)(descriptor, parts, count);
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  if (verdict("fwrite", descriptor_is_below(fileno(file)), 0) < 0) return 0;
  return NEXT(fwrite)(bytes, size, count, file);
}

int ftruncate(int descriptor, off_t size) {
  return verdict("ftruncate", descriptor_is_below(descriptor), 0) < 0 ? -1 : NEXT(ftruncate)(descriptor, size);
}

int ftruncate64(int descriptor, off64_t size) {
  return verdict("ftruncate", descriptor_is_below(descriptor), 0) < 0 ? -1 : NEXT(ftruncate64)(descriptor, size);
}

int fsync(int descriptor) {
  return verdict("fsync", descriptor_is_below(descriptor), 0) < 0 ? -1 : NEXT(fsync)(descriptor);
}

int fdatasync(int descriptor) {
  return verdict("fdatasync", descriptor_is_below(descriptor), 0) < 0 ? -1 : NEXT(fdatasync)(descriptor);
}

int syncfs(int descriptor) {
  return verdict("syncfs", descriptor_is_below(descriptor), 0) < 0 ? -1 : NEXT(syncfs)(descriptor);
}

int rename(const char* from, const char* to) {
  return verdict("rename", path_is_below(to), 0) < 0 ? -1 : NEXT(rename)(from, to);
}

int mkdir(const char* path, mode_t mode) {
  return verdict("mkdir", path_is_below(path), 0) < 0 ? -1 : NEXT(mkdir)(path, mode);
}

static mode_t mode_of(int flags, va_list arguments) { return flags & O_CREAT ? va_arg(arguments, mode_t) : 0; }

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  if ((flags & O_CREAT) && verdict("open", path_is_below(path), 0) < 0) return -1;
  return NEXT(open)(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_of(flags, arguments);
  va_end(arguments);
  if ((flags & O_CREAT) && verdict("open", path_is_below(path), 0) < 0) return -1;
  return NEXT(open64)(path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
  if (*mode != 'r' && verdict("fopen", path_is_below(path), 0) < 0) return NULL;
  return NEXT(fopen)(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  if (*mode != 'r' && verdict("fopen", path_is_below(path), 0) < 0) return NULL;
  return NEXT(fopen64)(path, mode);
}
