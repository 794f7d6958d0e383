#include "app/programs/calibrate/eye_table.h"

#include "app/calibration/point_files.h"
#include "app/calibration/procedure/eye_procedure.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/procedure_table.h"

namespace frustumscreen {

SightScene sight_scene(const Settings& settings) {
    return {settings.projector.pinhole, settings.projector.table_from_projector, make_prop(settings.prop),
            settings.eye.default_m};
}

/// Depth of the artifact's middle behind a face: half the prop's width.
std::optional<EyeFit> fit_reported(std::span<const ReportedSight> sights, const Settings& settings) {
    const ProjectorSettings& projector = settings.projector;
    const std::optional<EyeSights> placed =
        placed_sights(sights, projector.pinhole, projector.table_from_projector,
                      settings.tracker.registration.table_from_tracker);
    return placed ? std::optional(fit_eyes(*placed, 0.5 * settings.prop.base_m)) : std::nullopt;
}

Result<std::optional<WayEnd>> measure_eyes(const Settings& settings, const CalibrateRequest& request,
                                           TableDevices& devices) {
    const auto way_with = [&](std::string problem) {
        return EyeProcedure(sight_scene(settings), settings.tracker.registration, std::move(problem));
    };
    ProcedureTable<EyeProcedure> table(
        devices, settings,
        {.solve =
             [&](EyeProcedure& way) {
                 way.judge(fit_reported(way.sights(), settings).value()); // the plan's crosses are lit
             },
         .write = [&](const EyeProcedure& way) { return write_points(request, way.sights(), sights_text); },
         .keep = [&](const EyeProcedure& way) { return keep_eye(settings, way.judged()->eyes->middle_m); },
         .why_not = way_with});
    EyeProcedure way = way_with(why_no_eye(settings));
    return table.measure(way);
}

Result<void> calibrate_eyes(const Settings& settings, const CalibrateRequest& request) {
    TRY(const std::unique_ptr<TableDevices> devices,
        TableDevices::open(request, settings, ", or give --from"));
    TRY(const std::optional<WayEnd> end, measure_eyes(settings, request, *devices));
    return without_value(ended_with(end, why_no_eye(settings)));
}

} // namespace frustumscreen
