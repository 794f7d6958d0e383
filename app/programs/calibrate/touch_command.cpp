#include "app/programs/calibrate/touch_command.h"

#include "app/calibration/point_files.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/touch_up_command.h"
#include "app/programs/calibrate/uncertainty_picture.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

std::string touch_text(const calibration::TouchCalibration& c) {
    std::string text = fmt::format("{}: {}\n", calibration::name_of(c.verdict), c.reason.sentence);
    if (!c.table) {
        return text;
    }
    text += projector_text(c.table->table_from_projector);
    text += fmt::format("Each touch lies {:.1f} mm ({:.1f} pixels) from where the others expect it, on "
                        "average; {:.1f} mm at worst.\n",
                        1e3 * c.mean_residual_m, c.mean_residual_px, 1e3 * c.worst_residual_m);
    text += fmt::format(
        "A single wrong touch that went unnoticed could move the picture by {:.0f} mm at its worst place.\n",
        1e3 * c.hidden_error_m);
    for (const std::size_t row : c.repeat) {
        text +=
            fmt::format("Touch {} lies {:.1f} mm from there.\n", row + 1, 1e3 * c.residuals[row].on_table_m);
    }
    return text;
}

Result<int> touch(const CalibrateRequest& request) {
    TRY(const Described described, describe(request));
    TRY(const auto touches, read_points(request, calibration::parse_touches));
    if (request.touch_up) {
        return touch_up_kept(request, described, touches);
    }
    const calibration::TouchCalibration calibration =
        calibration::calibrate_touch(touches, set_up_for<calibration::TouchSetup>(described, request));
    if (request.json) {
        fmt::print("{}\n", touch_json(calibration).dump(2));
    } else {
        fmt::print("{}", touch_text(calibration));
    }
    if (!request.map.empty()) {
        TRY_VOID(write_uncertainty(request.map, map_of(calibration), places_of(touches), described.top_m));
    }
    const int status = status_of(calibration.verdict, request, calibration.reason);
    if (status == 0 && request.keep) {
        return keep_touch(*described.settings, calibration, touches).map([] { return 0; });
    }
    return status;
}

} // namespace

nlohmann::ordered_json mm_json(double mean_m, double worst_m) {
    return {{"mean", 1e3 * mean_m}, {"worst", 1e3 * worst_m}};
}

nlohmann::ordered_json within_json(const calibration::PictureShares& shares) {
    return {{"places_68", 1e3 * shares.usual_m},
            {"places_95", 1e3 * shares.max_m},
            {"worst_place_95", 1e3 * shares.worst_m}};
}

nlohmann::ordered_json rows_json(std::span<const calibration::TouchResidual> residuals) {
    Json rows = Json::array();
    for (std::size_t k = 0; k < residuals.size(); ++k) {
        rows.push_back({{"row", k + 1},
                        {"residual_mm", 1e3 * residuals[k].on_table_m},
                        {"residual_px", residuals[k].pixel}});
    }
    return rows;
}

nlohmann::ordered_json touch_json(const calibration::TouchCalibration& c) {
    Json json{{"projector", nullptr},        {"table_from_tracker", nullptr},
              {"sensor_offset_m", nullptr},  {"residual_mm", nullptr},
              {"residual_px", nullptr},      {"uncertainty_mm", nullptr},
              {"within_mm", nullptr},        {"hidden_error_mm", nullptr},
              {"prior_share", nullptr},      {"boards_mm", nullptr},
              {"rows", Json::array()},       {"verdict", calibration::name_of(c.verdict)},
              {"reason", c.reason.sentence}, {"reason_id", c.reason.id.view()},
              {"repeat", Json::array()}};
    for (const std::size_t row : c.repeat) {
        json["repeat"].push_back(row + 1);
    }
    if (c.table) {
        const glm::dvec3& s = c.table->sensor_offset_m;
        json["projector"] = projector_json(c.table->pinhole, c.table->table_from_projector);
        json["table_from_tracker"] = matrix_json(c.table->table_from_tracker);
        json["sensor_offset_m"] = {s.x, s.y, s.z};
        json["residual_mm"] = mm_json(c.mean_residual_m, c.worst_residual_m);
        json["residual_px"] = {{"mean", c.mean_residual_px}, {"worst", c.worst_residual_px}};
        json["uncertainty_mm"] = mm_json(c.uncertainty.mean_m, c.uncertainty.worst_m);
        json["within_mm"] = within_json(c.uncertainty.shares);
        json["hidden_error_mm"] = 1e3 * c.hidden_error_m;
        json["prior_share"] = {{"aspect", c.prior_shares.aspect},
                               {"cx", c.prior_shares.centre_u},
                               {"cy", c.prior_shares.centre_v},
                               {"k1", c.prior_shares.k1},
                               {"k2", c.prior_shares.k2}};
        if (c.boards) {
            json["boards_mm"] = {{"given", 1e3 * c.boards->given_m},
                                 {"found", 1e3 * c.boards->found_m},
                                 {"sd", 1e3 * c.boards->sd_m}};
        }
        json["rows"] = rows_json(c.residuals);
    }
    return json;
}

void add_touch_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen) {
    CommandLine command = app.add_subcommand(
        "touch", "computes projector, tracker and the sensor's place in the prop from touches");
    add_common_options(command, request);
    add_touch_options(command, request);
    command
        .add_flag(
            "--touch-up", request.touch_up,
            "correct the kept calibration by three touches or more, and print what has moved and how far")
        .needs("--config")
        .excludes("--sensor-height");
    command.callback([&] { chosen = [&] { return end_with(touch(request)); }; });
}

} // namespace frustumscreen::programs
