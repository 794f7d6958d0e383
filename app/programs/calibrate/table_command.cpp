#include "app/programs/calibrate/table_command.h"

#include "app/calibration/point_files.h"
#include "app/calibration/touch_procedure.h"
#include "app/programs/calibrate/kept_command.h"
#include "app/programs/calibrate/table_voice.h"
#include "app/programs/calibrate/touch_command.h"
#include "app/programs/calibrate/touch_picture.h"
#include "app/programs/devices/wiring.h"
#include "app/render/picture_upload.h"
#include "app/settings/settings.h"
#include "app/show/house_words.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/service/service_manager.h"
#include "firmware_host/service/stop_signals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <thread>

namespace frustumscreen {

namespace {

constexpr int back_button = 0;
constexpr int next_button = 1;
constexpr Nanoseconds between_frames = std::chrono::milliseconds(20);

/// The projector as the settings describe it decides where the crosses lie: what a cross tells hardly depends on it.
std::vector<Cross> crosses_for(const Settings& settings, const CalibrateRequest& request) {
    const CalibrationSettings& own = settings.calibration;
    CrossSetup setup;
    setup.count = request.touches.value_or(own.touches);
    setup.block_m = request.block_m.value_or(own.block_m);
    setup.top_m = settings.prop.height_m;
    const double above_m = settings.projector.table_from_projector.translation.z;
    return choose_crosses(
        rough_model(settings.projector.pinhole.ideal(), above_m, request.sensor_height_m.value_or(0.0)),
        setup);
}

/// Of the sensor above the prop's bottom: as it is asked for, else as the settings have it, else as it was measured before.
std::optional<double> sensor_height(const Settings& settings, const CalibrateRequest& request) {
    if (request.sensor_height_m) {
        return request.sensor_height_m;
    }
    if (settings.calibration.sensor_height_m != 0.0) {
        return settings.calibration.sensor_height_m;
    }
    const double above_m = settings.tracker.registration.sensor_from_prop.inverse().translation.z;
    return above_m != 0.0 ? std::optional(above_m) : std::nullopt;
}

constexpr const char* no_sensor_height =
    "nobody knows how high the sensor is above the prop's bottom; measure it with a ruler and set "
    "calibration.sensor_height_m";

/// A calibration goes on without them, in English.
std::optional<LanguageWords> house_words(const Settings& settings) {
    if (settings.exhibit.words.empty()) {
        return std::nullopt;
    }
    Result<LanguageWords> words = read_house_words(settings, "calibration.lay");
    if (!words) {
        say_line("frustumscreen-calibrate", words.error().message);
        return std::nullopt;
    }
    return *std::move(words);
}

std::optional<TableVoice> voice_of(const Settings& settings, const std::optional<LanguageWords>& words) {
    if (!words || settings.sound.kind == SoundKind::None) {
        return std::nullopt;
    }
    return TableVoice(*words, make_sound(settings.sound), settings.sound.gain_db);
}

/// The devices, and what is shown.
class Table {
public:
    Table(const Settings& settings, Inputs inputs, std::unique_ptr<Display> display, Typesetter typesetter)
        : inputs_(std::move(inputs)), display_(std::move(display)), typesetter_(std::move(typesetter)),
          upload_(display_->width(), display_->height()), house_(house_words(settings)),
          voice_(voice_of(settings, house_)),
          prop_px_(settings.prop.base_m * settings.projector.pinhole.fx /
                   settings.projector.table_from_projector.translation.z) {}

    /// Until it is done or left; nothing: it was told to stop.
    [[nodiscard]] Result<std::optional<TouchStage>> run(TouchProcedure& procedure, const TouchSetup& setup) {
        while (!stop_.received()) {
            const MonotonicTime now = monotonic_now();
            if (Result<void> shown = show(procedure, now); !shown) {
                return tl::unexpected<Error>(shown.error());
            }
            if (procedure.stage() == TouchStage::Done || procedure.stage() == TouchStage::Left) {
                return std::optional(procedure.stage());
            }
            if (procedure.stage() == TouchStage::Solve) {
                procedure.judge(calibrate_touch(procedure.touches(), setup));
            }
            poll(procedure, now);
            std::this_thread::sleep_for(between_frames);
        }
        return std::optional<TouchStage>();
    }
    /// Leaves the last words to be read.
    void stay(const TouchProcedure& procedure) {
        const MonotonicTime end = monotonic_now() + last_words;
        while (!stop_.received() && monotonic_now() < end && show(procedure, monotonic_now())) {
            std::this_thread::sleep_for(between_frames);
        }
    }

private:
    void poll(TouchProcedure& procedure, MonotonicTime now) {
        TouchProcedure::Input input{now, std::nullopt, false, false};
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
        procedure.step(input);
        tell(inputs_.tracker->state(), "tracker", tracker_state_);
        tell(inputs_.panel->state(), "panel", panel_state_);
    }
    static void tell(std::string_view state, std::string_view device, Sentence& told) {
        if (const Sentence now(state); now != told) {
            told = now;
            say_line("frustumscreen-calibrate", fmt::format("{}: {}", device, state));
        }
    }
    [[nodiscard]] Result<void> show(const TouchProcedure& procedure, MonotonicTime now) {
        const Shown next{procedure.stage(), procedure.word(), procedure.at()};
        if (next != shown_) {
            shown_ = next;
            uploads_left_ = most_buffers;
            say_line("frustumscreen-calibrate", fmt::format("{}", fmt::join(touch_words(procedure), " ")));
            picture_ = touch_picture(procedure, display_->width(), display_->height(), prop_px_, typesetter_,
                                     house_ ? &*house_ : nullptr);
            if (voice_) {
                voice_->say(word_key(procedure));
            }
        }
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
        if (!fed_) {
            manager_.ready();
        }
        if (!fed_ || now - *fed_ >= between_feeds) {
            manager_.feed_watchdog();
            fed_ = now;
        }
        return {};
    }

    /// What the picture depends on.
    struct Shown {
        TouchStage stage = TouchStage::Lay;
        TouchWord word = TouchWord::None;
        std::size_t at = 0;
        [[nodiscard]] bool operator==(const Shown&) const = default;
    };
    static constexpr int most_buffers = 4; ///< of a display: each gets the picture once

    static constexpr Nanoseconds between_feeds = std::chrono::seconds(1);
    static constexpr Nanoseconds last_words = std::chrono::seconds(3);

    StopSignals stop_;
    ServiceManager manager_;
    std::optional<MonotonicTime> fed_;
    Inputs inputs_;
    std::unique_ptr<Display> display_;
    Typesetter typesetter_;
    PictureUpload upload_;
    std::optional<LanguageWords> house_; ///< none: it is silent, and in English alone
    std::optional<TableVoice> voice_;
    double prop_px_;
    Image8 picture_;
    std::optional<Shown> shown_;
    int uploads_left_ = 0;
    std::vector<PoseSample> samples_;
    std::vector<PanelEvent> events_;
    Sentence tracker_state_, panel_state_;
};

nlohmann::ordered_json crosses_json(const std::vector<Cross>& crosses) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Cross& cross : crosses) {
        list.push_back({{"u_px", cross.pixel.x},
                        {"v_px", cross.pixel.y},
                        {"block_m", cross.block_m},
                        {"turn_deg", glm::degrees(cross.yaw_rad)}});
    }
    return {{"crosses", list}};
}

/// From the first word on the table to the kept file.
Result<int> go_through(Table& table, const Settings& settings, const std::vector<Cross>& crosses,
                       const TouchSetup& setup, const std::filesystem::path& out) {
    TouchProcedure procedure(crosses, setup.sensor_height_m ? "" : no_sensor_height);
    const Result<std::optional<TouchStage>> ended = table.run(procedure, setup);
    if (!out.empty() && !procedure.touches().empty()) { // nothing that was touched is lost
        if (const Result<void> written = write_file(out, as_bytes(touches_text(procedure.touches())));
            !written) {
            return tl::unexpected<Error>(written.error());
        }
    }
    if (!ended) {
        return tl::unexpected<Error>(ended.error());
    }
    Result<void> kept =
        fail(ErrorKind::BadInput, procedure.problem().empty()
                                      ? "it ended before a calibration was kept; the one before counts"
                                      : procedure.problem());
    if (*ended == TouchStage::Done) {
        kept = keep_touch(settings, *procedure.judged(), procedure.touches());
    }
    if (*ended == TouchStage::Done && !kept) { // nobody reads a service's standard error
        TouchProcedure told(crosses, kept.error().message);
        static_cast<void>(table.run(told, setup));
    } else if (*ended) {
        table.stay(procedure);
    }
    return kept.map([] { return 0; });
}

Result<int> calibrate_table(const CalibrateRequest& request) {
    const Result<Described> described = describe(request);
    if (!described) {
        return tl::unexpected<Error>(described.error());
    }
    const Settings& settings = *described->settings;
    const std::vector<Cross> crosses = crosses_for(settings, request);
    if (request.json) {
        fmt::print("{}\n", crosses_json(crosses).dump(2));
        return 0;
    }
    Settings raw = settings;
    raw.tracker.registration = {}; // the device's own reports
    raw.camera.tags = raw.camera.visitor = false;
    const DevicePlan plan = plan_devices(raw, false, false);
    if (plan.tracker == TrackerKind::None || !plan.panel) {
        return fail(ErrorKind::BadConfiguration,
                    fmt::format("{}: a calibration on the table needs a tracker and two buttons; set "
                                "tracker.kind and panel.kind",
                                request.config.string()));
    }
    Result<std::unique_ptr<Display>> display = make_display(raw, request.headless);
    if (!display) {
        return tl::unexpected<Error>(display.error());
    }
    Result<Typesetter> typesetter = Typesetter::open();
    if (!typesetter) {
        return tl::unexpected<Error>(typesetter.error());
    }
    Result<Inputs> inputs = make_inputs(raw, plan, std::nullopt, monotonic_now());
    if (!inputs) {
        return tl::unexpected<Error>(inputs.error());
    }
    CalibrateRequest known = request;
    known.sensor_height_m = sensor_height(settings, request);
    Table table(raw, *std::move(inputs), *std::move(display), *std::move(typesetter));
    return go_through(table, settings, crosses, set_up_for<TouchSetup>(*described, known), request.out);
}

} // namespace

void add_table_command(CLI::App& app, CalibrateRequest& request, std::function<int()>& chosen) {
    CLI::App* const command =
        app.add_subcommand("table", "on the table itself, step by step: the projector shows crosses, the "
                                    "prop is laid on them; Back and Next are the "
                                    "first and the second button");
    command->add_option("--config", request.config, "the kiosk's settings, TOML")->required();
    command
        ->add_option("--touches", request.touches,
                     "how many crosses, 6 to 30; this and the next two are else as the settings have them")
        ->check(CLI::Range(6, 30));
    command
        ->add_option("--block", request.block_m, "how high a block raises the prop for half of them, metres")
        ->check(CLI::Range(0.02, 0.5));
    command
        ->add_option("--sensor-height", request.sensor_height_m, "the sensor above the prop's bottom, metres")
        ->check(CLI::Range(-2.0, 2.0));
    command->add_option("--out", request.out, "writes the touches, CSV, for frustumscreen-calibrate touch");
    command->add_flag("--headless", request.headless, "without a screen, for tests");
    command->add_flag("--json", request.json, "prints the crosses and ends");
    command->callback([&] { chosen = [&] { return end_with(calibrate_table(request)); }; });
}

} // namespace frustumscreen
