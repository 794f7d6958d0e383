#include "app/programs/calibrate/table_rounds.h"

#include <thread>

namespace frustumscreen {

namespace {

void wait(TableDevices& devices, const TableRounds& rounds) {
    if (devices.is_headless() && !rounds.with_camera) {
        devices.pass_over(rounds.between);
    } else {
        std::this_thread::sleep_for(rounds.between);
    }
}

} // namespace

Result<bool> run_rounds(TableDevices& devices, const TableRounds& rounds) {
    while (!devices.told_to_stop()) {
        const MonotonicTime now = devices.now();
        TRY_VOID(rounds.show(now));
        if (rounds.has_ended()) {
            return true;
        }
        rounds.step(now);
        wait(devices, rounds);
    }
    return false;
}

void stay(TableDevices& devices, const TableRounds& rounds) {
    const MonotonicTime end = devices.now() + TableDevices::last_words;
    while (!devices.told_to_stop() && devices.now() < end && rounds.show(devices.now())) {
        wait(devices, rounds);
    }
}

} // namespace frustumscreen
