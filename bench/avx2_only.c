// A library for LD_PRELOAD: programs believe that the processor has no AVX-512, AVX-VNNI and AMX. So a peer that chooses its
// kernels by CPUID can be timed as on a processor with AVX2. The kernel makes CPUID fault (arch_prctl, Linux on x86-64, on
// processors with CPUID faulting), and the handler of that signal answers it. Without that the process exits with status
// 77: a peer that is not capped must not be taken for one that is.
//
//     cc -O2 -shared -fPIC -o avx2_only.so bench/avx2_only.c
//     LD_PRELOAD=$PWD/avx2_only.so python ...
#define _GNU_SOURCE
#include <cpuid.h>
#include <signal.h>
#include <stdio.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#define ARCH_CPUID_SET 0x1012

static int allow_cpuid(int allowed) { return (int)syscall(SYS_arch_prctl, ARCH_CPUID_SET, (long)allowed); }

static void answer(int signal_number, siginfo_t* info, void* context) {
  (void)info;
  greg_t* registers = ((ucontext_t*)context)->uc_mcontext.gregs;
  const unsigned char* instruction = (const unsigned char*)registers[REG_RIP];
  if (instruction[0] != 0x0f || instruction[1] != 0xa2) {  // another fault: happens again, without this handler
    signal(signal_number, SIG_DFL);
    return;
  }
  const unsigned leaf = (unsigned)registers[REG_RAX], part = (unsigned)registers[REG_RCX];
  unsigned a, b, c, d;
  allow_cpuid(1);
  __cpuid_count(leaf, part, a, b, c, d);
  allow_cpuid(0);
  if (leaf == 7 && part == 0) {
    b &= ~(1u << 16 | 1u << 17 | 1u << 21 | 1u << 26 | 1u << 27 | 1u << 28 | 1u << 30 | 1u << 31);
    c &= ~(1u << 1 | 1u << 6 | 1u << 11 | 1u << 12 | 1u << 14);
    d &= ~(1u << 2 | 1u << 3 | 1u << 8 | 1u << 22 | 1u << 23 | 1u << 24 | 1u << 25);
  }
  if (leaf == 7 && part == 1) a &= ~(1u << 4 | 1u << 5 | 1u << 21 | 1u << 23);
  registers[REG_RAX] = a, registers[REG_RBX] = b, registers[REG_RCX] = c, registers[REG_RDX] = d;
  registers[REG_RIP] += 2;
}

__attribute__((constructor)) static void start(void) {
  const struct sigaction action = {.sa_sigaction = answer, .sa_flags = SA_SIGINFO | SA_NODEFER};
  if (sigaction(SIGSEGV, &action, NULL) == 0 && allow_cpuid(0) == 0) return;
  fputs("avx2_only: this machine cannot make CPUID fault\n", stderr);
  _exit(77);
}
