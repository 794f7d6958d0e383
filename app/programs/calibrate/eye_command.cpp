#include "app/programs/calibrate/eye_command.h"

#include "app/calibration/point_files.h"
#include "app/calibration/procedure/eye_procedure.h"
#include "app/programs/calibrate/eye_table.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/touch_command.h"
#include "app/programs/common/command_line.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// Every key is always present; unknown values are null.
Json eye_json(const calibration::EyeFit& fit) {
    Json json{{"eye_in_sensor_m", nullptr},
              {"deviation_mm", nullptr},
              {"left_m", nullptr},
              {"right_m", nullptr},
              {"right_in_sensor", nullptr},
              {"pupils_mm", nullptr},
              {"picture_mm", nullptr},
              {"hidden_error_mm", nullptr},
              {"residual_mm", nullptr},
              {"rows", Json::array()},
              {"verdict", calibration::name_of(fit.verdict)},
              {"reason", fit.reason.sentence},
              {"reason_id", fit.reason.id.view()},
              {"repeat", Json::array()}};
    for (const std::size_t row : fit.repeat) {
        json["repeat"].push_back(row + 1);
    }
    if (fit.eyes) {
        const calibration::FittedEyes& eyes = *fit.eyes;
        const Eigen::Vector3d deviation = eyes.covariance.diagonal().cwiseSqrt();
        json["eye_in_sensor_m"] = vector_json(eyes.middle_m);
        json["deviation_mm"] = {1e3 * deviation.x(), 1e3 * deviation.y(), 1e3 * deviation.z()};
        json["left_m"] = vector_json(eyes.left_m);
        json["right_m"] = vector_json(eyes.right_m);
        json["right_in_sensor"] = vector_json(glm::normalize(eyes.right_m - eyes.left_m));
        json["pupils_mm"] = 1e3 * glm::distance(eyes.left_m, eyes.right_m);
        json["picture_mm"] = 1e3 * eyes.picture_m;
        json["hidden_error_mm"] = 1e3 * eyes.hidden_m;
        json["residual_mm"] = mm_json(fit.mean_residual_m, fit.worst_residual_m);
        for (std::size_t k = 0; k < fit.residuals_m.size(); ++k) {
            json["rows"].push_back({{"row", k + 1}, {"mm", 1e3 * fit.residuals_m[k]}});
        }
    }
    return json;
}

std::string eye_text(const calibration::EyeFit& fit) {
    std::string text = fmt::format("{}: {}\n", calibration::name_of(fit.verdict), fit.reason.sentence);
    if (fit.eyes) {
        const glm::dvec3& eye = fit.eyes->middle_m;
        text += fmt::format("The point between the eyes, in the head's sensor: eye_in_sensor_m = [{:.4f}, "
                            "{:.4f}, {:.4f}]; the eyes are "
                            "{:.0f} mm apart.\n",
                            eye.x, eye.y, eye.z, 1e3 * glm::distance(fit.eyes->left_m, fit.eyes->right_m));
        const glm::dvec3 right = glm::normalize(fit.eyes->right_m - fit.eyes->left_m);
        text += fmt::format(
            "For stereo, in [tracker] of the settings: right_in_sensor = [{:.3f}, {:.3f}, {:.3f}].\n",
            right.x, right.y, right.z);
        text += fmt::format("A line of sight passes the eye that the others find by {:.1f} mm on average, "
                            "{:.1f} mm at worst.\n",
                            1e3 * fit.mean_residual_m, 1e3 * fit.worst_residual_m);
    }
    return text;
}

/// The crosses for the prop at its requested place and a head at the visitors' usual place.
Json crosses_json(const settings::Settings& settings) {
    const calibration::SightScene scene = sight_scene(settings);
    const calibration::SightPlan plan = calibration::plan_sights(
        scene, calibration::first_place(scene), scene.usual_eye_m, calibration::EyeProcedure::max_of_each);
    Json crosses = Json::array();
    for (const calibration::SightCross& cross : plan.crosses) {
        crosses.push_back(
            {{"u_px", cross.pixel.x}, {"v_px", cross.pixel.y}, {"tip_m", vector_json(cross.tip_m)}});
    }
    return {{"table_from_prop", matrix_json(calibration::first_place(scene))}, {"crosses", crosses}};
}

Result<int> on_table(const settings::Settings& settings, const CalibrateRequest& request) {
    if (request.json) {
        fmt::print("{}\n", crosses_json(settings).dump(2));
        return 0;
    }
    return calibrate_eyes(settings, request).map([] { return 0; });
}

Result<int> from_file(const settings::Settings& settings, const CalibrateRequest& request) {
    if (const std::string why = why_no_eye(settings); request.keep && !why.empty()) {
        return fail(ErrorKind::BadConfiguration, "calibrate.no_kept_table", "{}: {}",
                    settings.calibration.folder.string(), why);
    }
    TRY(const auto reported, read_points(request, calibration::parse_sights));
    const std::optional<calibration::EyeFit> fit = fit_reported(reported, settings);
    if (!fit) {
        return bad_input(
            "calibrate.cross_without_light",
            "{}: the light of a cross does not meet the table; u_px, v_px is its pixel in the picture",
            request.from.string());
    }
    if (request.json) {
        fmt::print("{}\n", eye_json(*fit).dump(2));
    } else {
        fmt::print("{}", eye_text(*fit));
    }
    const int status = status_of(fit->verdict, request, fit->reason);
    if (status == 0 && request.keep) {
        return keep_eye(settings, fit->eyes->middle_m).map([] { return 0; });
    }
    return status;
}

Result<int> eye(const CalibrateRequest& request) {
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    return request.from.empty() ? on_table(*settings, request) : from_file(*settings, request);
}

} // namespace

void add_eye_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen) {
    CommandLine command =
        app.add_subcommand("eye", "finds where the eyes are relative to the head's sensor: on the table, "
                                  "where a person lines up the prop's corners with crosses (Back and Next "
                                  "are the first two buttons); or, with --from, from a file of sightings");
    const CommandOption from = command.add_option("--from", request.from, "file of sightings, CSV");
    command.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    command.add_flag("--json", request.json,
                     "print JSON; without --from, print the crosses for a prop on its square and end");
    command
        .add_flag("--keep", request.keep,
                  "add good or usable eyes to the kept calibration; on the table, Next does this")
        .needs(from);
    command.add_option("--out", request.out, "on the table: write the sightings to this CSV file, for --from")
        .excludes(from);
    command.add_flag("--headless", request.headless, "on the table: run without a screen, for tests")
        .excludes(from);
    command.callback([&] { chosen = [&] { return end_with(eye(request)); }; });
}

} // namespace frustumscreen::programs
