#include "app/programs/calibrate/eye_table.h"

#include "app/calibration/eye_procedure.h"
#include "app/calibration/point_files.h"
#include "app/programs/calibrate/calibration_way.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/table_pictures.h"
#include "app/programs/calibrate/table_rounds.h"

namespace frustumscreen {

namespace {

/// The procedure on the table.
class EyeTable {
public:
    EyeTable(const Settings& settings, TableDevices& devices) : settings_(settings), devices_(devices) {}

    /// False: it was told to stop.
    [[nodiscard]] Result<bool> run(EyeProcedure& procedure) {
        TableRounds rounds = rounds_of(procedure);
        rounds.has_ended = [&] { return procedure.has_ended(); };
        rounds.step = [&](MonotonicTime now) {
            if (procedure.stage() == CalibrationStage::Solve) {
                procedure.judge(fit_reported(procedure.sights(), settings_).value()); // its crosses are lit
            }
            const TableDevices::Heard heard = devices_.hear(now);
            procedure.step({now, heard.prop, heard.next, heard.back, heard.head});
        };
        return run_rounds(devices_, rounds);
    }
    void stay(const EyeProcedure& procedure) { frustumscreen::stay(devices_, rounds_of(procedure)); }

private:
    [[nodiscard]] TableRounds rounds_of(const EyeProcedure& procedure) {
        TableRounds rounds;
        rounds.show = [&](MonotonicTime now) { return show(procedure, now); };
        return rounds;
    }
    [[nodiscard]] Result<void> show(const EyeProcedure& procedure, MonotonicTime now) {
        const Shown next{procedure.stage(), procedure.word(), procedure.at(),
                         procedure.table_from_prop().translation};
        if (next != shown_) {
            shown_ = next;
            const TableWords words = table_words(procedure);
            devices_.say(words.lines, words.key);
            devices_.show(eye_picture(procedure, devices_.typesetter(), devices_.house()));
        }
        return devices_.present(now).map([](MonotonicTime) {});
    }

    /// What the picture depends on.
    struct Shown {
        CalibrationStage stage = CalibrationStage::Begin;
        EyeWord word = EyeWord::None;
        std::size_t at = 0;
        glm::dvec3 prop_m{0.0};
        [[nodiscard]] bool operator==(const Shown&) const = default;
    };

    const Settings& settings_;
    TableDevices& devices_;
    std::optional<Shown> shown_;
};

/// Nothing that was seen is lost.
Result<void> write_sights(const CalibrateRequest& request, const ReportedSights& sights) {
    return request.out.empty() || sights.empty() ? Result<void>()
                                                 : write_file(request.out, as_bytes(sights_text(sights)));
}

} // namespace

SightScene sight_scene(const Settings& settings) {
    return {settings.projector.pinhole, settings.projector.table_from_projector, make_prop(settings.prop),
            settings.eye.default_m};
}

/// An eye sees the artifact's middle through a face: half the prop's width behind it.
std::optional<EyeFit> fit_reported(std::span<const ReportedSight> sights, const Settings& settings) {
    const ProjectorSettings& projector = settings.projector;
    const std::optional<EyeSights> placed =
        placed_sights(sights, projector.pinhole, projector.table_from_projector,
                      settings.tracker.registration.table_from_tracker);
    return placed ? std::optional(fit_eyes(*placed, 0.5 * settings.prop.base_m)) : std::nullopt;
}

Result<bool> measure_eyes(const Settings& settings, const CalibrateRequest& request, TableDevices& devices) {
    const Registration& registration = settings.tracker.registration;
    EyeTable table(settings, devices);
    EyeProcedure procedure(sight_scene(settings), registration, why_no_eye(settings));
    const Result<bool> ended = table.run(procedure);
    TRY_VOID(write_sights(request, procedure.sights()));
    if (!ended || !*ended) {
        return ended;
    }
    if (procedure.stage() == CalibrationStage::Done) {
        if (const Result<void> kept = keep_eye(settings, procedure.judged()->eyes->middle_m); !kept) {
            EyeProcedure told(sight_scene(settings), registration, kept.error().message);
            static_cast<void>(table.run(told)); // whoever stands at the table reads no standard error
            return tl::unexpected<Error>(kept.error());
        }
    }
    table.stay(procedure);
    return procedure.stage() == CalibrationStage::Done;
}

Result<void> calibrate_eyes(const Settings& settings, const CalibrateRequest& request) {
    TRY(const std::unique_ptr<TableDevices> devices,
        TableDevices::open(request, settings, ", or give --from"));
    return measure_eyes(settings, request, *devices).and_then([&](bool kept) {
        return kept ? Result<void>() : ended_without(why_no_eye(settings));
    });
}

} // namespace frustumscreen
