#include "app/programs/calibrate/touch_table.h"

#include "app/programs/calibrate/table_pictures.h"
#include "app/programs/calibrate/table_rounds.h"

namespace frustumscreen {

TouchTable::TouchTable(const Settings& settings, TableDevices& devices)
    : devices_(devices), prop_px_(settings.prop.base_m * settings.projector.pinhole.fx /
                                  settings.projector.table_from_projector.translation.z) {}

Result<std::optional<CalibrationStage>> TouchTable::run(TouchProcedure& procedure, const Judge& judge) {
    TableRounds rounds;
    rounds.show = [&](MonotonicTime now) { return show(procedure, now); };
    rounds.has_ended = [&] { return procedure.has_ended(); };
    rounds.step = [&](MonotonicTime now) {
        if (procedure.stage() == CalibrationStage::Solve) {
            procedure.judge(judge(procedure.touches()));
        }
        const TableDevices::Heard heard = devices_.hear(now);
        procedure.step({now, heard.prop, heard.next, heard.back});
    };
    return run_rounds(devices_, rounds).map([&](bool ended) {
        return ended ? std::optional(procedure.stage()) : std::nullopt;
    });
}

void TouchTable::stay(const TouchProcedure& procedure) {
    TableRounds rounds;
    rounds.show = [&](MonotonicTime now) { return show(procedure, now); };
    frustumscreen::stay(devices_, rounds);
}

Result<void> TouchTable::show(const TouchProcedure& procedure, MonotonicTime now) {
    const Shown next{procedure.task(), procedure.stage(), procedure.word(), procedure.at()};
    if (next != shown_) {
        shown_ = next;
        const TableWords words = table_words(procedure);
        devices_.say(words.lines, words.key);
        devices_.show(touch_picture(procedure, devices_.width(), devices_.height(), prop_px_,
                                    devices_.typesetter(), devices_.house()));
    }
    return devices_.present(now).map([](MonotonicTime) {});
}

} // namespace frustumscreen
