#include "app/programs/calibrate/table_command.h"

#include "app/calibration/point_files.h"
#include "app/programs/calibrate/auto_table.h"
#include "app/programs/calibrate/eye_table.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/procedure_table.h"
#include "app/programs/calibrate/sheet_command.h"
#include "app/programs/calibrate/touch_up_command.h"
#include "app/programs/common/command_line.h"
#include "app/settings/settings.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <span>

namespace frustumscreen::programs {

namespace {

/// Touches of a touch-up. Seven take about two minutes and usually check each other; five do not. Two more
/// follow if seven do not.
constexpr int few_crosses = 7;
constexpr int more_after_few = 2;
constexpr int max_crosses = 30;

/// Half the width and depth of the area for the middle of the prop's bottom.
glm::dvec2 reach_in(const settings::Settings& settings) {
    return calibration::reach_of(glm::dvec2(settings.table.width_m, settings.table.depth_m),
                                 settings.prop.base_m);
}

calibration::CrossSetup cross_setup(const settings::Settings& settings, const CalibrateRequest& request) {
    calibration::CrossSetup setup;
    setup.count = request.touches.value_or(settings.calibration.touches);
    setup.block_m = request.block_m.value_or(settings.calibration.block_m);
    setup.top_m = settings.prop.height_m;
    setup.reach_m = reach_in(settings);
    return setup;
}

/// The projector of the settings, with a tracker in the table's frame.
calibration::TouchModel described_table(const settings::Settings& settings, double sensor_height_m) {
    calibration::TouchModel model;
    model.pinhole = settings.projector.pinhole;
    model.projector_from_tracker = settings.projector.table_from_projector.inverse();
    model.sensor_offset_m = {0.0, 0.0, -sensor_height_m};
    return model;
}

/// Crosses for a whole calibration. The settings' projector is accurate enough: a cross's information hardly
/// depends on it.
std::vector<calibration::Cross> crosses_for(const settings::Settings& settings,
                                            const CalibrateRequest& request) {
    calibration::TouchModel rough = described_table(settings, request.sensor_height_m.value_or(0.0));
    rough.pinhole = rough.pinhole.ideal();
    const calibration::CrossSetup setup = cross_setup(settings, request);
    return calibration::choose_crosses(rough, setup, std::max(max_crosses - setup.count, 0));
}

/// Crosses for a touch-up, from the kept projector.
std::vector<calibration::Cross> touch_up_crosses_for(const settings::Settings& settings,
                                                     const CalibrateRequest& request) {
    calibration::CrossSetup setup = cross_setup(settings, request);
    setup.count = few_crosses;
    return calibration::choose_touch_up_crosses(
        described_table(settings, -settings.tracker.registration.sensor_from_prop.translation.z), setup,
        more_after_few);
}

/// The sensor's height above the prop's bottom: from the request, else from the settings, else as measured
/// before.
std::optional<double> sensor_height(const settings::Settings& settings, const CalibrateRequest& request) {
    if (request.sensor_height_m) {
        return request.sensor_height_m;
    }
    if (settings.calibration.sensor_height_m != 0.0) {
        return settings.calibration.sensor_height_m;
    }
    const double above_m = settings.tracker.registration.sensor_from_prop.inverse().translation.z;
    return above_m != 0.0 ? std::optional(above_m) : std::nullopt;
}

constexpr const char* no_sensor_height = "the sensor's height above the prop's bottom is not known; measure "
                                         "it with a ruler and set calibration.sensor_height_m";

nlohmann::ordered_json list_json(std::span<const calibration::Cross> crosses) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const calibration::Cross& cross : crosses) {
        list.push_back({{"u_px", cross.pixel.x},
                        {"v_px", cross.pixel.y},
                        {"block_m", cross.block_m},
                        {"turn_deg", glm::degrees(cross.yaw_rad)}});
    }
    return list;
}

/// `first`: how many crosses come before a verdict may ask for more. `overhang_m`: how far prop or boards hang over the table's edge at
/// the worst cross.
nlohmann::ordered_json crosses_json(const settings::Settings& settings,
                                    std::span<const calibration::Cross> crosses, std::size_t first) {
    const glm::dvec2 reach_m = reach_in(settings);
    return {{"crosses", list_json(crosses.first(first))},
            {"more_crosses", list_json(crosses.subspan(first))},
            {"boards_side_m", calibration::boards_side_m(settings.prop.base_m)},
            {"overhang_m", calibration::overhang_m(described_table(settings, 0.0), crosses, reach_m)}};
}

/// A table with a technician, and the request for both.
struct Session {
    TableDevices& devices;
    const settings::Settings& settings;
    const CalibrateRequest& request;
    calibration::TouchSetup setup; ///< includes the sensor's height, if known
    // Chosen before the devices are opened: choosing takes a second, in which the service manager's watchdog
    // would not be fed.
    std::vector<calibration::Cross> crosses;
    std::size_t first_crosses = 0;                    ///< crosses touched before a verdict asks for more
    std::vector<calibration::Cross> touch_up_crosses; ///< empty if there is nothing to touch up
};

/// Runs the way and keeps its result. `solve` judges the touches, `keep` keeps the calibration.
Result<WayEnd>
measure_by_touch(const Session& session, calibration::TouchProcedure way,
                 const std::function<calibration::TouchJudgement(const calibration::Touches&)>& solve,
                 const std::function<Result<void>(const calibration::Touches&)>& keep) {
    ProcedureTable<calibration::TouchProcedure> table(
        session.devices, session.settings,
        {.solve = [&](calibration::TouchProcedure& solved) { solved.judge(solve(solved.touches())); },
         .write =
             [&](const calibration::TouchProcedure& touched) {
                 return write_points(session.request, touched.touches(), calibration::touches_text);
             },
         .keep = [&](const calibration::TouchProcedure& kept) { return keep(kept.touches()); },
         .why_not =
             [&](std::string problem) {
                 return calibration::TouchProcedure(way.crosses(), std::move(problem));
             }});
    TRY(const std::optional<WayEnd> end, table.measure(way));
    return ended_with(end, way.problem());
}

Result<WayEnd> measure_by_crosses(const Session& session) {
    calibration::TouchCalibration found;
    return measure_by_touch(
        session,
        calibration::TouchProcedure(calibration::TouchTask::Anew, session.crosses, session.first_crosses,
                                    session.setup.sensor_height_m ? "" : no_sensor_height),
        [&](const calibration::Touches& touches) {
            found = calibration::calibrate_touch(touches, session.setup);
            return judgement_of(found);
        },
        [&](const calibration::Touches& touches) { return keep_touch(session.settings, found, touches); });
}

/// A touch-up; it may end with a request for a whole calibration.
Result<WayEnd> touch_up_on_table(const Session& session) {
    calibration::TouchUp found;
    return measure_by_touch(
        session,
        calibration::TouchProcedure(calibration::TouchTask::TouchUp, session.touch_up_crosses, few_crosses),
        [&](const calibration::Touches& touches) {
            found = calibration::touch_up(kept_table_of(session.settings), touches, session.setup);
            return judgement_of(found);
        },
        [&](const calibration::Touches&) { return keep_touch_up(session.settings, found); });
}

/// The tag sheet, if there is a camera. If no sheet fits the prop, the other ways remain.
std::optional<calibration::Board> board_for_camera(const settings::Settings& settings) {
    if (settings.camera.kind == settings::CameraKind::None) {
        return std::nullopt;
    }
    Result<calibration::Board> board = board_of(settings);
    if (!board) {
        say_line("frustumscreen-calibrate", board.error().message);
        return std::nullopt;
    }
    return *std::move(board);
}

Result<WayEnd> take(CalibrationWay way, const Session& session,
                    const std::optional<calibration::Board>& board) {
    switch (way) {
    case CalibrationWay::TouchUp:
        return touch_up_on_table(session);
    case CalibrationWay::Camera:
        return measure_by_camera(session.settings, session.request, *board, session.devices, true);
    case CalibrationWay::Crosses:
        break;
    }
    return measure_by_crosses(session);
}

/// Measures the eyes after a calibration is kept, if the tracker reports a head's sensor and the eyes in it
/// are unknown. The calibration stays kept even if this ends without eyes.
Result<int> measure_missing_eyes(const Session& session) {
    TRY(const settings::CheckedSettings settings,
        settings::load_settings(session.request.config)); // rereads what is kept
    const bool are_known = settings->tracker.registration.eye_in_sensor_m != glm::dvec3(0.0);
    if (are_known || !session.devices.has_seen_head()) {
        return 0;
    }
    CalibrateRequest request = session.request;
    request.out.clear(); // --out already has the touches or the rests
    return measure_eyes(*settings, request, session.devices).map([](const auto&) { return 0; });
}

/// Offers one way after the other, until one ends with a calibration or without.
Result<int> take_first_wanted(const Session& session) {
    const std::optional<calibration::Board> board = board_for_camera(session.settings);
    for (const CalibrationWay way : ways_through(!session.touch_up_crosses.empty(), board.has_value())) {
        TRY(const WayEnd ended, take(way, session, board));
        if (ended == WayEnd::Kept) {
            return measure_missing_eyes(session);
        }
    }
    return 0;
}

Result<int> calibrate_table(const CalibrateRequest& request) {
    TRY(const Described described, describe(request));
    const settings::Settings& settings = *described.settings;
    TRY_VOID(check_square_foot(settings.prop));
    if (request.touch_up && !settings.calibration.used) {
        return none_kept(settings);
    }
    const bool touches_up =
        settings.calibration.used && !request.from_start && (request.touch_up || !request.json);
    if (request.json) {
        const std::vector<calibration::Cross> crosses =
            touches_up ? touch_up_crosses_for(settings, request) : crosses_for(settings, request);
        const int first = touches_up ? few_crosses : cross_setup(settings, request).count;
        fmt::print("{}\n", crosses_json(settings, crosses, static_cast<std::size_t>(first)).dump(2));
        return 0;
    }
    const std::vector<calibration::Cross> crosses = crosses_for(settings, request);
    const std::vector<calibration::Cross> touch_up_crosses =
        touches_up ? touch_up_crosses_for(settings, request) : std::vector<calibration::Cross>();
    TRY(const std::unique_ptr<TableDevices> devices, TableDevices::open(request, settings, ""));
    CalibrateRequest known = request;
    known.sensor_height_m = sensor_height(settings, request);
    TRY_VOID(check_sensor_height(known.sensor_height_m, settings.prop.height_m));
    return take_first_wanted({.devices = *devices,
                              .settings = settings,
                              .request = request,
                              .setup = set_up_for<calibration::TouchSetup>(described, known),
                              .crosses = crosses,
                              .first_crosses = static_cast<std::size_t>(cross_setup(settings, request).count),
                              .touch_up_crosses = touch_up_crosses});
}

} // namespace

void add_table_command(CommandLine& app, CalibrateRequest& request, std::function<int()>& chosen) {
    CommandLine command = app.add_subcommand(
        "table", "calibrates on the table, step by step: the prop is laid on crosses that the projector "
                 "shows (Back and Next are the first two buttons). It offers the touch-up of a kept "
                 "calibration first, then auto if the settings have a camera");
    command.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    command.add_option("--touches", request.touches, "number of crosses (default: the settings')")
        .within(6, 30);
    command
        .add_option(
            "--block", request.block_m,
            "height of the boards under the prop for half of the crosses, metres (default: the settings')")
        .within(0.02, 0.5);
    command
        .add_option("--sensor-height", request.sensor_height_m,
                    "height of the sensor above the prop's bottom, metres (default: the settings')")
        .within(-2.0, 2.0);
    command.add_option("--out", request.out,
                       "write the touches, or the rests, to this CSV file, for touch or auto with --from");
    const CommandOption touch_up = command.add_flag(
        "--touch-up", request.touch_up, "touch up the kept calibration; an error if none is kept");
    const CommandOption from_start = command.add_flag("--from-start", request.from_start,
                                                      "calibrate completely even if a calibration is kept");
    const CommandOption anew = command.add_flag("--anew", request.from_start).hidden();
    touch_up.excludes(from_start).excludes(anew);
    command.add_flag("--headless", request.headless, "run without a screen, for tests");
    command.add_flag("--json", request.json, "print the crosses as JSON and end");
    command.callback([&request, &chosen, anew] {
        if (anew.count() > 0) {
            fmt::print(stderr, "--anew is the old name of --from-start; use --from-start instead\n");
        }
        chosen = [&request] { return end_with(calibrate_table(request)); };
    });
}

} // namespace frustumscreen::programs
