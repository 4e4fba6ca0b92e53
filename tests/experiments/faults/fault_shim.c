/* SPDX-License-Identifier: MIT */
/* Preloaded into a program: makes the n-th call of one kind fail as a full disk or a spent memory would.
 *
 *   FAULT_KIND   malloc, or one of the names in `kinds`
 *   FAULT_AT     which call fails, from 1; 0: none, calls are counted
 *   FAULT_STACK  of malloc instead: the call stack (hexadecimal hash) whose first call fails; calls before
 *                number FAULT_AT are not looked at, which is much faster
 *   FAULT_LOG    file that gets a line a call when none fails (of malloc one a stack: its hash, and the
 *                number of its first call), and "failed" when one does
 *
 * Allocations are told apart by their call stacks: eight return addresses, found by frame pointers'
 * absence through the unwinder, less the program's load address. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>
#include <unwind.h>

extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);

enum kind { MALLOC, WRITE, FSYNC, RENAME, OPEN, MKDIR, FTRUNCATE, CLOSE, FWRITE, UNLINK, POPEN, MEMFD, THREAD, RANDOM, KINDS };
static const char *const kinds[KINDS] = {"malloc", "write",     "fsync", "rename", "open",
                                         "mkdir",  "ftruncate", "close", "fwrite", "unlink",
                                         "popen",  "memfd",     "thread", "getrandom"};
static const int reason[KINDS] = {ENOMEM, ENOSPC, EIO, EIO, EMFILE, ENOSPC, EIO, EIO, ENOSPC, EIO, ENOMEM, EMFILE, EAGAIN, ENOSYS};

static int ready, kind = -1, log_file = -1, has_failed;
static long at, counts[KINDS];
static uint64_t stack_wanted;
static __thread int inside;

/* The hashes seen; open addressing. */
enum { SLOTS = 1 << 18 };
static uint64_t seen[SLOTS];

static void say(const char *text) {
  if (log_file >= 0) syscall(SYS_write, log_file, text, strlen(text));
}

/* What the program does before its main, and other programs that it starts, are left alone. */
static void begin(void) {
  const char *named = getenv("FAULT_KIND"), *log = getenv("FAULT_LOG");
  if (!named || strncmp(program_invocation_short_name, "sunder", 6) != 0) return;
  for (int k = 0; k < KINDS; ++k) {
    if (strcmp(named, kinds[k]) == 0) kind = k;
  }
  if (getenv("FAULT_AT")) at = atol(getenv("FAULT_AT"));
  if (getenv("FAULT_STACK")) stack_wanted = strtoull(getenv("FAULT_STACK"), NULL, 16);
  if (log) log_file = (int)syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  ready = kind >= 0;
}

static int (*real_main)(int, char **, char **);
static int main_with_faults(int argc, char **argv, char **environment) {
  begin();
  const int code = real_main(argc, argv, environment);
  ready = 0;
  return code;
}
int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void), void (*fini)(void),
                      void (*rtld_fini)(void), void *stack_end) {
  real_main = main;
  __typeof__(&__libc_start_main) real = (__typeof__(&__libc_start_main))dlsym(RTLD_NEXT, "__libc_start_main");
  return real(main_with_faults, argc, argv, init, fini, rtld_fini, stack_end);
}

struct trace {
  uint64_t hash;
  int depth;
};

static int find_base(struct dl_phdr_info *info, size_t size, void *data) {
  (void)size;
  uintptr_t *pair = data; /* address, base */
  for (int k = 0; k < info->dlpi_phnum; ++k) {
    const ElfW(Phdr) *p = &info->dlpi_phdr[k];
    if (p->p_type != PT_LOAD) continue;
    const uintptr_t from = info->dlpi_addr + p->p_vaddr;
    if (pair[0] >= from && pair[0] < from + p->p_memsz) {
      pair[1] = info->dlpi_addr;
      return 1;
    }
  }
  return 0;
}

static _Unwind_Reason_Code add_frame(struct _Unwind_Context *context, void *data) {
  struct trace *t = data;
  uintptr_t pair[2] = {_Unwind_GetIP(context), 0};
  if (t->depth >= 3) { /* past this library's own */
    dl_iterate_phdr(find_base, pair);
    t->hash = (t->hash ^ (pair[0] - pair[1])) * 0x100000001b3u;
  }
  return ++t->depth >= 14 ? _URC_END_OF_STACK : _URC_NO_REASON;
}

/* Whether this allocation is the one to fail. */
static int allocation_fails(void) {
  if (!ready || kind != MALLOC || inside) return 0;
  inside = 1;
  int fails = 0;
  const long count = __sync_add_and_fetch(&counts[MALLOC], 1);
  if (count >= at && !has_failed) {
    struct trace t = {0xcbf29ce484222325u, 0};
    _Unwind_Backtrace(add_frame, &t);
    if (stack_wanted != 0) {
      fails = t.hash == stack_wanted && __sync_bool_compare_and_swap(&has_failed, 0, 1);
    } else {
      uint64_t slot = t.hash % SLOTS;
      while (seen[slot] != 0 && seen[slot] != t.hash) slot = (slot + 1) % SLOTS;
      if (seen[slot] == 0) {
        seen[slot] = t.hash;
        char line[48];
        snprintf(line, sizeof line, "%016llx %ld\n", (unsigned long long)t.hash, count);
        say(line);
      }
    }
  }
  if (fails) say("failed\n");
  inside = 0;
  if (fails) errno = ENOMEM;
  return fails;
}

void *malloc(size_t size) { return allocation_fails() ? NULL : __libc_malloc(size); }
void *calloc(size_t items, size_t size) {
  return allocation_fails() ? NULL : __libc_calloc(items, size);
}
void *realloc(void *block, size_t size) {
  return allocation_fails() ? NULL : __libc_realloc(block, size);
}

/* Whether a call of another kind is the one to fail; errno says why then. */
static int fails(enum kind which) {
  if (!ready || kind != (int)which || inside) return 0;
  const long count = __sync_add_and_fetch(&counts[which], 1);
  if (at == 0) {
    say("call\n");
    return 0;
  }
  if (count != at) return 0;
  say("failed\n");
  errno = reason[which];
  return 1;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

ssize_t write(int file, const void *bytes, size_t size) {
  /* A full disk takes a part first. */
  if (fails(WRITE)) {
    if (size > 1) syscall(SYS_write, file, bytes, size / 2);
    errno = ENOSPC;
    return -1;
  }
  return syscall(SYS_write, file, bytes, size);
}
ssize_t pwrite(int file, const void *bytes, size_t size, off_t place) {
  return fails(WRITE) ? -1 : REAL(pwrite)(file, bytes, size, place);
}
ssize_t writev(int file, const struct iovec *parts, int count) {
  return fails(WRITE) ? -1 : syscall(SYS_writev, file, parts, count);
}
size_t fwrite(const void *bytes, size_t size, size_t count, FILE *file) {
  return fails(FWRITE) ? 0 : REAL(fwrite)(bytes, size, count, file);
}
int fsync(int file) { return fails(FSYNC) ? -1 : REAL(fsync)(file); }
int rename(const char *from, const char *to) { return fails(RENAME) ? -1 : REAL(rename)(from, to); }
int mkdir(const char *path, mode_t mode) { return fails(MKDIR) ? -1 : REAL(mkdir)(path, mode); }
int ftruncate(int file, off_t size) { return fails(FTRUNCATE) ? -1 : REAL(ftruncate)(file, size); }
FILE *popen(const char *command, const char *how) { return fails(POPEN) ? NULL : REAL(popen)(command, how); }
int memfd_create(const char *name, unsigned flags) { return fails(MEMFD) ? -1 : REAL(memfd_create)(name, flags); }
int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument) {
  return fails(THREAD) ? EAGAIN : REAL(pthread_create)(thread, attributes, run, argument);
}
ssize_t getrandom(void *bytes, size_t size, unsigned flags) {
  return fails(RANDOM) ? -1 : REAL(getrandom)(bytes, size, flags);
}
int unlink(const char *path) { return fails(UNLINK) ? -1 : REAL(unlink)(path); }
int close(int file) {
  if (fails(CLOSE)) {
    syscall(SYS_close, file);
    errno = EIO;
    return -1;
  }
  return (int)syscall(SYS_close, file);
}

int open(const char *path, int flags, ...) {
  mode_t mode = 0;
  if (flags & (O_CREAT | O_TMPFILE)) {
    va_list rest;
    va_start(rest, flags);
    mode = va_arg(rest, mode_t);
    va_end(rest);
  }
  if (fails(OPEN)) return -1;
  return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}
FILE *fopen(const char *path, const char *how) {
  return fails(OPEN) ? NULL : REAL(fopen)(path, how);
}
FILE *fopen64(const char *path, const char *how) {
  return fails(OPEN) ? NULL : REAL(fopen64)(path, how);
}
