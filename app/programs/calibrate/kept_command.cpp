#include "app/programs/calibrate/kept_command.h"

#include "app/programs/calibrate/kept_table.h"
#include "app/programs/common/command_line.h"
#include "app/settings/kept_calibrations.h"
#include "app/settings/settings.h"
#include "firmware_host/base/disk_tree.h"
#include "firmware_host/base/json.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* nothing_kept = "No calibration is kept; the set-up is as the settings describe it.\n";

Json kept_json(const std::vector<settings::KeptCalibration>& kept, FileTree& folder) {
    Json list = Json::array();
    for (const settings::KeptCalibration& each : kept) {
        const Result<settings::Calibration> read = settings::read_calibration(folder, each);
        if (!read) {
            list.push_back({{"file", each.name}, {"unusable", read.error().message}});
            continue;
        }
        list.push_back({{"file", each.name},
                        {"made", read->made},
                        {"method", settings::name_of(read->method)},
                        {"places", read->places},
                        {"residual_mm", {{"mean", read->mean_mm}, {"worst", read->worst_mm}}},
                        {"residual_px", {{"mean", read->mean_px}}}});
    }
    return {{"kept", list}};
}

std::string kept_text(const std::vector<settings::KeptCalibration>& kept, FileTree& folder) {
    if (kept.empty()) {
        return nothing_kept;
    }
    std::string text;
    for (const settings::KeptCalibration& each : kept) {
        const Result<settings::Calibration> read = settings::read_calibration(folder, each);
        text += read ? fmt::format("{}: {}, {}, {} places; {:.2f} mm on average, {:.2f} mm at worst\n",
                                   each.name, read->made, settings::name_of(read->method), read->places,
                                   read->mean_mm, read->worst_mm)
                     : fmt::format("{}: cannot be used: {}\n", each.name, read.error().message);
    }
    return text + "The exhibit uses the first one that can be used.\n";
}

Result<int> show_kept(const CalibrateRequest& request) {
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    const std::filesystem::path& folder = settings->calibration.folder;
    std::error_code none;
    if (!request.undo && !std::filesystem::exists(folder, none)) { // nothing has been kept
        fmt::print("{}", request.json ? "{\n  \"kept\": []\n}\n" : nothing_kept);
        return 0;
    }
    TRY(const std::unique_ptr<WritableTree> tree, open_tree(folder));
    if (request.undo) {
        TRY(const settings::KeptCalibration undone, settings::undo_calibration(*tree));
        fmt::print(
            stderr,
            "frustumscreen-calibrate: {} is undone; the exhibit uses the previous one when it starts again\n",
            undone.name);
    }
    TRY(const std::vector<settings::KeptCalibration> kept, settings::list_calibrations(*tree));
    if (request.json) {
        fmt::print("{}\n", kept_json(kept, *tree).dump(2));
    } else {
        fmt::print("{}", kept_text(kept, *tree));
    }
    return 0;
}

/// Keeps a calibration from this number of places, with the date.
Result<void> keep(const settings::Settings& settings, const calibration::TouchCalibration& calibration,
                  std::size_t places, settings::Calibration next) {
    next.places = static_cast<int>(places);
    next.mean_mm = 1e3 * calibration.mean_residual_m;
    next.worst_mm = 1e3 * calibration.worst_residual_m;
    next.mean_px = calibration.mean_residual_px;
    return keep_next(settings, std::move(next));
}

} // namespace

Result<void> keep_next(const settings::Settings& settings, settings::Calibration next) {
    const std::filesystem::path& folder = settings.calibration.folder;
    std::error_code failed; // open_tree reports the error
    std::filesystem::create_directories(folder, failed);
    TRY(const std::unique_ptr<WritableTree> tree, open_tree(folder));
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    next.made = fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(now));
    TRY(const settings::KeptCalibration kept, settings::keep_calibration(*tree, next));
    fmt::print(stderr, "frustumscreen-calibrate: kept as {}; the exhibit uses it when it starts again\n",
               (folder / kept.name).string());
    return {};
}

Result<void> keep_touch(const settings::Settings& settings, const calibration::TouchCalibration& calibration,
                        std::span<const calibration::Touch> touches) {
    settings::Calibration next = kept_table(*calibration.table, touches, settings);
    next.method = settings::CalibrationMethod::Touch;
    return keep(settings, calibration, touches.size(), std::move(next));
}

Result<void> keep_auto(const settings::Settings& settings, const calibration::AutoCalibration& calibration) {
    settings::Calibration next = kept_table(*calibration.found.table, calibration.sensor_from_prop, settings);
    next.method = settings::CalibrationMethod::Auto;
    return keep(settings, calibration.found, calibration.found.residuals.size(), std::move(next));
}

Result<void> keep_corners(const settings::Settings& settings,
                          const calibration::CornerCalibration& calibration, std::size_t corners) {
    settings::Calibration next;
    next.method = settings::CalibrationMethod::Corners;
    next.places = static_cast<int>(corners);
    next.mean_mm = 1e3 * calibration.mean_residual_m;
    next.worst_mm = 1e3 * calibration.worst_residual_m;
    next.mean_px = calibration.mean_residual_px;
    next.pinhole = *calibration.pinhole;
    next.table_from_projector = settings_from_measured(settings.projector) * calibration.table_from_projector;
    next.registration = settings.tracker.registration;
    return keep_next(settings, std::move(next));
}

std::string why_no_eye(const settings::Settings& settings) {
    return settings.calibration.used ? ""
                                     : "no calibration is kept, and the eyes' place is kept only with one; "
                                       "keep a calibration first, with touch --keep or table";
}

Result<void> keep_eye(const settings::Settings& settings, const glm::dvec3& eye_in_sensor_m) {
    settings::Calibration next = *settings.calibration.used;
    next.registration.eye_in_sensor_m = eye_in_sensor_m;
    return keep_next(settings, std::move(next));
}

void add_kept_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen) {
    CommandLine command = app.add_subcommand(
        "kept", "lists the calibrations that this kiosk keeps, newest first, or undoes the newest");
    command.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    command.add_flag("--undo", request.undo, "return to the calibration before the newest");
    command.add_flag("--json", request.json, "print JSON");
    command.callback([&] { chosen = [&] { return end_with(show_kept(request)); }; });
}

} // namespace frustumscreen::programs
