/// Writes a last line to standard error when the process crashes: which signal it was. Then the crash goes
/// on, and the service manager starts the exhibit again.
///
/// Threads  for the whole process; the line is written by whichever thread crashed, from its handler.
/// Errors   none. Under a sanitizer nothing is installed: the sanitizer says more.
#pragma once

namespace frustumscreen {

void leave_a_line_at_a_crash();

} // namespace frustumscreen
