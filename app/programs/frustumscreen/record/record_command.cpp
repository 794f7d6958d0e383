#include "app/programs/frustumscreen/record/record_command.h"

#include "app/programs/common/argument_checks.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "app/programs/devices/wiring.h"
#include "app/scene/device_plan.h"
#include "app/settings/settings.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/service/stop_signals.h"
#include "firmware_host/tracker/pose_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <thread>

namespace frustumscreen::programs {

namespace {

constexpr Nanoseconds between_polls = std::chrono::milliseconds(2);
constexpr double longest_s = 86400.0;
/// Longest time from the recording's end to the program's, because a thread may hang in its device.
constexpr Nanoseconds longest_stop = std::chrono::milliseconds(450);

struct Request {
    std::filesystem::path config;
    std::filesystem::path output;
    double seconds = 0.0; ///< 0 = until told to stop
    bool raw = false;
};

std::optional<int> read_arguments(int argc, char** argv, Request& request) {
    CommandLine app(
        "Records what the tracker sends, unsmoothed: poses in table coordinates, or its packets with --raw.",
        "frustumscreen record");
    app.add_option("--config", request.config, "the kiosk's settings, TOML").required();
    app.add_option("-o,--output", request.output, "file to write").required();
    app.add_option("--seconds", request.seconds,
                   "stop after this many seconds (default: at SIGINT or SIGTERM)")
        .check(seconds_between(0.01, longest_s));
    app.add_flag("--raw", request.raw,
                 "record packets with their times of arrival to a new file, for frustumscreen-poses convert");
    return app.end_of_arguments(argc, argv);
}

/// Polls until the time is over or a stop is requested; prints each new state of the tracker to standard error.
class Recording {
public:
    Recording(tracker::Tracker& tracker, MonotonicTime start) : tracker_(tracker), start_(start) {}

    void run(const Request& request, const service::StopSignals& stop, bool keep) {
        ProgressLine progress("recorded seconds");
        const auto all = static_cast<std::size_t>(std::ceil(request.seconds));
        MonotonicTime now = start_;
        while ((request.seconds <= 0.0 || to_seconds(now - start_) < request.seconds) && !stop.received()) {
            poll(now, keep);
            if (all > 0) {
                progress.show(static_cast<std::size_t>(to_seconds(now - start_)), all);
            }
            std::this_thread::sleep_for(between_polls);
            now = monotonic_now();
        }
        poll(now, keep);
    }
    [[nodiscard]] const std::vector<tracker::PoseSample>& poses() const { return poses_; }
    [[nodiscard]] std::string_view state() const { return state_.view(); }

private:
    void poll(MonotonicTime now, bool keep) {
        const std::size_t before = poses_.size();
        static_cast<void>(tracker_.poll(now, poses_)); // the tracker's state tells the error
        if (!keep) {
            poses_.resize(before);
        }
        if (const Sentence said(tracker_.state()); said != state_) {
            state_ = said;
            fmt::print(stderr, "frustumscreen: tracker: {}\n", state_.view());
        }
    }

    tracker::Tracker& tracker_;
    MonotonicTime start_;
    std::vector<tracker::PoseSample> poses_;
    Sentence state_;
};

/// Times are relative to the start; sensors that belong to no station are left out.
std::vector<tracker::PoseSample> for_pose_file(const std::vector<tracker::PoseSample>& poses,
                                               MonotonicTime start) {
    std::vector<tracker::PoseSample> kept;
    for (tracker::PoseSample pose : poses) {
        if (pose.station > tracker::torch_station) {
            continue;
        }
        pose.time = MonotonicTime(pose.time - start);
        kept.push_back(pose);
    }
    return kept;
}

Result<void> write_pose_recording(const Request& request, const show::Inputs& inputs,
                                  const Recording& recording, MonotonicTime start) {
    if (recording.poses().empty()) {
        return fail(ErrorKind::DeviceLost, "record.no_pose", "no pose came, and {} was not written{}{}",
                    request.output.string(), recording.state().empty() ? "" : "; ", recording.state());
    }
    const std::vector<tracker::PoseSample> poses = for_pose_file(recording.poses(), start);
    std::array<std::size_t, tracker::torch_station + 1> of_station{};
    for (const tracker::PoseSample& pose : poses) {
        ++of_station[static_cast<std::size_t>(pose.station)];
    }
    std::string text = tracker::write_poses(poses);
    if (const std::optional<geometry::Registration>& registration = inputs.tracker->registration()) {
        const glm::dmat4 matrix = registration->table_from_tracker.matrix();
        const std::span<const double> numbers(&matrix[0][0], 16);
        text.insert(text.find('\n') + 1,
                    fmt::format("# table_from_tracker = [{}], column by column\n", fmt::join(numbers, ", ")));
    }
    TRY_VOID(write_file(request.output, as_bytes(text)));
    fmt::print("{}: {} poses: prop {}, head {}, torch {}\n", request.output.string(), poses.size(),
               of_station[1], of_station[2], of_station[3]);
    return {};
}

Result<void> end_raw_recording(tracker::PacketRecorder& recorder, std::string_view tracker_state) {
    TRY_VOID(recorder.finish());
    const tracker::PacketRecorder::Counts counts = recorder.counts();
    fmt::print("{}: {} packets, {} dropped; {}\n", recorder.path().string(), counts.packets, counts.dropped,
               tracker_state);
    return {};
}

/// `inputs` are the caller's to close, because one of their threads may hang in its device.
Result<void> record(const Request& request, show::Inputs& inputs) {
    const service::StopSignals stop;
    TRY(const settings::CheckedSettings settings, settings::load_settings(request.config));
    TRY_VOID(check_output_is_no_input(request.output, {{request.config, settings->tracker.poses}}));
    scene::DevicePlan devices;
    devices.tracker = settings->tracker.kind;
    if (devices.tracker == settings::TrackerKind::None) {
        return fail(
            ErrorKind::BadConfiguration, "record.no_tracker",
            "tracker.kind is \"none\", so there is nothing to record; name a tracker in the settings");
    }
    const MonotonicTime start = monotonic_now();
    std::unique_ptr<tracker::PacketRecorder> recorder;
    if (request.raw) {
        TRY(recorder, make_recorder(devices.tracker, request.output));
    }
    TRY(inputs, make_inputs(*settings, devices, std::nullopt, start, std::move(recorder)));
    Recording recording(*inputs.tracker, start);
    recording.run(request, stop, !request.raw);
    const service::StopSignals::AtOnce at_once(
        stop); // a disk may hang: from here a stop signal ends the program
    return request.raw ? end_raw_recording(*inputs.recorder, recording.state())
                       : write_pose_recording(request, inputs, recording, start);
}

} // namespace

int record_command(int argc, char** argv) {
    Request request;
    if (const std::optional<int> end = read_arguments(argc, argv, request)) {
        return *end;
    }
    show::Inputs inputs;
    const int status = exit_status("frustumscreen", record(request, inputs));
    std::fflush(stdout);
    if (status != 0) {
        std::quick_exit(status); // a hanging device must not delay the failure
    }
    service::end_within(longest_stop); // the file is complete; only the device is left to close
    return status;
}

} // namespace frustumscreen::programs
