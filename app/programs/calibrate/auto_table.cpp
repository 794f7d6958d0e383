#include "app/programs/calibrate/auto_table.h"

#include "app/calibration/point_files.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/sheet_command.h"
#include "app/programs/calibrate/table_pictures.h"
#include "app/programs/calibrate/table_rounds.h"
#include "app/programs/devices/wiring.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen {

namespace {

constexpr Nanoseconds between_rounds = std::chrono::milliseconds(5);

Image8 grey_picture(const StripeSetup& stripes, const Pattern& pattern) {
    const std::vector<std::uint8_t> codes = pattern_picture(stripes, pattern);
    Image8 picture(stripes.width, stripes.height);
    std::transform(codes.begin(), codes.end(), picture.texels.begin(),
                   [](std::uint8_t code) { return glm::u8vec4(code, code, code, 255); });
    return picture;
}

/// The procedure on the table, and the camera that sees it.
class CameraTable {
public:
    CameraTable(const Settings& settings, TableDevices& devices, std::unique_ptr<Camera> camera)
        : devices_(devices), camera_(std::move(camera)),
          board_px_(Board::size_m.x * settings.projector.pinhole.fx /
                    settings.projector.table_from_projector.translation.z) {}

    /// Until it is done or left; nothing: it was told to stop.
    [[nodiscard]] Result<std::optional<CalibrationStage>> run(AutoProcedure& procedure,
                                                              const AutoSetup& setup) {
        TableRounds rounds = rounds_of(procedure);
        rounds.has_ended = [&] { return procedure.has_ended(); };
        rounds.step = [&](MonotonicTime now) {
            if (procedure.stage() == CalibrationStage::Solve) {
                procedure.judge(calibrate_auto(procedure.rests(), setup));
            }
            step(procedure, now);
        };
        return run_rounds(devices_, rounds).map([&](bool ended) {
            return ended ? std::optional(procedure.stage()) : std::nullopt;
        });
    }
    /// Leaves the last words to be read.
    void stay(const AutoProcedure& procedure) { frustumscreen::stay(devices_, rounds_of(procedure)); }

private:
    [[nodiscard]] TableRounds rounds_of(const AutoProcedure& procedure) {
        TableRounds rounds;
        rounds.show = [&](MonotonicTime now) { return show(procedure, now); };
        rounds.between = between_rounds;
        rounds.with_camera = true;
        return rounds;
    }
    void step(AutoProcedure& procedure, MonotonicTime now) {
        const TableDevices::Heard heard = devices_.hear(now);
        const CameraFrame* const frame = camera_->poll(frame_) ? &frame_ : nullptr;
        const CameraState state = camera_->state();
        procedure.step({now, heard.prop, heard.next, heard.back, std::nullopt, frame, state, lit_});
        if (!procedure.shown()) { // what the stripes do to the camera is no fault of it
            TableDevices::tell(sentence_of(state), "camera", camera_state_);
        }
    }
    [[nodiscard]] Result<void> show(const AutoProcedure& procedure, MonotonicTime now) {
        draw(procedure);
        const Result<MonotonicTime> lit = devices_.present(now);
        if (lit && (!lit_ || lit_->number != procedure.number())) {
            lit_ = CalibrationInput::Lit{procedure.number(), *lit};
        }
        return lit.map([](MonotonicTime) {});
    }
    /// Where something else is to be shown than before.
    void draw(const AutoProcedure& procedure) {
        const bool is_new = drawn_ != procedure.number();
        drawn_ = procedure.number();
        if (procedure.shown()) {
            if (is_new) {
                devices_.show(grey_picture(procedure.plan().stripes, *procedure.shown()));
            }
            words_ = {};
            return;
        }
        TableWords words = table_words(procedure);
        if (is_new || words != words_) {
            words_ = std::move(words);
            devices_.say(words_.lines, words_.key);
            devices_.show(auto_picture(procedure, devices_.width(), devices_.height(), board_px_,
                                       devices_.typesetter(), devices_.house()));
        }
    }

    TableDevices& devices_;
    std::unique_ptr<Camera> camera_;
    double board_px_;
    TableWords words_;                   ///< that are shown
    std::optional<std::uint64_t> drawn_; ///< number of what is shown
    std::optional<CalibrationInput::Lit> lit_;
    CameraFrame frame_;
    Sentence camera_state_;
};

AutoPlan plan_for(const Settings& settings, const CalibrateRequest& request, bool crosses_follow) {
    AutoPlan plan;
    plan.rests = request.rests.value_or(plan.rests);
    plan.board_m = request.board_m.value_or(plan.board_m);
    plan.block_m = settings.calibration.block_m;
    plan.stripes = stripes_for(settings.projector.pinhole.width, settings.projector.pinhole.height);
    plan.crosses_follow = crosses_follow;
    return plan;
}

/// Nothing that was seen is lost.
Result<void> write_rests(const CalibrateRequest& request, const Rests& rests) {
    return request.out.empty() || rests.empty() ? Result<void>()
                                                : write_file(request.out, as_bytes(rests_text(rests)));
}

} // namespace

Result<WayEnd> measure_by_camera(const Settings& settings, const CalibrateRequest& request,
                                 const Board& board, TableDevices& devices, bool crosses_follow) {
    const Described described = described_by(settings);
    const AutoSetup setup = set_up_for<AutoSetup>(described, request);
    const AutoPlan plan = plan_for(settings, request, crosses_follow);
    CameraTable table(settings, devices, make_camera(settings.camera));
    AutoProcedure procedure(board, plan);
    const Result<std::optional<CalibrationStage>> ended = table.run(procedure, setup);
    TRY_VOID(write_rests(request, procedure.rests()));
    TRY_VOID(ended);
    if (*ended == CalibrationStage::GoesOn) {
        return WayEnd::GoesOn;
    }
    Result<void> kept = ended_without();
    if (*ended == CalibrationStage::Done) {
        kept = keep_auto(settings, *procedure.judged());
    }
    if (*ended == CalibrationStage::Done && !kept) { // nobody reads a service's standard error
        AutoProcedure told(board, plan, kept.error().message);
        static_cast<void>(table.run(told, setup));
    } else if (*ended) {
        table.stay(procedure);
    }
    return kept.map([] { return WayEnd::Kept; });
}

Result<int> calibrate_by_camera(const CalibrateRequest& request) {
    TRY(const Described described, describe(request));
    const Settings& settings = *described.settings;
    if (settings.camera.kind == CameraKind::None) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format("{}: the settings have no camera; set camera.kind = \"v4l2\", or touch crosses "
                        "(frustumscreen-calibrate table)",
                        request.config.string()));
    }
    TRY(const Board board, board_of(settings));
    TRY(const std::unique_ptr<TableDevices> devices,
        TableDevices::open(request, settings, ", or give --from"));
    return measure_by_camera(settings, request, board, *devices, false).map([](WayEnd) { return 0; });
}

} // namespace frustumscreen
