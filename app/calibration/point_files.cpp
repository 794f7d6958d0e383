#include "app/calibration/point_files.h"

#include "firmware_host/tracker/text_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace frustumscreen::calibration {

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
constexpr std::array<std::string_view, 2> eye_names{"left", "right"};
/// More rows than any calibration has; a larger file is not one of these.
constexpr std::size_t max_touch_rows = 1000;
/// Rests have a row for each of their points.
constexpr std::size_t max_points = 50000;
/// More than a person makes. eye_fit.cpp tries every pair, so the limit bounds its time.
constexpr std::size_t max_sights = 100;

/// The rows of one file, with their fields. Reading ends at the first fault, and `read` then returns the
/// fault instead of points.
class PointRows {
public:
    using Columns = std::span<const std::string_view>;
    PointRows(std::string_view text, std::string_view name, Columns columns,
              std::size_t max_rows = max_touch_rows)
        : rows_(text, name), columns_(columns), max_rows_(max_rows) {
        if (!rows_.next() ||
            !std::equal(columns.begin(), columns.end(), rows_.fields().begin(), rows_.fields().end())) {
            refuse("points.header", "the first line is not the header; allowed is {}",
                   fmt::join(columns, ","));
        }
    }

    /// False at the end, and after a fault.
    [[nodiscard]] bool next() {
        if (fault_ || !rows_.next()) {
            return false;
        }
        if (rows_.fields().size() != columns_.size()) {
            refuse("points.fields", "the row has {} fields; allowed are {}: {}", rows_.fields().size(),
                   columns_.size(), fmt::join(columns_, ","));
        } else if (count_++ >= max_rows_) {
            refuse("points.too_many_rows", "there are more than {} rows", max_rows_);
        }
        return !fault_;
    }
    [[nodiscard]] std::string_view field(std::size_t column) const { return rows_.fields()[column]; }
    double number(std::size_t column) {
        const double number = tracker::number_in(field(column)).value_or(NAN);
        if (!std::isfinite(number)) {
            refuse("points.not_a_number", "{} is {}; allowed is a finite number", columns_[column],
                   tracker::quoted(field(column)));
        }
        return number;
    }
    /// `allowed`: the allowed values in the message.
    int integer(std::size_t column, std::int64_t min, std::int64_t max, std::string_view allowed) {
        const std::int64_t number = tracker::integer_in(field(column)).value_or(min - 1);
        if (number < min || number > max) {
            refuse("points.not_an_integer", "{} is {}; allowed are {}", columns_[column],
                   tracker::quoted(field(column)), allowed);
        }
        return static_cast<int>(number);
    }
    /// One of `names`, counted from 0.
    std::size_t choice(std::size_t column, Columns names, std::string_view what = {}) {
        const auto found = std::find(names.begin(), names.end(), field(column));
        if (found == names.end()) {
            refuse("points.not_a_choice", "{} is {}; allowed are {}{}", columns_[column],
                   tracker::quoted(field(column)), fmt::join(names, ", "), what);
        }
        return static_cast<std::size_t>(found - names.begin());
    }
    glm::dvec2 pixel(std::size_t first) { return {number(first), number(first + 1)}; }
    glm::dvec3 place(std::size_t first) { return {number(first), number(first + 1), number(first + 2)}; }
    /// The tracker's report: place and quaternion. The quaternion is checked after all fields of the row are
    /// known to be numbers. A length within 0.02 of 1 counts as rounding and is normalised.
    geometry::RigidTransform report(std::size_t first, bool is_last_empty = false) {
        constexpr double max_rounded = 0.02;
        for (std::size_t column = first; column + (is_last_empty ? 1 : 0) < columns_.size(); ++column) {
            number(column);
        }
        const glm::dquat turn(number(first + 3), number(first + 4), number(first + 5), number(first + 6));
        const double length = glm::length(turn);
        if (!(std::abs(length - 1.0) <= max_rounded)) {
            refuse("points.no_rotation",
                   "qw,qx,qy,qz are not a rotation: their squares must add up to 1, and the root of their "
                   "sum is {:.3g}; are these angles in degrees?",
                   length);
        }
        return {glm::normalize(turn), place(first)};
    }
    template <typename... Figures>
    void refuse(MessageId id, fmt::format_string<Figures...> what, Figures&&... figures) {
        if (!fault_) {
            fault_ = Error{ErrorKind::BadInput, id,
                           rows_.located(fmt::format(what, std::forward<Figures>(figures)...))};
        }
    }
    /// `points`, or the first fault.
    template <typename Points> [[nodiscard]] Result<Points> read(Points points) {
        return fault_ ? Result<Points>(tl::unexpected(*std::move(fault_))) : std::move(points);
    }

private:
    tracker::TextRows rows_;
    Columns columns_;
    std::size_t max_rows_;
    std::size_t count_ = 0;
    std::optional<Error> fault_;
};

/// The text that PointRows::report reads.
std::string report_text(const geometry::RigidTransform& report) {
    const glm::dvec3& t = report.translation;
    const glm::dquat& q = report.rotation;
    return fmt::format("{},{},{},{},{},{},{}", t.x, t.y, t.z, q.w, q.x, q.y, q.z);
}

bool is_same_place(const Rest& a, const Rest& b) {
    return a.tracker_from_sensor.rotation == b.tracker_from_sensor.rotation &&
           a.tracker_from_sensor.translation == b.tracker_from_sensor.translation && a.block_m == b.block_m;
}

} // namespace

Result<Touches> parse_touches(std::string_view text, std::string_view name) {
    PointRows rows(text, name, touch_columns);
    Touches touches;
    while (rows.next()) {
        touches.push_back({rows.report(0), rows.pixel(7), rows.number(9)});
    }
    return rows.read(std::move(touches));
}

std::string touches_text(std::span<const Touch> touches) {
    std::string text = fmt::format("{}\n", fmt::join(touch_columns, ","));
    for (const Touch& touch : touches) {
        text += fmt::format("{},{},{},{}\n", report_text(touch.tracker_from_sensor), touch.pixel.x,
                            touch.pixel.y, touch.block_m);
    }
    return text;
}

Result<Rests> parse_rests(std::string_view text, std::string_view name) {
    PointRows rows(text, name, rest_columns, max_points);
    Rests rests;
    while (rows.next()) {
        Rest next;
        next.name = rows.integer(0, 0, 1000000, "0, 1, 2, ...: the number of the rest");
        const bool leans = rows.field(13).empty();
        next.tracker_from_sensor = rows.report(1, leans);
        next.points.push_back({rows.place(8), rows.pixel(11)});
        next.block_m = leans ? std::nullopt : std::optional(rows.number(13));
        const auto known = std::find_if(rests.begin(), rests.end(),
                                        [&](const Rest& rest) { return rest.name == next.name; });
        if (known == rests.end()) {
            rests.push_back(std::move(next));
        } else if (!is_same_place(*known, next)) {
            rows.refuse(
                "points.rest_moved",
                "rest {} has another place or block than in its first row; allowed is one for each rest",
                next.name);
        } else {
            known->points.push_back(next.points[0]);
        }
    }
    return rows.read(std::move(rests));
}

std::string rests_text(std::span<const Rest> rests) {
    std::string text = fmt::format("{}\n", fmt::join(rest_columns, ","));
    for (const Rest& rest : rests) {
        for (const PropPoint& point : rest.points) {
            text += fmt::format("{},{},{},{},{},{},{},{}\n", rest.name, report_text(rest.tracker_from_sensor),
                                point.prop_m.x, point.prop_m.y, point.prop_m.z, point.pixel.x, point.pixel.y,
                                rest.block_m ? fmt::format("{}", *rest.block_m) : std::string());
        }
    }
    return text;
}

Result<ReportedSights> parse_sights(std::string_view text, std::string_view name) {
    PointRows rows(text, name, sight_columns, max_sights);
    ReportedSights sights;
    while (rows.next()) {
        const bool is_left = rows.choice(0, eye_names, ": the one that was open") == 0;
        sights.push_back({.eye = is_left ? OpenEye::Left : OpenEye::Right,
                          .tracker_from_sensor = rows.report(1),
                          .pixel = rows.pixel(8),
                          .tip_m = rows.place(10)});
    }
    return rows.read(std::move(sights));
}

std::string sights_text(std::span<const ReportedSight> sights) {
    std::string text = fmt::format("{}\n", fmt::join(sight_columns, ","));
    for (const ReportedSight& sight : sights) {
        const glm::dvec3& tip = sight.tip_m;
        text += fmt::format("{},{},{},{},{},{},{}\n", eye_names[sight.eye == OpenEye::Left ? 0 : 1],
                            report_text(sight.tracker_from_sensor), sight.pixel.x, sight.pixel.y, tip.x,
                            tip.y, tip.z);
    }
    return text;
}

Result<std::vector<MeasuredCorner>> parse_corners(std::string_view text, std::string_view name) {
    PointRows rows(text, name, corner_columns);
    std::vector<MeasuredCorner> corners;
    while (rows.next()) {
        MeasuredCorner& next = corners.emplace_back();
        next.distance = rows.integer(0, 1, 1000, "1, 2, ...: which distance it was measured at");
        next.corner = static_cast<PictureCorner>(rows.choice(1, corner_names));
        next.place_m = rows.place(2);
    }
    return rows.read(std::move(corners));
}

} // namespace frustumscreen::calibration
