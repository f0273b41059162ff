#pragma once

namespace svnet {

/// Thrown in the thread that works after SIGINT, SIGTERM or SIGHUP, so that destructors remove what is half written.
/// Not a std::exception: nothing on the way may take it for a failure and carry on, or dress it up as one.
struct Interrupted {};

/// From now on the first of these signals is only remembered; the second one ends the process at once. Those that the
/// process was started to ignore it goes on ignoring.
void remember_interrupts();

/// Throws Interrupted where a signal has come.
void throw_if_interrupted();

}  // namespace svnet
