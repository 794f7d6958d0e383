#include "firmware_host/tracker/convert_recording.h"

#include "firmware_host/tracker/text_rows.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>

namespace frustumscreen::tracker {

namespace {

constexpr std::array<std::string_view, 8> columns{"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr double farthest_m = 1000.0;
/// A longer recording is a mistake; about 140 years.
constexpr double longest_s = 4.5e9;

using Row = std::array<double, 8>;

Result<Row> read_row(const TextRows& rows) {
    if (rows.fields().size() != columns.size()) {
        return bad_input("convert.fields",
                         rows.located(fmt::format("the row has {} fields; allowed are 8: t x y z qx qy qz qw",
                                                  rows.fields().size())));
    }
    Row row{};
    for (std::size_t k = 0; k < row.size(); ++k) {
        const auto number = number_in(rows.fields()[k]);
        const double limit = k == 0 ? longest_s : farthest_m;
        if (!number || !(std::abs(*number) <= limit)) {
            return bad_input("convert.number",
                             rows.located(fmt::format("{} is {}; allowed are numbers from {} to {}",
                                                      columns[k], quoted(rows.fields()[k]), -limit, limit)));
        }
        row[k] = *number;
    }
    if (std::hypot(std::hypot(row[4], row[5]), std::hypot(row[6], row[7])) < 1e-6) {
        return bad_input("convert.quaternion",
                         rows.located("the quaternion is zero; allowed is a rotation, normally of length 1"));
    }
    return row;
}

bool names_columns(const TextRows& rows) {
    const std::string_view first = rows.fields().front();
    return rows.fields().size() == columns.size() && !first.empty() &&
           std::isalpha(static_cast<unsigned char>(first.front())) != 0 && !number_in(first);
}

/// The part of `rotation` that turns about Z (swing-twist), as a rotation about Z.
glm::dquat turn_about_z(const glm::dquat& rotation) {
    const double length = std::hypot(rotation.w, rotation.z);
    // An upside-down rotation has no such part.
    return length > 1e-9 ? glm::dquat(rotation.w / length, 0.0, 0.0, rotation.z / length)
                         : glm::dquat(1, 0, 0, 0);
}

/// q or -q, whichever continues `before`.
glm::dquat continued(const glm::dquat& q, const glm::dquat& before) {
    return glm::dot(q, before) < 0.0 ? -q : q;
}

double lay_flat(std::vector<PoseSample>& samples, const glm::dvec2& half_extent) {
    glm::dvec2 low(samples.front().position_m);
    glm::dvec2 high = low;
    for (const PoseSample& sample : samples) {
        low = glm::min(low, glm::dvec2(sample.position_m));
        high = glm::max(high, glm::dvec2(sample.position_m));
    }
    const glm::dvec2 half = (high - low) * 0.5;
    double scale = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        if (half[axis] > half_extent[axis]) {
            scale = std::fmin(scale, half_extent[axis] / half[axis]);
        }
    }
    const glm::dquat first = samples.front().rotation;
    glm::dquat before(1, 0, 0, 0);
    for (PoseSample& sample : samples) {
        sample.position_m = glm::dvec3((glm::dvec2(sample.position_m) - (low + high) * 0.5) * scale, 0.0);
        before = continued(turn_about_z(sample.rotation * glm::conjugate(first)), before);
        sample.rotation = before;
    }
    return scale;
}

} // namespace

Result<ConvertedRecording> convert_recording(std::string_view text, std::string_view name,
                                             const RecordingOptions& options) {
    ConvertedRecording result;
    TextRows rows(text, name);
    std::optional<double> start_s;
    bool turned = false; // the sign of the previous row was flipped
    for (bool first = true; rows.next(); first = false) {
        if (first && names_columns(rows)) {
            continue;
        }
        TRY(const Row row, read_row(rows));
        const auto& [t, x, y, z, qx, qy, qz, qw] = row;
        start_s = start_s.value_or(t);
        if (t - *start_s > longest_s) {
            return bad_input("convert.too_long", rows.located(fmt::format(
                                                     "t is {}, more than {} seconds after the first row's {}",
                                                     t, longest_s, *start_s)));
        }
        PoseSample sample;
        sample.time = from_microseconds(std::llround((t - *start_s) * 1e6));
        sample.station = options.station;
        sample.position_m = {x, y, z};
        sample.rotation = glm::normalize(glm::dquat(qw, qx, qy, qz));
        if (!result.samples.empty()) {
            if (sample.time <= result.samples.back().time) {
                ++result.dropped_rows;
                continue;
            }
            const bool was_turned = turned;
            turned = glm::dot(sample.rotation, result.samples.back().rotation) < 0.0;
            result.sign_flips += turned != was_turned ? 1 : 0;
            sample.rotation = turned ? -sample.rotation : sample.rotation;
        }
        result.samples.push_back(sample);
    }
    if (result.samples.empty()) {
        return bad_input("convert.no_pose", "{}: it holds no pose; allowed are rows of t x y z qx qy qz qw",
                         name);
    }
    if (options.flat) {
        result.scale = lay_flat(result.samples, options.half_extent_m);
    }
    return result;
}

} // namespace frustumscreen::tracker
