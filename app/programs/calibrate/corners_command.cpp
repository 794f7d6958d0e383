#include "app/programs/calibrate/corners_command.h"

#include "app/calibration/corner_uncertainty.h"
#include "app/calibration/point_files.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/touch_command.h"
#include "app/programs/calibrate/uncertainty_picture.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

/// The JSON of a calibration by touch, without the tracker's members.
Json corners_json(const calibration::CornerCalibration& c,
                  const calibration::CornerUncertainty& uncertainty) {
    Json json{{"projector", nullptr},        {"table_from_tracker", nullptr},
              {"sensor_offset_m", nullptr},  {"residual_mm", nullptr},
              {"residual_px", nullptr},      {"centre_m", nullptr},
              {"angles_deg", nullptr},       {"condition", nullptr},
              {"uncertainty_mm", nullptr},   {"within_mm", nullptr},
              {"ruler_mm", nullptr},         {"verdict", calibration::name_of(c.verdict)},
              {"reason", c.reason.sentence}, {"reason_id", c.reason.id.view()},
              {"repeat", Json::array()}};
    for (const std::size_t row : c.repeat) {
        json["repeat"].push_back(row + 1);
    }
    if (c.pinhole) {
        json["projector"] = projector_json(*c.pinhole, c.table_from_projector);
        json["residual_mm"] = mm_json(c.mean_residual_m, c.worst_residual_m);
        json["residual_px"] = {{"mean", c.mean_residual_px}, {"worst", c.worst_residual_px}};
        json["centre_m"] = {c.centre_m.x, c.centre_m.y, c.centre_m.z};
        json["angles_deg"] = {{"horizontal", c.horizontal_deg}, {"vertical", c.vertical_deg}};
        json["condition"] = c.condition;
        json["uncertainty_mm"] = mm_json(uncertainty.picture.mean_m, uncertainty.picture.worst_m);
        json["within_mm"] = within_json(uncertainty.picture.shares);
        json["ruler_mm"] = 1e3 * uncertainty.ruler_error_m;
    }
    return json;
}

std::string corners_text(const calibration::CornerCalibration& c,
                         const calibration::CornerUncertainty& uncertainty) {
    std::string text = fmt::format("{}: {}\n", calibration::name_of(c.verdict), c.reason.sentence);
    if (c.pinhole) {
        text += fmt::format("The light comes from ({:.3f}, {:.3f}, {:.3f}) m in the frame that the corners "
                            "were measured in, {:.1f} degrees "
                            "wide and {:.1f} high.\n",
                            c.centre_m.x, c.centre_m.y, c.centre_m.z, c.horizontal_deg, c.vertical_deg);
        text += projector_text(c.table_from_projector);
        text += fmt::format("Along its axis that is {:.0f} times as uncertain as across it.\n", c.condition);
        text += fmt::format(
            "A corner is measured to {:.1f} mm (one standard deviation); with a lens that does not "
            "distort {}.\n",
            1e3 * uncertainty.ruler_error_m, calibration::in_words(uncertainty.picture));
    }
    return text;
}

Result<int> corners(const CalibrateRequest& request) {
    TRY(const Described described, describe(request));
    TRY(const auto measured, read_points(request, calibration::parse_corners));
    const calibration::CornerCalibration calibration =
        calibration::calibrate_corners(measured, described.width, described.height);
    const calibration::CornerUncertainty uncertainty =
        calibration.pinhole ? calibration::uncertainty_of(calibration, measured, described.top_m)
                            : calibration::CornerUncertainty{};
    if (request.json) {
        fmt::print("{}\n", corners_json(calibration, uncertainty).dump(2));
    } else {
        fmt::print("{}", corners_text(calibration, uncertainty));
    }
    if (!request.map.empty()) {
        const MeasuredPlaces places = places_of(measured, described.width, described.height);
        TRY_VOID(write_uncertainty(request.map, map_of(calibration, uncertainty), places, described.top_m));
    }
    const int status = status_of(calibration.verdict, request, calibration.reason);
    if (status == 0 && request.keep) {
        return keep_corners(*described.settings, calibration, measured.size()).map([] { return 0; });
    }
    return status;
}

} // namespace

void add_corners_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen) {
    CommandLine command = app.add_subcommand(
        "corners",
        "computes the projector from the picture's four corners, measured by hand at two distances");
    add_common_options(command, request);
    add_keep_option(command, request);
    add_map_option(command, request);
    command.callback([&] { chosen = [&] { return end_with(corners(request)); }; });
}

} // namespace frustumscreen::programs
