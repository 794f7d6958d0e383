#include "firmware_host/tracker/pose_file.h"

#include "firmware_host/tracker/text_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

namespace frustumscreen::tracker {

namespace {

constexpr std::array<std::string_view, 10> columns{"t_us", "station", "px_m", "py_m", "pz_m",
                                                   "qw",   "qx",      "qy",   "qz",   "ok"};
constexpr std::string_view header = "t_us,station,px_m,py_m,pz_m,qw,qx,qy,qz,ok";
/// About 140 years either way; nanoseconds stay far from 64-bit overflow.
constexpr std::int64_t longest_us = std::int64_t{1} << 52;
constexpr double farthest_m = 1000.0;

Error bad(MessageId id, const TextRows& rows, std::size_t column, std::string_view allowed) {
    return {ErrorKind::BadInput, id,
            rows.located(fmt::format("{} is {}; allowed {}", columns[column], quoted(rows.fields()[column]),
                                     allowed))};
}

Result<void> read_pose(const TextRows& rows, PoseSample& sample) {
    std::array<double, 7> numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const auto number = number_in(rows.fields()[k + 2]);
        if (!number || (sample.ok && !std::isfinite(*number))) {
            return tl::unexpected(bad("poses.not_finite", rows, k + 2, "is a finite number"));
        }
        if (sample.ok && k < 3 && std::abs(*number) > farthest_m) {
            return tl::unexpected(bad("poses.place", rows, k + 2, "are -1000 to 1000 metres"));
        }
        numbers[k] = *number;
    }
    if (!sample.ok) {
        return {};
    }
    double largest = 0.0;
    for (std::size_t k = 3; k < numbers.size(); ++k) {
        largest = std::fmax(largest, std::abs(numbers[k]));
    }
    if (largest < 1e-6) {
        return bad_input("poses.quaternion",
                         rows.located("the quaternion is zero; allowed is a rotation, normally of length 1"));
    }
    sample.position_m = {numbers[0], numbers[1], numbers[2]};
    sample.rotation = glm::normalize(
        glm::dquat(numbers[3] / largest, numbers[4] / largest, numbers[5] / largest, numbers[6] / largest));
    return {};
}

Result<PoseSample> read_row(const TextRows& rows) {
    if (rows.fields().size() != columns.size()) {
        return bad_input("poses.fields",
                         rows.located(fmt::format("the row has {} fields; allowed are {}: {}",
                                                  rows.fields().size(), columns.size(), header)));
    }
    PoseSample sample;
    const auto time_us = integer_in(rows.fields()[0]);
    if (!time_us || *time_us < -longest_us || *time_us > longest_us) {
        return tl::unexpected(bad("poses.time", rows, 0, "are whole microseconds up to 2^52"));
    }
    const auto station = integer_in(rows.fields()[1]);
    if (!station || *station < prop_station || *station > torch_station) {
        return tl::unexpected(bad("poses.station", rows, 1, "are 1 (prop), 2 (head) and 3 (torch)"));
    }
    const auto ok = integer_in(rows.fields()[9]);
    if (!ok || (*ok != 0 && *ok != 1)) {
        return tl::unexpected(bad("poses.ok", rows, 9, "are 0 and 1"));
    }
    sample.time = from_microseconds(*time_us);
    sample.station = static_cast<int>(*station);
    sample.ok = *ok == 1;
    TRY_VOID(read_pose(rows, sample));
    return sample;
}

} // namespace

Result<std::vector<PoseSample>> parse_poses(std::string_view text, std::string_view name, PoseOrder order) {
    TextRows rows(text, name);
    if (!rows.next() ||
        !std::equal(columns.begin(), columns.end(), rows.fields().begin(), rows.fields().end())) {
        return bad_input("poses.header", rows.located(fmt::format(
                                             "the first line is not the header; allowed is {}", header)));
    }
    std::vector<PoseSample> samples;
    std::optional<MonotonicTime> last_prop;
    while (rows.next()) {
        TRY(const PoseSample sample, read_row(rows));
        if (order == PoseOrder::PropAscends && sample.station == prop_station && last_prop &&
            sample.time <= *last_prop) {
            return bad_input("poses.times",
                             rows.located(fmt::format(
                                 "t_us is {} after {}; allowed are ascending times of station 1, each once",
                                 to_microseconds(sample.time), to_microseconds(*last_prop))));
        }
        samples.push_back(sample);
        if (sample.station == prop_station) {
            last_prop = sample.time;
        }
    }
    return samples;
}

std::string write_poses(std::span<const PoseSample> samples) {
    std::string text(header);
    text += '\n';
    for (const PoseSample& sample : samples) {
        const glm::dvec3& p = sample.position_m;
        const glm::dquat& q = sample.rotation;
        fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{}\n",
                       to_microseconds(sample.time), sample.station, p.x, p.y, p.z, q.w, q.x, q.y, q.z,
                       sample.ok ? 1 : 0);
    }
    return text;
}

} // namespace frustumscreen::tracker
