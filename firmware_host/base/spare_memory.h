/// Freed memory back to the system.
///
/// Cause    the C library keeps freed memory for later requests; small pieces that are still in use between freed ones hold on to all around
///          them. After an artifact is read and uploaded that is some 80 MB.
/// Threads  any. An allocation of another thread may wait for some milliseconds.
/// Errors   none.
/// Library  glibc: malloc_trim.
#pragma once

namespace frustumscreen {

void return_spare_memory();

} // namespace frustumscreen
