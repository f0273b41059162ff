#include "sandbox/syscall_filter.h"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace svnet::sandbox {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;
#endif

constexpr long kAllowed[] = {
    // descriptors that are open already
    SYS_read, SYS_readv, SYS_pread64, SYS_write, SYS_writev, SYS_lseek, SYS_fstat, SYS_close, SYS_sendmsg, SYS_recvmsg,
    SYS_sendto, SYS_recvfrom,
    // its own memory
    SYS_brk, SYS_munmap, SYS_mremap, SYS_madvise,
    // itself
    SYS_exit, SYS_exit_group, SYS_futex, SYS_getpid, SYS_gettid, SYS_rt_sigaction, SYS_rt_sigprocmask, SYS_rt_sigreturn,
    SYS_sigaltstack, SYS_restart_syscall, SYS_sched_yield, SYS_getrusage,
#ifdef SVNET_SANITIZED
    SYS_pipe2,  // how the sanitizers look whether memory can be read
#if defined(__x86_64__)
    SYS_pipe,
#endif
#endif
    // clocks and random numbers
    SYS_clock_gettime, SYS_clock_getres, SYS_clock_nanosleep, SYS_nanosleep, SYS_gettimeofday, SYS_getrandom};

/// With memory that cannot be executed.
constexpr long kAllowedWithoutExecution[] = {SYS_mmap, SYS_mprotect};

/// No decoder needs them: to ask for one is an attack.
constexpr long kDeadly[] = {SYS_execve,  SYS_execveat, SYS_clone,  SYS_clone3,           SYS_socket,
                            SYS_connect, SYS_bind,     SYS_ptrace, SYS_process_vm_readv, SYS_process_vm_writev,
#if defined(__x86_64__)
                            SYS_fork,    SYS_vfork
#endif
};

/// Checks in a row: each either answers or falls through to the next one.
class Program {
 public:
  void load(std::size_t offset) { add(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset))); }
  void answer(std::uint32_t action) { add(BPF_STMT(BPF_RET | BPF_K, action)); }
  void skip_unless_equal(std::uint32_t value, std::uint8_t instructions) {
    add(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, instructions));
  }
  void skip_if_equal(std::uint32_t value, std::uint8_t instructions) {
    add(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, instructions, 0));
  }
  void skip_unless_bits(std::uint32_t bits, std::uint8_t instructions) {
    add(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, 0, instructions));
  }
  std::vector<sock_filter>& instructions() { return instructions_; }

 private:
  void add(sock_filter instruction) { instructions_.push_back(instruction); }
  std::vector<sock_filter> instructions_;
};

constexpr std::uint32_t kRefuse = SECCOMP_RET_ERRNO | EPERM;

/// The lower half of an argument, on little-endian machines.
constexpr std::size_t argument(std::size_t i) { return offsetof(seccomp_data, args) + 8 * i; }

Program filter() {
  Program program;
  program.load(offsetof(seccomp_data, arch));
  program.skip_if_equal(kArchitecture, 1);
  program.answer(SECCOMP_RET_KILL_PROCESS);
  program.load(offsetof(seccomp_data, nr));
  for (const long number : kAllowed) {
    program.skip_unless_equal(static_cast<std::uint32_t>(number), 1);
    program.answer(SECCOMP_RET_ALLOW);
  }
  for (const long number : kDeadly) {
    program.skip_unless_equal(static_cast<std::uint32_t>(number), 1);
    program.answer(SECCOMP_RET_KILL_PROCESS);
  }
  for (const long number : kAllowedWithoutExecution) {
    program.skip_unless_equal(static_cast<std::uint32_t>(number), 4);
    program.load(argument(2));
    program.skip_unless_bits(PROT_EXEC, 1);
    program.answer(kRefuse);
    program.answer(SECCOMP_RET_ALLOW);
  }
  // abort() sends its signal to its own process.
  program.skip_unless_equal(SYS_tgkill, 4);
  program.load(argument(0));
  program.skip_unless_equal(static_cast<std::uint32_t>(::getpid()), 1);
  program.answer(SECCOMP_RET_ALLOW);
  program.answer(SECCOMP_RET_KILL_PROCESS);
  program.answer(kRefuse);
  return program;
}

}  // namespace

const char* install_syscall_filter() {
  errno = 0;
  if (kArchitecture == 0) return "there is no filter of system calls for this processor";
  Program program = filter();
  const sock_fprog filter_program{static_cast<unsigned short>(program.instructions().size()),
                                  program.instructions().data()};
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return "no_new_privs";
  if (::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter_program, 0, 0) != 0) return "seccomp";
  return nullptr;
}

}  // namespace svnet::sandbox
