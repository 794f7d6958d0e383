#include "app/programs/calibrate/table_rounds.h"

#include <thread>

namespace frustumscreen {

Result<bool> run_rounds(const TableDevices& devices, const TableRounds& rounds) {
    while (!devices.told_to_stop()) {
        const MonotonicTime now = monotonic_now();
        if (Result<void> shown = rounds.show(now); !shown) {
            return tl::unexpected<Error>(shown.error());
        }
        if (rounds.has_ended()) {
            return true;
        }
        rounds.step(now);
        std::this_thread::sleep_for(rounds.between);
    }
    return false;
}

void stay(const TableDevices& devices, const TableRounds& rounds) {
    const MonotonicTime end = monotonic_now() + TableDevices::last_words;
    while (!devices.told_to_stop() && monotonic_now() < end && rounds.show(monotonic_now())) {
        std::this_thread::sleep_for(rounds.between);
    }
}

} // namespace frustumscreen
