/// A last line on standard error when the process crashes: which signal. Then the crash takes
/// its course, and the service manager starts the exhibit again.
///
/// Threads  for the whole process; the line is written by whichever thread crashed, from its handler.
/// Errors   none. Under a sanitizer nothing is installed: it says more.
#pragma once

namespace frustumscreen {

void leave_a_line_at_a_crash();

} // namespace frustumscreen
