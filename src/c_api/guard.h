#pragma once
#include <exception>
#include <new>

#include "base/error.h"
#include "base/fixed_threads.h"
#include "svnet/svnet.h"

// How functions of svnet.h end: exceptions become a status and the text of svnet_last_error().
namespace svnet {

/// Keeps `text` as the last error of this thread and returns `status`. Allocates nothing.
svnet_status failed(svnet_status status, const char* text) noexcept;
const char* last_failure() noexcept;

/// Runs `body`. Returns SVNET_OK, or the status of the exception that it throws; `user_error` for Error.
template <class Body>
svnet_status guarded(svnet_status user_error, const Body& body) noexcept {
  try {
    body();
    return SVNET_OK;
  } catch (const Error& error) {
    return failed(user_error, error.what());
  } catch (const std::bad_alloc&) {
    return failed(SVNET_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return failed(SVNET_INTERNAL_ERROR, error.what());
  } catch (...) {
    return failed(SVNET_INTERNAL_ERROR, "unknown exception");
  }
}

/// guarded for bodies that compute; svnet_set_threads waits for them.
template <class Body>
svnet_status computed(svnet_status user_error, const Body& body) noexcept {
  return guarded(user_error, [&] {
    const FixedThreads threads;
    body();
  });
}

inline void check_given(const void* pointer, const char* function, const char* name) {
  check(pointer != nullptr, "[", function, "] ", name, " is NULL");
}

}  // namespace svnet
