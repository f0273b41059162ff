#pragma once

namespace svnet::command {

/// Thrown in the working thread after SIGINT, SIGTERM or SIGHUP, so that destructors remove incomplete files. It is not
/// a std::exception, so that no handler for failures catches it.
struct Interrupted {};

/// From now on the first of these signals is only remembered, and the second one ends the process at once. A signal
/// that was ignored when the process started stays ignored.
void remember_interrupts();

/// Throws Interrupted if a signal has been remembered.
void throw_if_interrupted();

}  // namespace svnet::command
