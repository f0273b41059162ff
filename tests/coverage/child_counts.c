/* Preloaded library: lets the child processes of src/sandbox write what they counted. They end by _exit and may open
 * nothing, so that the counters of what they ran would be lost. For tests/coverage/run alone: it takes their limits. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int is_child; /* a process that asked for a filter of system calls */

int prctl(int option, ...) {
  va_list list;
  va_start(list, option);
  unsigned long arguments[4];
  for (int i = 0; i < 4; ++i) arguments[i] = va_arg(list, unsigned long);
  va_end(list);
  if (option == PR_SET_SECCOMP) {
    is_child = 1;
    signal(SIGUSR1, _exit);
    return 0;
  }
  return NEXT(prctl)(option, arguments[0], arguments[1], arguments[2], arguments[3]);
}

int setrlimit(__rlimit_resource_t resource, const struct rlimit* limit) {
  if (resource == RLIMIT_FSIZE || resource == RLIMIT_AS) return 0;
  return NEXT(setrlimit)(resource, limit);
}

/* A parent kills its child when it has what it asked for. */
int kill(pid_t process, int number) { return NEXT(kill)(process, number == SIGKILL ? SIGUSR1 : number); }

/* gcov writes its counters in the functions that the program runs at its end: those of the program itself, which come
 * first in the list of loaded objects. */
static int run_final_functions(struct dl_phdr_info* info, size_t size, void* unused) {
  (void)size;
  (void)unused;
  void (**functions)(void) = NULL;
  size_t bytes = 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    if (info->dlpi_phdr[i].p_type != PT_DYNAMIC) continue;
    const ElfW(Dyn)* entry = (const ElfW(Dyn)*)(info->dlpi_addr + info->dlpi_phdr[i].p_vaddr);
    for (; entry->d_tag != DT_NULL; ++entry) {
      if (entry->d_tag == DT_FINI_ARRAY) functions = (void (**)(void))(info->dlpi_addr + entry->d_un.d_ptr);
      if (entry->d_tag == DT_FINI_ARRAYSZ) bytes = entry->d_un.d_val;
    }
  }
  for (size_t i = bytes / sizeof *functions; i-- > 0;) functions[i]();
  return 1;
}

void _exit(int status) {
  if (is_child) dl_iterate_phdr(run_final_functions, NULL);
  syscall(SYS_exit_group, status);
  abort();
}
