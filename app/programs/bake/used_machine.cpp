#include "app/programs/bake/used_machine.h"

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace frustumscreen {

namespace {

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// getrusage's figure would contain the memory of the process that started this one.
std::uint64_t peak_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmHWM:")) {
            return std::stoull(line.substr(6)) * 1024U;
        }
    }
    return 0;
}

} // namespace

UsedMachine used_machine() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return {seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime), peak_bytes()};
}

} // namespace frustumscreen
