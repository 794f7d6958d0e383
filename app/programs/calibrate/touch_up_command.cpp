#include "app/programs/calibrate/touch_up_command.h"

#include "app/calibration/touch_up.h"
#include "app/drift/drift_reference.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/touch_command.h"
#include "app/programs/calibrate/uncertainty_picture.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

/// Every key is always present; unknown values are null.
Json touch_up_json(const calibration::TouchUp& found) {
    Json json{{"moved", nullptr},
              {"off_mm", nullptr},
              {"projector", nullptr},
              {"table_from_tracker", nullptr},
              {"uncertainty_mm", nullptr},
              {"hidden_error_mm", nullptr},
              {"rows", Json::array()},
              {"verdict", calibration::name_of(found.verdict)},
              {"reason", found.reason.sentence},
              {"reason_id", found.reason.id.view()}};
    if (found.table) {
        json["moved"] = calibration::name_of(found.moved);
        json["off_mm"] = 1e3 * found.off_m;
        json["projector"] = projector_json(found.table->pinhole, found.table->table_from_projector);
        json["table_from_tracker"] = matrix_json(found.table->table_from_tracker);
        json["uncertainty_mm"] = mm_json(found.uncertainty.mean_m, found.uncertainty.worst_m);
        json["hidden_error_mm"] = 1e3 * found.hidden_error_m;
        json["rows"] = rows_json(found.residuals);
    }
    return json;
}

/// The next kept calibration: the table's frame, the prop in its sensor and the eye stay. Its residuals are
/// those of the fit, because leave-one-out residuals of so few touches are uninformative.
settings::Calibration next_calibration(const settings::Settings& settings,
                                       const calibration::TouchUp& found) {
    settings::Calibration next;
    next.method = settings::CalibrationMethod::Touch;
    next.places = static_cast<int>(found.residuals.size());
    next.pinhole = found.table->pinhole;
    next.table_from_projector = found.table->table_from_projector;
    next.registration = settings.tracker.registration;
    next.registration.table_from_tracker = found.table->table_from_tracker;
    for (const calibration::TouchResidual& residual : found.residuals) {
        next.mean_mm += 1e3 * residual.on_table_m / next.places;
        next.worst_mm = std::max(next.worst_mm, 1e3 * residual.on_table_m);
        next.mean_px += residual.pixel / next.places;
    }
    return next;
}

} // namespace

calibration::CalibratedTable kept_table_of(const settings::Settings& settings) {
    const geometry::Registration& registration = settings.tracker.registration;
    return {.pinhole = settings.projector.pinhole,
            .table_from_projector = settings.projector.table_from_projector,
            .table_from_tracker = registration.table_from_tracker,
            .sensor_offset_m = registration.sensor_from_prop.translation};
}

tl::unexpected<Error> none_kept(const settings::Settings& settings) {
    return fail(ErrorKind::BadConfiguration, "calibrate.none_kept",
                "{}: no calibration is kept there, so there is nothing to touch up; keep one first, with "
                "touch --keep or table",
                settings.calibration.folder.string());
}

Result<void> keep_touch_up(const settings::Settings& settings, const calibration::TouchUp& found) {
    if (found.moved != calibration::Moved::Nothing) {
        TRY_VOID(keep_next(settings, next_calibration(settings, found)));
    }
    // A camera may have reported drift. If the projector did not move, the camera did, so it learns again.
    std::error_code none;
    std::filesystem::remove(settings.calibration.folder / drift::drift_file, none);
    return {};
}

Result<int> touch_up_kept(const CalibrateRequest& request, const Described& described,
                          const calibration::Touches& touches) {
    const settings::Settings& settings = *described.settings;
    if (!settings.calibration.used) {
        return none_kept(settings);
    }
    const calibration::TouchUp found = calibration::touch_up(
        kept_table_of(settings), touches, set_up_for<calibration::TouchSetup>(described, request));
    if (request.json) {
        fmt::print("{}\n", touch_up_json(found).dump(2));
    } else {
        fmt::print("{}: {}\n", calibration::name_of(found.verdict), found.reason.sentence);
    }
    if (!request.map.empty()) {
        TRY_VOID(write_uncertainty(request.map, map_of(found), places_of(touches), described.top_m));
    }
    const int status = status_of(found.verdict, request, found.reason);
    if (status == 0 && request.keep) {
        return keep_touch_up(settings, found).map([] { return 0; });
    }
    return status;
}

} // namespace frustumscreen::programs
