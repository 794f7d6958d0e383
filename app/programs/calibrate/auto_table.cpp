#include "app/programs/calibrate/auto_table.h"

#include "app/calibration/point_files.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/procedure_table.h"
#include "app/programs/calibrate/sheet_command.h"
#include "app/programs/devices/wiring.h"

#include <fmt/format.h>

namespace frustumscreen::programs {

namespace {

calibration::AutoPlan plan_for(const settings::Settings& settings, const CalibrateRequest& request,
                               bool crosses_follow) {
    calibration::AutoPlan plan;
    plan.rests = request.rests.value_or(plan.rests);
    plan.board_m = request.board_m.value_or(plan.board_m);
    plan.block_m = settings.calibration.block_m;
    plan.stripes =
        calibration::stripes_for(settings.projector.pinhole.width, settings.projector.pinhole.height);
    plan.crosses_follow = crosses_follow;
    return plan;
}

} // namespace

Result<WayEnd> measure_by_camera(const settings::Settings& settings, const CalibrateRequest& request,
                                 const calibration::Board& board, TableDevices& devices,
                                 bool crosses_follow) {
    const calibration::AutoSetup setup = set_up_for<calibration::AutoSetup>(described_by(settings), request);
    const calibration::AutoPlan plan = plan_for(settings, request, crosses_follow);
    const std::unique_ptr<camera::Camera> camera = make_camera(settings.camera);
    camera::CameraFrame frame;
    Sentence camera_state;
    ProcedureTable<calibration::AutoProcedure> table(
        devices, settings,
        {.solve =
             [&](calibration::AutoProcedure& way) {
                 way.judge(calibration::calibrate_auto(way.rests(), setup));
             },
         .step =
             [&](calibration::AutoProcedure& way, calibration::CalibrationInput& heard) {
                 if (camera->poll(frame)) {
                     devices.simulate_time(false); // frames come by the system's time
                     frame.time = devices.from_system_time(frame.time);
                     heard.frame = &frame;
                 }
                 heard.camera = camera->state();
                 way.step(heard);
                 if (!way.shown()) { // the camera's warnings come from the stripes
                     TableDevices::tell(camera::sentence_of(heard.camera), "camera", camera_state);
                 }
             },
         .write =
             [&](const calibration::AutoProcedure& way) {
                 return write_points(request, way.rests(), calibration::rests_text);
             },
         .keep = [&](const calibration::AutoProcedure& way) { return keep_auto(settings, *way.judged()); },
         .why_not =
             [&](std::string problem) { return calibration::AutoProcedure(board, plan, std::move(problem)); },
         .between_rounds = std::chrono::milliseconds(5)});
    calibration::AutoProcedure way(board, plan);
    TRY(const std::optional<WayEnd> end, table.measure(way));
    return ended_with(end, way.problem());
}

Result<int> calibrate_by_camera(const CalibrateRequest& request) {
    TRY(const Described described, describe(request));
    const settings::Settings& settings = *described.settings;
    if (settings.camera.kind == settings::CameraKind::None) {
        return fail(ErrorKind::BadConfiguration, "calibrate.no_camera",
                    "{}: the settings have no camera; set camera.kind = \"v4l2\", or touch crosses "
                    "(frustumscreen-calibrate table)",
                    request.config.string());
    }
    TRY(const calibration::Board board, board_of(settings));
    TRY(const std::unique_ptr<TableDevices> devices,
        TableDevices::open(request, settings, ", or give --from"));
    return measure_by_camera(settings, request, board, *devices, false).map([](WayEnd) { return 0; });
}

} // namespace frustumscreen::programs
