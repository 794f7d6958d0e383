#include "firmware_host/service/crash_line.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace frustumscreen {

namespace {

/// Does only what a signal handler may do.
extern "C" void say(int signal) {
    std::string_view line = "frustumscreen: crashed\n";
    switch (signal) {
    case SIGSEGV:
        line = "frustumscreen: crashed: memory that is not there (SIGSEGV)\n";
        break;
    case SIGBUS:
        line = "frustumscreen: crashed: memory or a file's page that cannot be read (SIGBUS)\n";
        break;
    case SIGILL:
        line = "frustumscreen: crashed: an instruction that this processor does not have (SIGILL)\n";
        break;
    case SIGFPE:
        line = "frustumscreen: crashed: arithmetic that cannot be done (SIGFPE)\n";
        break;
    case SIGABRT:
        line = "frustumscreen: crashed: it gave up, or was told to (SIGABRT)\n";
        break;
    default:
        break;
    }
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
    ::raise(signal); // SA_RESETHAND: now it ends the process
}

} // namespace

void leave_a_line_at_a_crash() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) {
        struct sigaction action {};
        action.sa_handler = say;
        action.sa_flags = static_cast<int>(SA_RESETHAND | SA_NODEFER);
        ::sigaction(signal, &action, nullptr);
    }
#endif
}

} // namespace frustumscreen
