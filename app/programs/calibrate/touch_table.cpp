#include "app/programs/calibrate/touch_table.h"

#include "app/programs/calibrate/touch_picture.h"

#include <thread>

namespace frustumscreen {

namespace {

constexpr Nanoseconds between_frames = std::chrono::milliseconds(20);

bool has_ended(TouchStage stage) {
    return stage == TouchStage::Done || stage == TouchStage::Anew || stage == TouchStage::Left;
}

} // namespace

TouchTable::TouchTable(const Settings& settings, TableDevices& devices)
    : devices_(devices), prop_px_(settings.prop.base_m * settings.projector.pinhole.fx /
                                  settings.projector.table_from_projector.translation.z) {}

Result<std::optional<TouchStage>> TouchTable::run(TouchProcedure& procedure, const Judge& judge) {
    while (!devices_.told_to_stop()) {
        const MonotonicTime now = monotonic_now();
        if (Result<void> shown = show(procedure, now); !shown) {
            return tl::unexpected<Error>(shown.error());
        }
        if (has_ended(procedure.stage())) {
            return std::optional(procedure.stage());
        }
        if (procedure.stage() == TouchStage::Solve) {
            procedure.judge(judge(procedure.touches()));
        }
        const TableDevices::Heard heard = devices_.hear(now);
        procedure.step({now, heard.report, heard.next, heard.back});
        std::this_thread::sleep_for(between_frames);
    }
    return std::optional<TouchStage>();
}

void TouchTable::stay(const TouchProcedure& procedure) {
    const MonotonicTime end = monotonic_now() + TableDevices::last_words;
    while (!devices_.told_to_stop() && monotonic_now() < end && show(procedure, monotonic_now())) {
        std::this_thread::sleep_for(between_frames);
    }
}

Result<void> TouchTable::show(const TouchProcedure& procedure, MonotonicTime now) {
    const Shown next{procedure.task(), procedure.stage(), procedure.word(), procedure.at()};
    if (next != shown_) {
        shown_ = next;
        devices_.say(touch_words(procedure), word_key(procedure));
        devices_.show(touch_picture(procedure, devices_.width(), devices_.height(), prop_px_,
                                    devices_.typesetter(), devices_.house()));
    }
    return devices_.present(now).map([](MonotonicTime) {});
}

} // namespace frustumscreen
