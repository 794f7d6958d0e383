/// frustumscreen-poses: makes pose files from recordings of other trackers, from the simulated visitor, and
/// along a path.
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/settings/lit_zone.h"
#include "app/settings/settings.h"
#include "app/tracking/registered_tracker.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/base/version.h"
#include "firmware_host/tracker/convert_recording.h"
#include "firmware_host/tracker/packet_replay.h"
#include "firmware_host/tracker/pose_file.h"
#include "firmware_host/tracker/pose_path.h"
#include "firmware_host/tracker/simulated_tracker.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace frustumscreen::programs {
namespace {

constexpr std::size_t largest_text_bytes = std::size_t{1} << 30;

struct ConvertRequest {
    std::string input;
    std::string output;
    std::string settings; ///< for packets: the settings with the registration
    tracker::RecordingOptions recording;
};

struct PathRequest {
    std::string input;
    std::string output;
    double rate_hz = 60.0;
};

struct SimulateRequest {
    std::string settings;
    std::string output;
    std::uint64_t seed = 1;
    double seconds = 30.0;
    double rate_hz = 60.0;
};

Result<void> write_pose_file(const std::string& path, const std::string& comment,
                             const std::vector<tracker::PoseSample>& samples) {
    // The header stays the first line, for readers that expect no comments before it.
    std::string text = tracker::write_poses(samples);
    text.insert(text.find('\n') + 1, "# " + comment + "\n");
    return write_file(path, as_bytes(text));
}

/// Converts packets of `frustumscreen record --raw` to the poses that the exhibit received.
Result<void> convert_packets(const ConvertRequest& request, Bytes bytes) {
    TRY(tracker::PacketReplay replay, tracker::PacketReplay::open(std::move(bytes), request.input));
    std::vector<tracker::PoseSample> samples;
    replay.play(replay.end(), samples);
    if (!request.settings.empty() && !replay.reports_table_frame()) {
        TRY(const auto settings, settings::load_settings(request.settings));
        tracking::place_on_table(samples, settings::registration_of(*settings));
    }
    std::erase_if(samples,
                  [](const tracker::PoseSample& sample) { return sample.station > tracker::torch_station; });
    for (tracker::PoseSample& sample : samples) {
        sample.time = MonotonicTime(sample.time - replay.begin());
    }
    const std::string comment =
        fmt::format("{} poses of {} packets over {:.3f} s; {} packets that the recorder dropped, {} bytes "
                    "behind a cut left out",
                    samples.size(), replay.packets(), to_seconds(replay.end() - replay.begin()),
                    replay.dropped(), replay.left_bytes());
    Result<void> written = write_pose_file(request.output, comment, samples);
    if (written) {
        fmt::print("{}: {}\n", request.output, comment);
    }
    return written;
}

Result<void> convert(const ConvertRequest& request) {
    TRY_VOID(check_output_is_no_input(request.output, {{request.input, request.settings}}));
    TRY(Bytes bytes, read_file(request.input));
    if (tracker::is_packet_recording(bytes)) {
        return convert_packets(request, std::move(bytes));
    }
    if (bytes.size() > largest_text_bytes) {
        return bad_input("poses.too_long", "{}: {} bytes; at most {} are allowed", request.input,
                         bytes.size(), largest_text_bytes);
    }
    TRY(const auto converted, tracker::convert_recording(as_text(bytes), request.input, request.recording));
    const std::string comment =
        fmt::format("{} poses; left out {} rows that did not step forward in time; "
                    "mended {} changes of sign; scale {:.4g}",
                    converted.samples.size(), converted.dropped_rows, converted.sign_flips, converted.scale);
    Result<void> written = write_pose_file(request.output, comment, converted.samples);
    if (written) {
        fmt::print("{}: {}\n", request.output, comment);
    }
    return written;
}

/// The prop stays where every face is lit at every yaw, for any eye.
Result<tracker::SimulatedVisitor> visitor_for(const SimulateRequest& request) {
    TRY(const auto settings, settings::load_settings(request.settings));
    const settings::Rectangle places = settings::lit_rectangle(*settings);
    tracker::SimulatedVisitor visitor;
    visitor.seed = request.seed;
    visitor.centre_m = places.centre_m;
    visitor.half_extent_m = places.half_m;
    visitor.eye_m = settings->eye.default_m;
    visitor.rate_hz = request.rate_hz;
    visitor.torch = settings->torch.by_tracker();
    return visitor;
}

Result<void> simulate(const SimulateRequest& request) {
    TRY_VOID(check_output_is_no_input(request.output, {{request.settings}}));
    TRY(const tracker::SimulatedVisitor visitor, visitor_for(request));
    std::vector<tracker::PoseSample> samples;
    // The last pose is one period before the end: S seconds at H hertz give S x H poses of each station.
    const auto last_ns = static_cast<std::int64_t>((request.seconds - 0.5 / request.rate_hz) * 1e9);
    tracker::SimulatedTracker tracker(visitor, MonotonicTime{});
    TRY_VOID(tracker.poll(MonotonicTime(Nanoseconds(last_ns)), samples));
    return write_pose_file(request.output,
                           fmt::format("a simulated visitor; seed {}, {} s at {} Hz", request.seed,
                                       request.seconds, request.rate_hz),
                           samples);
}

Result<void> follow_path(const PathRequest& request) {
    TRY_VOID(check_output_is_no_input(request.output, {{request.input}}));
    TRY(const Bytes bytes, read_file(request.input));
    TRY(const auto keys,
        tracker::parse_poses(as_text(bytes), request.input, tracker::PoseOrder::PropAscends));
    const Nanoseconds period(static_cast<Nanoseconds::rep>(1e9 / request.rate_hz));
    TRY(const std::vector<tracker::PoseSample> path, at(request.input, tracker::pose_path(keys, period)));
    return write_pose_file(
        request.output, fmt::format("a path through {} poses at {} Hz", keys.size(), request.rate_hz), path);
}

void add_convert(CommandLine& app, ConvertRequest& request, std::vector<double>& within) {
    CommandLine command = app.add_subcommand(
        "convert", "converts a recording (rows of t x y z qx qy qz qw in seconds and metres, or packets)");
    command
        .add_option("INPUT", request.input,
                    "recording: CSV, the TUM benchmark's text, or packets of frustumscreen record --raw")
        .required();
    command.add_option("-o,--output", request.output, "pose file to write").required();
    command.add_option("--config", request.settings,
                       "for packets: settings whose table_from_tracker places the poses on the table");
    command.add_option("--station", request.recording.station, "station to convert: 1 prop, 2 head, 3 torch")
        .within(1, 3)
        .capture_default_str();
    command.add_flag("--flat", request.recording.flat,
                     "keep only x, y and the turn about Z, to lay the motion onto the table");
    command
        .add_option("--within", within,
                    "with --flat: half the width and half the depth of the prop's area, metres")
        .expected(2)
        .within(0.001, 10.0);
}

void add_simulate(CommandLine& app, SimulateRequest& request) {
    CommandLine command = app.add_subcommand("simulate", "simulates a visitor");
    command.add_option("--config", request.settings, "settings, TOML: table, light and eye").required();
    command.add_option("-o,--output", request.output, "pose file to write").required();
    command.add_option("--seed", request.seed, "seed of the visit").capture_default_str();
    command.add_option("--seconds", request.seconds, "length, seconds")
        .within(0.001, 86400.0)
        .capture_default_str();
    command.add_option("--hz", request.rate_hz, "poses per second").within(0.1, 1000.0).capture_default_str();
}

void add_path(CommandLine& app, PathRequest& request) {
    CommandLine command = app.add_subcommand("path", "draws a smooth path through a few poses");
    command.add_option("INPUT", request.input, "pose file with the poses to pass").required();
    command.add_option("-o,--output", request.output, "pose file to write").required();
    command.add_option("--hz", request.rate_hz, "poses per second").within(0.1, 1000.0).capture_default_str();
}

int run(int argc, char** argv) {
    CommandLine app("Makes pose files: from recordings of trackers, of a simulated visitor, or along a path.",
                    "frustumscreen-poses");
    app.set_version_flag("--version", name_and_version("frustumscreen-poses"));
    app.require_subcommand();
    ConvertRequest to_convert;
    SimulateRequest to_simulate;
    PathRequest to_follow;
    std::vector<double> within;
    add_convert(app, to_convert, within);
    add_simulate(app, to_simulate);
    add_path(app, to_follow);
    if (const auto end = app.end_of_arguments(argc, argv)) {
        return *end;
    }
    if (within.size() == 2) {
        to_convert.recording.half_extent_m = {within[0], within[1]};
    }
    const Result<void> done = app.got_subcommand("convert") ? convert(to_convert)
                              : app.got_subcommand("path")  ? follow_path(to_follow)
                                                            : simulate(to_simulate);
    if (!done) {
        complain("frustumscreen-poses", done.error());
        return 1;
    }
    return 0;
}

} // namespace
} // namespace frustumscreen::programs

int main(int argc, char** argv) {
    return frustumscreen::programs::guarded_main("frustumscreen-poses", frustumscreen::programs::run, argc,
                                                 argv);
}
