// A library to preload: programs that ask the processor what it can do learn of AVX2 and FMA, but not of AVX-512, AMX or
// VNNI. Libraries that have no switch of their own are so compared as they run on a computer with AVX2.
//
//     cc -shared -fPIC -O1 -o avx2_only.so bench/avx2_only.c && LD_PRELOAD=$PWD/avx2_only.so python3 ...
//
// Linux on x86-64 with CPUID faulting (cpuid_fault in /proc/cpuinfo): the instruction cpuid raises SIGSEGV, and the
// handler answers for it. Where that cannot be had, the program ends with status 1 before it starts.
#define _GNU_SOURCE
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#define ARCH_SET_CPUID 0x1012

static void hide(uint32_t* word, const int* bits, size_t count) {
  for (size_t i = 0; i < count; ++i) *word &= ~(UINT32_C(1) << bits[i]);
}
#define HIDE(word, ...) hide(&(word), (const int[]){__VA_ARGS__}, sizeof((const int[]){__VA_ARGS__}) / sizeof(int))

/// What cpuid leaves in eax, ebx, ecx and edx.
static void capped_cpuid(uint32_t leaf, uint32_t part, uint32_t out[4]) {
  syscall(SYS_arch_prctl, ARCH_SET_CPUID, 1);
  __asm__ volatile("cpuid" : "=a"(out[0]), "=b"(out[1]), "=c"(out[2]), "=d"(out[3]) : "a"(leaf), "c"(part));
  syscall(SYS_arch_prctl, ARCH_SET_CPUID, 0);
  if (leaf == 7 && part == 0) {
    HIDE(out[1], 16, 17, 21, 26, 27, 28, 30, 31);  // AVX-512: F, DQ, IFMA, PF, ER, CD, BW, VL
    HIDE(out[2], 1, 6, 11, 12, 14);                // AVX-512: VBMI, VBMI2, VNNI, BITALG, VPOPCNTDQ
    HIDE(out[3], 2, 3, 8, 22, 23, 24, 25);         // AVX-512: 4VNNIW, 4FMAPS, VP2INTERSECT, FP16; AMX
  } else if (leaf == 7 && part >= 1) {
    memset(out, 0, 4 * sizeof(uint32_t));  // AVX-VNNI, AVX-512 BF16, what came later
  } else if (leaf == 13 && part == 0) {
    HIDE(out[0], 5, 6, 7, 17, 18);  // the state of AVX-512 and AMX
  }
}

static void answer(int signal, siginfo_t* info, void* given) {
  (void)info;
  greg_t* const registers = ((ucontext_t*)given)->uc_mcontext.gregs;
  const uint8_t* const instruction = (const uint8_t*)registers[REG_RIP];
  if (instruction[0] != 0x0f || instruction[1] != 0xa2) {  // not cpuid: a fault of the program
    struct sigaction usual = {.sa_handler = SIG_DFL};
    sigaction(signal, &usual, NULL);
    return;
  }
  uint32_t out[4];
  capped_cpuid((uint32_t)registers[REG_RAX], (uint32_t)registers[REG_RCX], out);
  registers[REG_RAX] = out[0], registers[REG_RBX] = out[1], registers[REG_RCX] = out[2], registers[REG_RDX] = out[3];
  registers[REG_RIP] += 2;
}

__attribute__((constructor)) static void begin(void) {
  struct sigaction action = {.sa_sigaction = answer, .sa_flags = SA_SIGINFO | SA_NODEFER};
  sigaction(SIGSEGV, &action, NULL);
  if (syscall(SYS_arch_prctl, ARCH_SET_CPUID, 0) != 0) {
    fprintf(stderr, "avx2_only: this processor or system does not let cpuid fault\n");
    exit(1);
  }
}
