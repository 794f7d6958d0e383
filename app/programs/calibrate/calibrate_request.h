/// What both commands are asked: from which file, for which picture.
///
/// Threads  the main one.
#pragma once

#include "app/calibration/verdict.h"
#include "app/geometry/transform.h"
#include "firmware_host/base/result.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen {

struct CalibrateRequest {
    std::filesystem::path from;
    std::filesystem::path config;
    std::vector<int> picture; ///< width, height
    std::optional<double> sensor_height_m;
    bool keep = false;
    bool undo = false;
    // On the table:
    int touches = 9;
    std::vector<double> blocks_m{0.0, 0.04, 0.08, 0.12};
    std::filesystem::path out;
    bool headless = false;
    bool json = false;
};

/// Width and height of the picture, and the prop's height.
struct PictureSize {
    int width = 0;
    int height = 0;
    double top_m = 0.12;
};

void add_common_options(CLI::App& command, CalibrateRequest& request);
/// Throws a CLI::ParseError at what does not go.
void check_request(const CalibrateRequest& request);
[[nodiscard]] Result<PictureSize> picture_size(const CalibrateRequest& request);

/// 16 numbers, column by column.
[[nodiscard]] nlohmann::ordered_json matrix_json(const RigidTransform& transform);
/// 0 if it may be used; else 1, and the reason on standard error.
[[nodiscard]] int status_of(Verdict verdict, const CalibrateRequest& request, const std::string& reason);

} // namespace frustumscreen
