// Files of a calibration: touches, rests, sightings, corners. Accepted values are finite, and written again
// they read equal.
#include "app/calibration/point_files.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

constexpr const char* name = "points.csv";

template <typename Value> bool is_taken(const Result<Value>& points) {
    if (!points) {
        fuzz::require_one_line(points.error().message);
    }
    return points.has_value();
}

void require_sound(const geometry::RigidTransform& reported, const glm::dvec2& pixel) {
    fuzz::require(fuzz::is_finite(reported.translation), "a place is finite");
    fuzz::require(fuzz::is_unit(reported.rotation), "a rotation has length 1");
    fuzz::require(std::isfinite(pixel.x) && std::isfinite(pixel.y), "a pixel is finite");
}

void check_touches(std::string_view text) {
    const Result<calibration::Touches> touches = calibration::parse_touches(text, name);
    if (!is_taken(touches)) {
        return;
    }
    for (const calibration::Touch& touch : *touches) {
        require_sound(touch.tracker_from_sensor, touch.pixel);
        fuzz::require(std::isfinite(touch.block_m), "a height is finite");
    }
    const Result<calibration::Touches> again =
        calibration::parse_touches(calibration::touches_text(*touches), name);
    fuzz::require(again && again->size() == touches->size(), "what was written is read",
                  again ? "" : again.error().message);
}

void check_rests(std::string_view text) {
    const Result<calibration::Rests> rests = calibration::parse_rests(text, name);
    if (!is_taken(rests)) {
        return;
    }
    for (const calibration::Rest& rest : *rests) {
        fuzz::require(!rest.points.empty(), "a rest has points");
        for (const auto& point : rest.points) {
            require_sound(rest.tracker_from_sensor, point.pixel);
        }
    }
    const Result<calibration::Rests> again = calibration::parse_rests(calibration::rests_text(*rests), name);
    fuzz::require(again && again->size() == rests->size(), "what was written is read",
                  again ? "" : again.error().message);
}

void check_sights(std::string_view text) {
    const Result<calibration::ReportedSights> sights = calibration::parse_sights(text, name);
    if (!is_taken(sights)) {
        return;
    }
    for (const calibration::ReportedSight& sight : *sights) {
        require_sound(sight.tracker_from_sensor, sight.pixel);
        fuzz::require(fuzz::is_finite(sight.tip_m), "a tip is finite");
    }
    const Result<calibration::ReportedSights> again =
        calibration::parse_sights(calibration::sights_text(*sights), name);
    fuzz::require(again && again->size() == sights->size(), "what was written is read",
                  again ? "" : again.error().message);
}

void check_corners(std::string_view text) {
    const Result<std::vector<calibration::MeasuredCorner>> corners = calibration::parse_corners(text, name);
    if (is_taken(corners)) {
        for (const calibration::MeasuredCorner& corner : *corners) {
            fuzz::require(fuzz::is_finite(corner.place_m), "a corner is finite");
        }
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    check_touches(text);
    check_rests(text);
    check_sights(text);
    check_corners(text);
    return 0;
}
