/// Returns freed memory to the system.
///
/// Cause    the C library keeps freed memory for later requests, and small pieces that are still in use keep the
///          freed memory around them. After an artifact is read and uploaded, some 80 MB are kept in this way.
/// Threads  any. An allocation of another thread may wait for some milliseconds.
/// Errors   none.
/// Library  glibc: malloc_trim.
#pragma once

namespace frustumscreen {

void return_spare_memory();

} // namespace frustumscreen
