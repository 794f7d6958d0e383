/// The request of a command: its input file, its picture and its options.
///
/// Threads  the main one.
#pragma once

#include "app/calibration/verdict.h"
#include "app/geometry/pinhole.h"
#include "app/geometry/transform.h"
#include "app/programs/common/command_line.h"
#include "app/settings/settings.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::programs {

struct CalibrateRequest {
    std::filesystem::path from;
    std::filesystem::path config;
    std::vector<int> picture; ///< width, height
    std::optional<double> sensor_height_m;
    bool keep = false;
    bool touch_up = false;     ///< touches up the kept calibration instead of making a new one
    std::filesystem::path map; ///< file for the picture of the uncertainty; empty: none
    bool undo = false;
    bool from_start = false; ///< a whole calibration on the table, even if a touch-up is possible
    // On the table; the settings supply what is absent:
    std::optional<int> touches;
    std::optional<double> block_m;
    std::optional<int> rests;
    std::optional<double> board_m;
    std::filesystem::path out;
    bool headless = false;
    bool json = false;
};

/// Data known before anything is measured.
struct Described {
    std::optional<settings::Settings> settings; ///< none if --picture replaces them
    int width = 0;                              ///< of the picture
    int height = 0;
    double top_m = 0.12; ///< the prop's height
};

void add_common_options(CommandLine& command, CalibrateRequest& request);
void add_map_option(CommandLine& command, CalibrateRequest& request);
void add_keep_option(CommandLine& command, CalibrateRequest& request);
/// --sensor-height, --keep and --map.
void add_touch_options(CommandLine& command, CalibrateRequest& request);
/// Throws a WrongUse if options contradict each other.
void check_request(const CalibrateRequest& request);
[[nodiscard]] Result<Described> describe(const CalibrateRequest& request);
/// Refuses a solid, whose foot is no square.
[[nodiscard]] Result<void> check_square_foot(const settings::PropSettings& prop);
/// Refuses stereo, in which the projector stretches each eye's picture, or shows the two in turn.
[[nodiscard]] Result<void> check_own_pixels(const settings::Settings& settings,
                                            const std::filesystem::path& config);
[[nodiscard]] Described described_by(const settings::Settings& settings);
/// Refuses a sensor below the prop's bottom, or above its top by more than a hand's breadth. `top_m`: the
/// prop's height, if known.
[[nodiscard]] Result<void> check_sensor_height(std::optional<double> height_m, std::optional<double> top_m);

/// The points of --from; `parse` is one of point_files.h.
template <typename Points>
[[nodiscard]] Result<Points> read_points(const CalibrateRequest& request,
                                         Result<Points> (*parse)(std::string_view, std::string_view)) {
    TRY(const Bytes bytes, read_file(request.from));
    return parse(as_text(bytes), request.from.string());
}
/// Writes the points measured on the table to --out, if there are any; `text` is one of point_files.h.
template <typename Point>
[[nodiscard]] Result<void> write_points(const CalibrateRequest& request, const std::vector<Point>& points,
                                        std::string (*text)(std::span<const Point>)) {
    return request.out.empty() || points.empty() ? Result<void>()
                                                 : write_file(request.out, as_bytes(text(points)));
}
/// A calibration's set-up, TouchSetup or AutoSetup, filled from the request.
template <typename Setup>
[[nodiscard]] Setup set_up_for(const Described& described, const CalibrateRequest& request) {
    Setup setup;
    setup.width = described.width;
    setup.height = described.height;
    setup.top_m = described.top_m;
    setup.sensor_height_m = request.sensor_height_m;
    return setup;
}

/// 16 numbers, column by column.
[[nodiscard]] nlohmann::ordered_json matrix_json(const geometry::RigidTransform& transform);
[[nodiscard]] nlohmann::ordered_json projector_json(const geometry::Pinhole& pinhole,
                                                    const geometry::RigidTransform& table_from_projector);
/// The projector's place, one sentence.
[[nodiscard]] std::string projector_text(const geometry::RigidTransform& table_from_projector);
/// 0 if the calibration may be used; otherwise 1, and the reason goes to standard error, with its id.
[[nodiscard]] int status_of(calibration::Verdict verdict, const CalibrateRequest& request,
                            const calibration::VerdictReason& reason);

/// Reports the error, if any, and returns the exit status.
[[nodiscard]] int end_with(const Result<int>& status);

} // namespace frustumscreen::programs
