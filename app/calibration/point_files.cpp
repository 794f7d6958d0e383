#include "app/calibration/point_files.h"

#include "firmware_host/tracker/text_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace frustumscreen {

namespace {

constexpr std::array<std::string_view, 10> touch_columns{"tx_m", "ty_m", "tz_m", "qw",   "qx",
                                                         "qy",   "qz",   "u_px", "v_px", "block_m"};
constexpr std::array<std::string_view, 14> rest_columns{
    "rest", "tx_m", "ty_m", "tz_m", "qw", "qx", "qy", "qz", "x_m", "y_m", "z_m", "u_px", "v_px", "block_m"};
constexpr std::array<std::string_view, 13> sight_columns{"eye", "tx_m", "ty_m", "tz_m", "qw",  "qx", "qy",
                                                         "qz",  "u_px", "v_px", "x_m",  "y_m", "z_m"};
constexpr std::array<std::string_view, 5> corner_columns{"distance", "corner", "x_m", "y_m", "z_m"};
constexpr std::array<std::string_view, 4> corner_names{"top_left", "top_right", "bottom_right",
                                                       "bottom_left"};
/// More than any table has; a file of millions is some other file.
constexpr std::size_t most_rows = 1000;
/// Rests have a row for each of their points.
constexpr std::size_t most_points = 50000;
/// Nobody makes as many; each two are tried without.
constexpr std::size_t most_sights = 100;

Result<void> read_header(TextRows& rows, std::span<const std::string_view> columns) {
    if (!rows.next() ||
        !std::equal(columns.begin(), columns.end(), rows.fields().begin(), rows.fields().end())) {
        return bad_input(rows.located(
            fmt::format("the first line is not the header; allowed is {}", fmt::join(columns, ","))));
    }
    return {};
}

Result<void> check_row(const TextRows& rows, std::span<const std::string_view> columns, std::size_t so_far,
                       std::size_t most = most_rows) {
    if (rows.fields().size() != columns.size()) {
        return bad_input(
            rows.located(fmt::format("the row has {} fields; allowed are {}: {}", rows.fields().size(),
                                     columns.size(), fmt::join(columns, ","))));
    }
    if (so_far >= most) {
        return bad_input(rows.located(fmt::format("there are more than {} rows", most)));
    }
    return {};
}

Result<double> number_at(const TextRows& rows, std::span<const std::string_view> columns,
                         std::size_t column) {
    const std::optional<double> number = number_in(rows.fields()[column]);
    if (!number || !std::isfinite(*number)) {
        return bad_input(rows.located(fmt::format("{} is {}; allowed is a finite number", columns[column],
                                                  quoted(rows.fields()[column]))));
    }
    return *number;
}

/// The tracker's report of a row: `n` has its place and its quaternion. One whose length is nearly 1 is rounded, and becomes 1.
Result<RigidTransform> report_of(const TextRows& rows, std::span<const double, 7> n) {
    constexpr double most_rounded = 0.02;
    const glm::dquat turn(n[3], n[4], n[5], n[6]);
    const double length = glm::length(turn);
    if (!(std::abs(length - 1.0) <= most_rounded)) {
        return bad_input(rows.located(
            fmt::format("qw,qx,qy,qz are no rotation: their squares must add up to 1, and the root of that "
                        "is {:.3g}; are these angles in degrees?",
                        length)));
    }
    return RigidTransform{glm::normalize(turn), {n[0], n[1], n[2]}};
}

} // namespace

Result<Touches> parse_touches(std::string_view text, std::string_view name) {
    TextRows rows(text, name);
    TRY_VOID(read_header(rows, touch_columns));
    Touches touches;
    while (rows.next()) {
        TRY_VOID(check_row(rows, touch_columns, touches.size()));
        std::array<double, touch_columns.size()> n{};
        for (std::size_t k = 0; k < n.size(); ++k) {
            TRY(n[k], number_at(rows, touch_columns, k));
        }
        TRY(const RigidTransform report, report_of(rows, std::span(n).first<7>()));
        touches.push_back({report, {n[7], n[8]}, n[9]});
    }
    return touches;
}

std::string touches_text(std::span<const Touch> touches) {
    std::string text = fmt::format("{}\n", fmt::join(touch_columns, ","));
    for (const Touch& touch : touches) {
        const glm::dvec3& t = touch.tracker_from_sensor.translation;
        const glm::dquat& q = touch.tracker_from_sensor.rotation;
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", t.x, t.y, t.z, q.w, q.x, q.y, q.z,
                            touch.pixel.x, touch.pixel.y, touch.block_m);
    }
    return text;
}

namespace {

/// A row's rest, with its one point.
Result<Rest> rest_row(const TextRows& rows) {
    const auto name = integer_in(rows.fields()[0]);
    if (!name || *name < 0 || *name > 1000000) {
        return bad_input(rows.located(fmt::format(
            "rest is {}; allowed are 0, 1, 2, ...: the number of the rest", quoted(rows.fields()[0]))));
    }
    const bool leans = rows.fields().back().empty();
    std::array<double, rest_columns.size()> n{};
    for (std::size_t k = 1; k < n.size() - (leans ? 1 : 0); ++k) {
        TRY(n[k], number_at(rows, rest_columns, k));
    }
    TRY(const RigidTransform report, report_of(rows, std::span(n).subspan<1, 7>()));
    Rest rest;
    rest.name = static_cast<int>(*name);
    rest.tracker_from_sensor = report;
    rest.points.push_back({{n[8], n[9], n[10]}, {n[11], n[12]}});
    rest.block_m = leans ? std::nullopt : std::optional(n[13]);
    return rest;
}

bool is_same_place(const Rest& a, const Rest& b) {
    return a.tracker_from_sensor.rotation == b.tracker_from_sensor.rotation &&
           a.tracker_from_sensor.translation == b.tracker_from_sensor.translation && a.block_m == b.block_m;
}

} // namespace

Result<Rests> parse_rests(std::string_view text, std::string_view name) {
    TextRows rows(text, name);
    TRY_VOID(read_header(rows, rest_columns));
    Rests rests;
    std::size_t points = 0;
    while (rows.next()) {
        TRY_VOID(check_row(rows, rest_columns, points++, most_points));
        TRY(Rest next, rest_row(rows));
        const auto known = std::find_if(rests.begin(), rests.end(),
                                        [&](const Rest& rest) { return rest.name == next.name; });
        if (known == rests.end()) {
            rests.push_back(std::move(next));
        } else if (!is_same_place(*known, next)) {
            return bad_input(rows.located(fmt::format(
                "rest {} has another place or block than in its first row; each rest has one", next.name)));
        } else {
            known->points.push_back(next.points[0]);
        }
    }
    return rests;
}

std::string rests_text(std::span<const Rest> rests) {
    std::string text = fmt::format("{}\n", fmt::join(rest_columns, ","));
    for (const Rest& rest : rests) {
        const glm::dvec3& t = rest.tracker_from_sensor.translation;
        const glm::dquat& q = rest.tracker_from_sensor.rotation;
        for (const PropPoint& point : rest.points) {
            text +=
                fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", rest.name, t.x, t.y, t.z, q.w, q.x,
                            q.y, q.z, point.prop_m.x, point.prop_m.y, point.prop_m.z, point.pixel.x,
                            point.pixel.y, rest.block_m ? fmt::format("{}", *rest.block_m) : std::string());
        }
    }
    return text;
}

Result<ReportedSights> parse_sights(std::string_view text, std::string_view name) {
    TextRows rows(text, name);
    TRY_VOID(read_header(rows, sight_columns));
    ReportedSights sights;
    while (rows.next()) {
        TRY_VOID(check_row(rows, sight_columns, sights.size(), most_sights));
        const std::string_view eye = rows.fields()[0];
        if (eye != "left" && eye != "right") {
            return bad_input(rows.located(
                fmt::format("eye is {}; allowed are left, right: the one that was open", quoted(eye))));
        }
        std::array<double, sight_columns.size()> n{};
        for (std::size_t k = 1; k < n.size(); ++k) {
            TRY(n[k], number_at(rows, sight_columns, k));
        }
        TRY(const RigidTransform report, report_of(rows, std::span(n).subspan<1, 7>()));
        sights.push_back(
            {eye == "left" ? OpenEye::Left : OpenEye::Right, report, {n[8], n[9]}, {n[10], n[11], n[12]}});
    }
    return sights;
}

std::string sights_text(std::span<const ReportedSight> sights) {
    std::string text = fmt::format("{}\n", fmt::join(sight_columns, ","));
    for (const ReportedSight& sight : sights) {
        const glm::dvec3& t = sight.tracker_from_sensor.translation;
        const glm::dquat& q = sight.tracker_from_sensor.rotation;
        const glm::dvec3& tip = sight.tip_m;
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                            sight.eye == OpenEye::Left ? "left" : "right", t.x, t.y, t.z, q.w, q.x, q.y, q.z,
                            sight.pixel.x, sight.pixel.y, tip.x, tip.y, tip.z);
    }
    return text;
}

Result<std::vector<MeasuredCorner>> parse_corners(std::string_view text, std::string_view name) {
    TextRows rows(text, name);
    TRY_VOID(read_header(rows, corner_columns));
    std::vector<MeasuredCorner> corners;
    while (rows.next()) {
        TRY_VOID(check_row(rows, corner_columns, corners.size()));
        const auto distance = integer_in(rows.fields()[0]);
        if (!distance || *distance < 1 || *distance > 1000) {
            return bad_input(rows.located(
                fmt::format("distance is {}; allowed are 1, 2, ...: which distance it was measured at",
                            quoted(rows.fields()[0]))));
        }
        const auto corner = std::find(corner_names.begin(), corner_names.end(), rows.fields()[1]);
        if (corner == corner_names.end()) {
            return bad_input(rows.located(fmt::format(
                "corner is {}; allowed are {}", quoted(rows.fields()[1]), fmt::join(corner_names, ", "))));
        }
        MeasuredCorner measured;
        measured.distance = static_cast<int>(*distance);
        measured.corner = static_cast<PictureCorner>(corner - corner_names.begin());
        for (std::size_t k = 0; k < 3; ++k) {
            TRY(const double number, number_at(rows, corner_columns, k + 2));
            measured.place_m[static_cast<glm::length_t>(k)] = number;
        }
        corners.push_back(measured);
    }
    return corners;
}

} // namespace frustumscreen
