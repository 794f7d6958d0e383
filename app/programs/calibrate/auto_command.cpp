#include "app/programs/calibrate/auto_command.h"

#include "app/calibration/calibrate_auto.h"
#include "app/calibration/point_files.h"
#include "app/programs/calibrate/auto_table.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/touch_command.h"
#include "app/programs/calibrate/uncertainty_picture.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <numeric>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

/// The JSON of a calibration by touch, with the rests' own numbers, and the members that only rests have.
Json auto_json(const calibration::AutoCalibration& c, const calibration::Rests& rests) {
    Json json = touch_json(c.found);
    json["repeat"] = Json::array();
    for (const std::size_t k : c.found.repeat) {
        json["repeat"].push_back(rests[k].name);
    }
    for (std::size_t k = 0; k < json["rows"].size(); ++k) {
        Json& row = json["rows"][k];
        row["row"] = rests[k].name;
        row["points"] = rests[k].points.size();
        row["points_wrong"] = c.points_wrong[k];
    }
    json["sensor_from_prop"] = c.found.table ? matrix_json(c.sensor_from_prop) : Json();
    json["pixel_noise_px"] = c.found.table ? Json(c.pixel_noise) : Json();
    json["print_size"] = c.found.table ? Json(c.print) : Json();
    return json;
}

std::string auto_text(const calibration::AutoCalibration& c, const calibration::Rests& rests) {
    std::string text =
        fmt::format("{}: {}\n", calibration::name_of(c.found.verdict), c.found.reason.sentence);
    if (!c.found.table) {
        return text;
    }
    text += projector_text(c.found.table->table_from_projector);
    text += fmt::format(
        "The points of a rest lie {:.1f} mm ({:.1f} pixels) from where the others expect them, on "
        "average; {:.1f} mm at worst.\n",
        1e3 * c.found.mean_residual_m, c.found.mean_residual_px, 1e3 * c.found.worst_residual_m);
    const std::size_t wrong = std::accumulate(c.points_wrong.begin(), c.points_wrong.end(), std::size_t{0});
    text += fmt::format("A point's pixel is known to {:.2f} pixels; {} points were wrong and are left out.\n",
                        c.pixel_noise, wrong);
    for (const std::size_t k : c.found.repeat) {
        text += fmt::format("Rest {} lies {:.1f} mm from there.\n", rests[k].name,
                            1e3 * c.found.residuals[k].on_table_m);
    }
    return text;
}

Result<int> calibrate(const CalibrateRequest& request) {
    if (request.from.empty()) {
        return calibrate_by_camera(request);
    }
    TRY(const Described described, describe(request));
    TRY(const auto rests, read_points(request, calibration::parse_rests));
    const calibration::AutoCalibration calibration =
        calibration::calibrate_auto(rests, set_up_for<calibration::AutoSetup>(described, request));
    if (request.json) {
        fmt::print("{}\n", auto_json(calibration, rests).dump(2));
    } else {
        fmt::print("{}", auto_text(calibration, rests));
    }
    if (!request.map.empty()) {
        TRY_VOID(
            write_uncertainty(request.map, map_of(calibration.found), places_of(rests), described.top_m));
    }
    const int status = status_of(calibration.found.verdict, request, calibration.found.reason);
    if (status == 0 && request.keep) {
        return keep_auto(*described.settings, calibration).map([] { return 0; });
    }
    return status;
}

} // namespace

void add_auto_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen) {
    CommandLine command = app.add_subcommand(
        "auto", "calibrates by a camera: on the table, with the printed sheet of tags (Back and Next are the "
                "first two buttons); or, with --from, from a file of rests");
    add_common_options(command, request);
    const CommandOption from = command.get_option("--from").required(false);
    add_touch_options(command, request);
    command.add_option("--rests", request.rests, "on the table: number of rests (default: 16)")
        .within(6, 40)
        .excludes(from);
    command
        .add_option("--board", request.board_m,
                    "on the table: thickness of the board under the sheet of tags, metres (default: 0.003)")
        .within(0.0, 0.05)
        .excludes(from);
    command.add_option("--out", request.out, "on the table: write the rests to this CSV file, for --from")
        .excludes(from);
    command.add_flag("--headless", request.headless, "on the table: run without a screen, for tests")
        .excludes(from);
    command.callback([&] {
        if (request.from.empty() && (request.config.empty() || request.json)) {
            throw missing(request.json ? "--from FILE, with --json," : "--config FILE, or --from FILE,");
        }
        chosen = [&] { return end_with(calibrate(request)); };
    });
}

} // namespace frustumscreen::programs
