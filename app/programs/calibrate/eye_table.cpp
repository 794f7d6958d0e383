#include "app/programs/calibrate/eye_table.h"

#include "app/calibration/point_files.h"
#include "app/calibration/procedure/eye_procedure.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/procedure_table.h"

namespace frustumscreen::programs {

calibration::SightScene sight_scene(const settings::Settings& settings) {
    return {.pinhole = settings.projector.pinhole,
            .table_from_projector = settings.projector.table_from_projector,
            .prop = settings::make_prop(settings.prop),
            .usual_eye_m = settings.eye.default_m};
}

/// Depth of the artifact's middle behind a face: half the prop's width.
std::optional<calibration::EyeFit> fit_reported(std::span<const calibration::ReportedSight> sights,
                                                const settings::Settings& settings) {
    const settings::ProjectorSettings& projector = settings.projector;
    const std::optional<calibration::EyeSights> placed =
        calibration::placed_sights(sights, projector.pinhole, projector.table_from_projector,
                                   settings.tracker.registration.table_from_tracker);
    return placed ? std::optional(calibration::fit_eyes(*placed, 0.5 * settings.prop.base_m)) : std::nullopt;
}

Result<std::optional<WayEnd>> measure_eyes(const settings::Settings& settings,
                                           const CalibrateRequest& request, TableDevices& devices) {
    const auto way_with = [&](std::string problem) {
        return calibration::EyeProcedure(sight_scene(settings), settings.tracker.registration,
                                         std::move(problem));
    };
    ProcedureTable<calibration::EyeProcedure> table(
        devices, settings,
        {.solve =
             [&](calibration::EyeProcedure& way) {
                 way.judge(fit_reported(way.sights(), settings).value()); // the plan's crosses are lit
             },
         .write =
             [&](const calibration::EyeProcedure& way) {
                 return write_points(request, way.sights(), calibration::sights_text);
             },
         .keep =
             [&](const calibration::EyeProcedure& way) {
                 return keep_eye(settings, way.judged()->eyes->middle_m);
             },
         .why_not = way_with});
    calibration::EyeProcedure way = way_with(why_no_eye(settings));
    return table.measure(way);
}

Result<void> calibrate_eyes(const settings::Settings& settings, const CalibrateRequest& request) {
    TRY(const std::unique_ptr<TableDevices> devices,
        TableDevices::open(request, settings, ", or give --from"));
    TRY(const std::optional<WayEnd> end, measure_eyes(settings, request, *devices));
    return without_value(ended_with(end, why_no_eye(settings)));
}

} // namespace frustumscreen::programs
