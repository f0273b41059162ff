#pragma once

namespace svnet::sandbox {

/// Installs, for the calling thread and for good, a seccomp filter (Linux, x86-64 and aarch64) after which it can use
/// the descriptors that it has open, its own memory, clocks and random numbers. Whatever else it asks of the kernel
/// (files, permissions, executable memory) fails with EPERM; programs, processes, connections and other processes'
/// memory kill it with SIGSYS. Returns null, or, in static text, what the system refuses; errno says why, if not 0.
const char* install_syscall_filter();

}  // namespace svnet::sandbox
