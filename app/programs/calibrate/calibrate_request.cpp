#include "app/programs/calibrate/calibrate_request.h"

#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/scene/stereo.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <cmath>

namespace frustumscreen::programs {

void add_common_options(CommandLine& command, CalibrateRequest& request) {
    command.add_option("--from", request.from, "file of points, CSV").required();
    const CommandOption picture =
        command
            .add_option("--picture", request.picture, "width and height of the projector's picture, pixels")
            .expected(2)
            .within(16, 16384);
    command.add_option("--config", request.config, "the kiosk's settings, TOML, with the picture's size")
        .excludes(picture);
    command.add_flag("--json", request.json, "print JSON");
}

void add_map_option(CommandLine& command, CalibrateRequest& request) {
    command
        .add_option("--map", request.map,
                    "write a PNG of the picture's uncertainty on the table and at the prop's top")
        .needs("--from");
}

void add_keep_option(CommandLine& command, CalibrateRequest& request) {
    command
        .add_flag("--keep", request.keep,
                  "keep a good or usable calibration in the settings' calibration.folder")
        .needs("--config");
}

void add_touch_options(CommandLine& command, CalibrateRequest& request) {
    command
        .add_option("--sensor-height", request.sensor_height_m,
                    "height of the sensor above the touched place while the prop stands upright, metres")
        .within(-2.0, 2.0);
    add_keep_option(command, request);
    add_map_option(command, request);
}

void check_request(const CalibrateRequest& request) {
    if (!request.from.empty() && request.picture.empty() && request.config.empty()) {
        throw missing("--picture W H, or --config FILE,");
    }
}

Result<void> check_sensor_height(std::optional<double> height_m, std::optional<double> top_m) {
    constexpr double max_above_m = 0.1; // for a sensor on a holder
    if (height_m && *height_m < 0.0) {
        return fail(ErrorKind::BadConfiguration, "calibrate.sensor_below_table",
                    "the sensor's height above the prop's bottom is {} m, which is below the table; measure "
                    "it upwards from "
                    "the table to the sensor's middle",
                    *height_m);
    }
    if (height_m && top_m && *height_m > *top_m + max_above_m) {
        return fail(ErrorKind::BadConfiguration, "calibrate.sensor_above_prop",
                    "the sensor's height above the prop's bottom is {} m, and the prop is {} m high; measure "
                    "it from the table "
                    "to the sensor's middle",
                    *height_m, *top_m);
    }
    return {};
}

Result<void> check_square_foot(const settings::PropSettings& prop) {
    if (prop.kind != settings::PropKind::Solid) {
        return {};
    }
    return fail(
        ErrorKind::BadConfiguration, "calibrate.solid_prop",
        "prop.kind is \"solid\"; a table is measured with a prop that stands on a square: measure it with a "
        "frustum or a cube in the settings, or with frustumscreen-calibrate corners");
}

Result<void> check_own_pixels(const settings::Settings& settings, const std::filesystem::path& config) {
    const settings::Stereo stereo = settings::stereo_of(settings);
    if (scene::keeps_pixels(stereo)) {
        return {};
    }
    return fail(
        ErrorKind::BadConfiguration, "calibrate.stereo",
        "{}: the picture is in stereo, \"{}\", and the table is measured in the projector's own pixels; set "
        "projector.stereo = \"off\", and switch 3D off in the projector's own menu",
        config.string(), settings::name_of(stereo));
}

Result<Described> describe(const CalibrateRequest& request) {
    if (!request.picture.empty()) {
        TRY_VOID(check_sensor_height(request.sensor_height_m, std::nullopt));
        return Described{.settings = std::nullopt, .width = request.picture[0], .height = request.picture[1]};
    }
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    TRY_VOID(check_sensor_height(request.sensor_height_m, settings->prop.height_m));
    return described_by(*settings);
}

Described described_by(const settings::Settings& settings) {
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    return {.settings = settings,
            .width = pinhole.width,
            .height = pinhole.height,
            .top_m = settings.prop.height_m};
}

nlohmann::ordered_json matrix_json(const geometry::RigidTransform& transform) {
    const glm::dmat4 matrix = transform.matrix();
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            numbers.push_back(matrix[column][row]);
        }
    }
    return numbers;
}

nlohmann::ordered_json projector_json(const geometry::Pinhole& pinhole,
                                      const geometry::RigidTransform& table_from_projector) {
    return {{"width", pinhole.width},
            {"height", pinhole.height},
            {"fx", pinhole.fx},
            {"fy", pinhole.fy},
            {"cx", pinhole.cx},
            {"cy", pinhole.cy},
            {"k1", pinhole.lens.k1},
            {"k2", pinhole.lens.k2},
            {"table_from_projector", matrix_json(table_from_projector)}};
}

std::string projector_text(const geometry::RigidTransform& table_from_projector) {
    const glm::dvec3& lens = table_from_projector.translation;
    return fmt::format(
        "The projector is {:.3f} m above the table, {:.0f} mm to the {} of its picture's middle "
        "and {:.0f} mm {} it.\n",
        lens.z, 1e3 * std::abs(lens.x), lens.x < 0.0 ? "left" : "right", 1e3 * std::abs(lens.y),
        lens.y < 0.0 ? "in front of" : "behind");
}

int end_with(const Result<int>& status) {
    return status ? *status : exit_status("frustumscreen-calibrate", tl::unexpected<Error>(status.error()));
}

int status_of(calibration::Verdict verdict, const CalibrateRequest& request,
              const calibration::VerdictReason& reason) {
    if (verdict == calibration::Verdict::Good || verdict == calibration::Verdict::Usable) {
        return 0;
    }
    fmt::print(stderr, "frustumscreen-calibrate: {}: {}: {} [{}]\n", request.from.string(),
               calibration::name_of(verdict), reason.sentence, reason.id.view());
    return 1;
}

} // namespace frustumscreen::programs
