#include "app/programs/calibrate/auto_table.h"

#include "app/calibration/point_files.h"
#include "app/programs/calibrate/auto_picture.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/sheet_command.h"
#include "app/programs/calibrate/table_voice.h"
#include "app/programs/devices/wiring.h"
#include "app/render/picture_upload.h"
#include "app/show/house_words.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/service/service_manager.h"
#include "firmware_host/service/stop_signals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <thread>

namespace frustumscreen {

namespace {

constexpr const char* program = "frustumscreen-calibrate";
constexpr int back_button = 0;
constexpr int next_button = 1;
constexpr Nanoseconds between_rounds = std::chrono::milliseconds(5);

Image8 grey_picture(const StripeSetup& stripes, const Pattern& pattern) {
    const std::vector<std::uint8_t> codes = pattern_picture(stripes, pattern);
    Image8 picture(stripes.width, stripes.height);
    std::transform(codes.begin(), codes.end(), picture.texels.begin(),
                   [](std::uint8_t code) { return glm::u8vec4(code, code, code, 255); });
    return picture;
}

/// A calibration goes on without a voice.
std::optional<TableVoice> voice_of(const Settings& settings) {
    if (settings.exhibit.words.empty() || settings.sound.kind == SoundKind::None) {
        return std::nullopt;
    }
    const Result<LanguageWords> words = read_house_words(settings, "calibration.begin");
    if (!words) {
        say_line(program, words.error().message);
        return std::nullopt;
    }
    return TableVoice(*words, make_sound(settings.sound), settings.sound.gain_db);
}

/// The devices, and what is shown.
class CameraTable {
public:
    CameraTable(const Settings& settings, Inputs inputs, std::unique_ptr<Camera> camera,
                std::unique_ptr<Display> display, Typesetter typesetter)
        : inputs_(std::move(inputs)), camera_(std::move(camera)), display_(std::move(display)),
          typesetter_(std::move(typesetter)), upload_(display_->width(), display_->height()),
          voice_(voice_of(settings)), board_px_(Board::size_m.x * settings.projector.pinhole.fx /
                                                settings.projector.table_from_projector.translation.z) {}

    /// Until it is done or left; nothing: it was told to stop.
    [[nodiscard]] Result<std::optional<AutoStage>> run(AutoProcedure& procedure, const AutoSetup& setup) {
        while (!stop_.received()) {
            const MonotonicTime now = monotonic_now();
            if (Result<void> shown = show(procedure, now); !shown) {
                return tl::unexpected<Error>(shown.error());
            }
            if (procedure.stage() == AutoStage::Done || procedure.stage() == AutoStage::Left) {
                return std::optional(procedure.stage());
            }
            if (procedure.stage() == AutoStage::Solve) {
                procedure.judge(calibrate_auto(procedure.rests(), setup));
            }
            poll(procedure, now);
            std::this_thread::sleep_for(between_rounds);
        }
        return std::optional<AutoStage>();
    }
    /// Leaves the last words to be read.
    void stay(const AutoProcedure& procedure) {
        const MonotonicTime end = monotonic_now() + last_words;
        while (!stop_.received() && monotonic_now() < end && show(procedure, monotonic_now())) {
            std::this_thread::sleep_for(between_rounds);
        }
    }

private:
    void poll(AutoProcedure& procedure, MonotonicTime now) {
        AutoProcedure::Input input;
        input.now = now;
        input.lit = lit_;
        samples_.clear();
        static_cast<void>(inputs_.tracker->poll(now, samples_)); // its state says what is wrong
        for (const PoseSample& sample : samples_) {
            if (sample.station == prop_station && sample.ok) {
                input.report = RigidTransform{sample.rotation, sample.position_m};
            }
        }
        events_.clear();
        static_cast<void>(inputs_.panel->poll(now, events_));
        for (const PanelEvent& event : events_) {
            input.next |= event.kind == PressKind::Press && event.button == next_button;
            input.back |= event.kind == PressKind::Press && event.button == back_button;
        }
        input.frame = camera_->poll(frame_) ? &frame_ : nullptr;
        input.camera = camera_->state();
        procedure.step(input);
        tell(inputs_.tracker->state(), "tracker", tracker_state_);
        tell(inputs_.panel->state(), "panel", panel_state_);
        if (!procedure.shown()) { // what the stripes do to the camera is no fault of it
            tell(sentence_of(input.camera), "camera", camera_state_);
        }
    }
    static void tell(std::string_view state, std::string_view device, Sentence& told) {
        if (const Sentence now(state); now != told) {
            told = now;
            say_line(program, fmt::format("{}: {}", device, state));
        }
    }
    /// A picture goes into each of the display's buffers once.
    [[nodiscard]] Result<void> show(const AutoProcedure& procedure, MonotonicTime now) {
        draw(procedure);
        if (uploads_left_ > 0 || display_->buffer_age() == 0) {
            uploads_left_ = std::max(uploads_left_ - 1, 0);
            upload_.show(picture_, display_->framebuffer());
        }
        if (voice_) {
            voice_->poll(now);
        }
        const Result<MonotonicTime> lit = display_->present(now);
        if (!lit) {
            return tl::unexpected<Error>(lit.error());
        }
        if (!lit_ || lit_->number != procedure.number()) {
            lit_ = AutoProcedure::Lit{procedure.number(), *lit};
        }
        if (!fed_) {
            manager_.ready();
        }
        if (!fed_ || now - *fed_ >= between_feeds) {
            manager_.feed_watchdog();
            fed_ = now;
        }
        return {};
    }
    /// Where something else is to be shown than before.
    void draw(const AutoProcedure& procedure) {
        if (procedure.shown()) {
            if (drawn_ != procedure.number()) {
                picture_ = grey_picture(procedure.plan().stripes, *procedure.shown());
                uploads_left_ = most_buffers;
            }
            drawn_ = procedure.number();
            words_.clear();
            return;
        }
        std::vector<std::string> words = auto_words(procedure);
        if (words != words_ || drawn_ != procedure.number()) {
            words_ = std::move(words);
            drawn_ = procedure.number();
            uploads_left_ = most_buffers;
            say_line(program, fmt::format("{}", fmt::join(words_, " ")));
            picture_ = auto_picture(procedure, display_->width(), display_->height(), board_px_, typesetter_);
            if (voice_) {
                voice_->say(word_key(procedure));
            }
        }
    }

    static constexpr int most_buffers = 4; ///< of a display
    static constexpr Nanoseconds between_feeds = std::chrono::seconds(1);
    static constexpr Nanoseconds last_words = std::chrono::seconds(3);

    StopSignals stop_;
    ServiceManager manager_;
    std::optional<MonotonicTime> fed_;
    Inputs inputs_;
    std::unique_ptr<Camera> camera_;
    std::unique_ptr<Display> display_;
    Typesetter typesetter_;
    PictureUpload upload_;
    std::optional<TableVoice> voice_; ///< none: it is silent
    double board_px_;
    Image8 picture_;
    std::vector<std::string> words_;     ///< that are shown
    std::optional<std::uint64_t> drawn_; ///< number of what is shown
    int uploads_left_ = 0;
    std::optional<AutoProcedure::Lit> lit_;
    CameraFrame frame_;
    std::vector<PoseSample> samples_;
    std::vector<PanelEvent> events_;
    Sentence tracker_state_, panel_state_, camera_state_;
};

/// From the first words on the table to the kept file.
Result<int> go_through(CameraTable& table, const Settings& settings, const Board& board, const AutoPlan& plan,
                       const AutoSetup& setup, const std::filesystem::path& out) {
    AutoProcedure procedure(board, plan);
    const Result<std::optional<AutoStage>> ended = table.run(procedure, setup);
    if (!out.empty() && procedure.taken() > 0) { // nothing that was seen is lost
        if (const Result<void> written = write_file(out, as_bytes(rests_text(procedure.rests()))); !written) {
            return tl::unexpected<Error>(written.error());
        }
    }
    if (!ended) {
        return tl::unexpected<Error>(ended.error());
    }
    Result<void> kept =
        fail(ErrorKind::BadInput, "it ended before a calibration was kept; the one before counts");
    if (*ended == AutoStage::Done) {
        kept = keep_auto(settings, *procedure.judged());
    }
    if (*ended == AutoStage::Done && !kept) { // nobody reads a service's standard error
        AutoProcedure told(board, plan, kept.error().message);
        static_cast<void>(table.run(told, setup));
    } else if (*ended) {
        table.stay(procedure);
    }
    return kept.map([] { return 0; });
}

Result<void> check(const CalibrateRequest& request, const Settings& settings, const DevicePlan& plan) {
    if (plan.tracker == TrackerKind::None || !plan.panel) {
        return fail(ErrorKind::BadConfiguration,
                    fmt::format("{}: a calibration on the table needs a tracker and two buttons; set "
                                "tracker.kind and panel.kind, or give --from",
                                request.config.string()));
    }
    if (settings.camera.kind == CameraKind::None) {
        return fail(
            ErrorKind::BadConfiguration,
            fmt::format("{}: the settings have no camera; set camera.kind = \"v4l2\", or touch crosses "
                        "(frustumscreen-calibrate table)",
                        request.config.string()));
    }
    return {};
}

} // namespace

Result<int> calibrate_by_camera(const CalibrateRequest& request) {
    const Result<Described> described = describe(request);
    if (!described) {
        return tl::unexpected<Error>(described.error());
    }
    const Settings& settings = *described->settings;
    Settings raw = settings;
    raw.tracker.registration = {}; // the device's own reports
    raw.camera.tags = false;
    const DevicePlan devices = plan_devices(raw, false, false);
    if (const Result<void> can = check(request, settings, devices); !can) {
        return tl::unexpected<Error>(can.error());
    }
    const Result<Board> board = board_of(settings);
    if (!board) {
        return tl::unexpected<Error>(board.error());
    }
    const rlimit none{0, 0};
    static_cast<void>(::setrlimit(RLIMIT_CORE, &none)); // a frame would lie in it
    Result<std::unique_ptr<Display>> display = make_display(raw, request.headless);
    if (!display) {
        return tl::unexpected<Error>(display.error());
    }
    Result<Typesetter> typesetter = Typesetter::open();
    if (!typesetter) {
        return tl::unexpected<Error>(typesetter.error());
    }
    Result<Inputs> inputs = make_inputs(raw, devices, std::nullopt, monotonic_now());
    if (!inputs) {
        return tl::unexpected<Error>(inputs.error());
    }
    AutoPlan plan;
    plan.rests = request.rests.value_or(plan.rests);
    plan.board_m = request.board_m.value_or(plan.board_m);
    plan.block_m = settings.calibration.block_m;
    plan.stripes = stripes_for(described->width, described->height);
    CameraTable table(raw, *std::move(inputs), make_camera(settings.camera), *std::move(display),
                      *std::move(typesetter));
    return go_through(table, settings, *board, plan, set_up_for<AutoSetup>(*described, request), request.out);
}

} // namespace frustumscreen
