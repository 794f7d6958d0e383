#include "app/programs/frustumscreen/render/pin_option.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace frustumscreen::programs {

namespace {

constexpr double max_m = 10.0;
constexpr double max_deg = 360.0;

/// Two or three numbers, separated by commas.
std::optional<scene::WindowPlace> read_pin(const std::string& text) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    while (true) {
        double number = 0.0;
        const std::from_chars_result read = std::from_chars(at, end, number);
        const double most = numbers.size() < 2 ? max_m : max_deg;
        if (read.ec != std::errc{} || !(std::abs(number) <= most)) {
            return std::nullopt;
        }
        numbers.push_back(number);
        if (read.ptr == end) {
            break;
        }
        if (*read.ptr != ',' || numbers.size() == 3) {
            return std::nullopt;
        }
        at = read.ptr + 1;
    }
    if (numbers.size() < 2) {
        return std::nullopt;
    }
    scene::WindowPlace place{.middle_m = {numbers[0], numbers[1]}};
    place.yaw_rad = numbers.size() == 3 ? numbers[2] * std::numbers::pi / 180.0 : 0.0;
    return place;
}

} // namespace

ArgumentCheck is_pin() {
    const auto check = [](const std::string& text) {
        return read_pin(text)
                   ? std::string()
                   : fmt::format("'{}' is not a place on the table; allowed is X,Y or X,Y,YAW_DEG, in metres "
                                 "from the table's middle, such as 0.2,-0.1 or 0.2,-0.1,45",
                                 text);
    };
    return {check, ""};
}

Result<std::vector<scene::WindowPlace>> places_of(const std::vector<std::string>& pins,
                                                  const settings::WindowSettings& settings) {
    if (pins.size() > settings::max_windows) {
        return bad_input("render.pins", "--pin: {} windows; allowed are up to {}; leave some out",
                         pins.size(), settings::max_windows);
    }
    std::vector<scene::WindowPlace> places;
    for (const std::string& pin : pins) {
        scene::WindowPlace place = read_pin(pin).value();
        place.width_m = settings.width_m;
        place.depth_m = settings.depth_m;
        places.push_back(place);
    }
    return places;
}

std::vector<glm::dvec3> corners_of(const std::vector<scene::WindowPlace>& places) {
    std::vector<glm::dvec3> corners;
    for (const scene::WindowPlace& place : places) {
        const geometry::RigidTransform table_from_window = scene::table_from_window(place);
        for (const glm::dvec3& corner : scene::window_surface(place.width_m, place.depth_m).corners) {
            corners.push_back(table_from_window.point(corner));
        }
    }
    return corners;
}

} // namespace frustumscreen::programs
