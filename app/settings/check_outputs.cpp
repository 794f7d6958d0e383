#include "app/settings/check_outputs.h"

#include "app/geometry/table_plane.h"
#include "app/settings/lit_zone.h"
#include "firmware_host/base/pixel_rectangle.h"
#include "firmware_host/base/printable.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustumscreen::settings {

namespace {

/// Gap that must stay between the prop's top and the projector's lens.
constexpr double min_clearance_m = 0.1;
/// The projector looks down: the sine of its axis below the horizon is at least this (30 degrees).
constexpr double min_downward = 0.5;

bool inside(const geometry::PropShape& prop, const glm::dvec3& p) {
    return std::all_of(prop.bounds.begin(), prop.bounds.end(),
                       [&](const geometry::Plane& bound) { return bound.distance(p) <= 0.0; });
}

void check_prop(const Settings& settings, Fitness& fitness) {
    const PropSettings& prop = settings.prop;
    fitness.require("settings.prop_top", prop.kind != PropKind::Frustum || prop.top_m < prop.base_m,
                    "prop.top_m",
                    fmt::format("is {}; a frustum's top must be smaller than prop.base_m, {} metres",
                                prop.top_m, prop.base_m));
    const double shorter = std::fmin(settings.table.width_m, settings.table.depth_m);
    fitness.require("settings.prop_base", prop.base_m <= shorter, "prop.base_m",
                    fmt::format("is {}; the prop must stand on the table, allowed are at most {} metres",
                                prop.base_m, shorter));
}

/// The key to change in order to move the picture.
std::string_view position_key(const Fitness& fitness) {
    return fitness.names("projector.table_from_projector") ? "projector.table_from_projector"
                                                           : "projector.position_m";
}

/// "x 0.80 to 1.60 m, y -0.25 to 0.25 m"; nothing if a part of the picture never meets the table's plane.
std::optional<std::string> place_of_picture(const ProjectorSettings& projector) {
    const geometry::Pinhole& p = projector.pinhole;
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (const glm::dvec2& corner :
         {glm::dvec2(0, 0), glm::dvec2(p.width, 0), glm::dvec2(p.width, p.height), glm::dvec2(0, p.height)}) {
        const std::optional<glm::dvec2> lit =
            geometry::lights_table(p, projector.table_from_projector, corner);
        if (!lit) {
            return std::nullopt;
        }
        low = glm::min(low, *lit);
        high = glm::max(high, *lit);
    }
    return fmt::format("x {:.2f} to {:.2f} m, y {:.2f} to {:.2f} m", low.x, high.x, low.y, high.y);
}

/// There must be a place on the table at which the prop's bottom lies in the picture.
void check_picture(const Settings& settings, Fitness& fitness) {
    const TableSettings& table = settings.table;
    const std::optional<std::string> place = place_of_picture(settings.projector);
    const std::string there = fmt::format(
        "on the table's plane the picture lies at {}, the table at x {:.2f} to {:.2f} m, y {:.2f} to "
        "{:.2f} m; move or aim the projector, or take out a lens shift",
        place.value_or("no bounded place"), -0.5 * table.width_m, 0.5 * table.width_m, -0.5 * table.depth_m,
        0.5 * table.depth_m);
    fitness.require("settings.picture_beside_table", !picture_on_table(settings, 0.0).empty(),
                    position_key(fitness), "throws its picture beside the table: " + there);
    fitness.require(
        "settings.prop_outside_picture", !picture_on_table(settings, 0.0, 0.5 * settings.prop.base_m).empty(),
        position_key(fitness),
        fmt::format("throws its picture so that the prop, {} m wide, cannot stand in it anywhere: {}",
                    settings.prop.base_m, there));
}

void check_projector(const Settings& settings, Fitness& fitness) {
    check_lens(settings.projector.pinhole, "projector.k1", fitness);
    const geometry::RigidTransform& pose = settings.projector.table_from_projector;
    const std::string_view position = position_key(fitness);
    const double min_height = settings.prop.height_m + min_clearance_m;
    fitness.require(
        "settings.projector_too_low", pose.translation.z >= min_height, position,
        fmt::format("is {:g} metres above the table; allowed are at least {:g}, the prop's height and {:g}",
                    pose.translation.z, min_height, min_clearance_m));
    const double downward = -pose.direction({0, 0, 1}).z;
    fitness.require(
        "settings.projector_looks_up", downward >= min_downward, position,
        fmt::format("looks {:.1f} degrees below the horizon; allowed are 30 to 90, down at the table",
                    glm::degrees(std::asin(std::clamp(downward, -1.0, 1.0)))));
    check_picture(settings, fitness);
}

/// The two eyes' pictures share the output's columns, or its rows, in halves. `output`: "projector" or "screen".
void check_stereo(Stereo stereo, OutputStereo asked, std::string_view output, PixelSize picture,
                  Fitness& fitness) {
    const std::string key = asked == OutputStereo::AsEye ? "eye.stereo" : fmt::format("{}.stereo", output);
    fitness.require("settings.stereo_odd_width", stereo != Stereo::SideBySide || picture.width % 2 == 0, key,
                    fmt::format("is \"side_by_side\", and {}.width is {}; each eye gets half of the columns: "
                                "take an even width, or another layout",
                                output, picture.width));
    fitness.require("settings.stereo_odd_height", stereo != Stereo::TopBottom || picture.height % 2 == 0, key,
                    fmt::format("is \"top_bottom\", and {}.height is {}; each eye gets half of the rows: "
                                "take an even height, or another layout",
                                output, picture.height));
}

void check_screen(const Settings& settings, Fitness& fitness) {
    const ScreenSettings& screen = settings.screen;
    if (!screen.exists()) {
        return;
    }
    constexpr double min_m = 0.05;
    constexpr double max_skew = 2e-3; // of the longer side
    const auto& [top_left, top_right, bottom_right, bottom_left] = screen.corners_m;
    const glm::dvec3 across = top_right - top_left;
    const glm::dvec3 down = bottom_left - top_left;
    const double shorter = std::fmin(glm::length(across), glm::length(down));
    const double longer = std::fmax(glm::length(across), glm::length(down));
    fitness.require("settings.screen_size", shorter >= min_m, "screen.corners_m",
                    fmt::format("has sides of {:.3f} and {:.3f} metres; allowed are at least {} each",
                                glm::length(across), glm::length(down), min_m));
    const double off = std::fmax(glm::distance(bottom_right, top_right + down),
                                 std::fabs(glm::dot(across, down)) / std::fmax(shorter, min_m));
    fitness.require(
        "settings.screen_no_rectangle", off <= max_skew * longer, "screen.corners_m",
        fmt::format("is not a rectangle: it is {:.1f} mm off; allowed are at most {:.1f} mm. The order "
                    "is top left, top right, bottom right, bottom left",
                    1e3 * off, 1e3 * max_skew * longer));
    const glm::dvec3 out = glm::cross(down, across); // of the screen, towards the people before it
    fitness.require("settings.screen_looks_away", glm::dot(out, settings.eye.default_m - top_left) > 0.0,
                    "screen.corners_m",
                    "looks away from eye.default_m, so people there see its back; allowed are top left, top "
                    "right, bottom right, bottom left, as they see the screen");
    check_stereo(screen_stereo_of(settings), screen.stereo, "screen", {screen.width, screen.height}, fitness);
    fitness.require(
        "settings.screen_same_connector",
        settings.display.connector != screen.connector || screen.connector == "any" ||
            (settings.display.card != screen.card && screen.card != "any" && settings.display.card != "any"),
        "screen.connector",
        fmt::format("is \"{}\", and display.connector is the same; name two connectors",
                    printable(screen.connector, 60)));
}

void check_eye(const Settings& settings, Fitness& fitness) {
    const glm::dvec3& eye = settings.eye.default_m;
    fitness.require("settings.eye_below_table", eye.z > 0.0, "eye.default_m",
                    fmt::format("is {} metres above the table; allowed are heights above 0", eye.z));
    fitness.require("settings.eye_inside_prop", !inside(make_prop(settings.prop), eye), "eye.default_m",
                    "lies inside the prop; move it to where a visitor's eyes are");
    fitness.require("settings.eye_distances", settings.eye.nearest_m < settings.eye.farthest_m,
                    "eye.nearest_m",
                    fmt::format("is {}; allowed are distances below eye.farthest_m, {} metres",
                                settings.eye.nearest_m, settings.eye.farthest_m));
}

} // namespace

void check_lens(const geometry::Pinhole& pinhole, std::string_view key, Fitness& fitness) {
    constexpr double margin = 1.1;
    const double corner = pinhole.ideal().farthest_r2();
    const double fold = pinhole.lens.fold_r2();
    const bool folds = !pinhole.lens.undistort({std::sqrt(margin * corner), 0.0}).has_value();
    fitness.require("settings.lens_folds", !folds, key,
                    fmt::format("and k2 fold the picture at {:.2f} focal lengths from its optical axis, and "
                                "its corners lie at {:.2f}; allowed are values that do not fold the picture",
                                std::sqrt(fold), std::sqrt(corner)));
}

void check_outputs(const Settings& settings, Fitness& fitness) {
    check_prop(settings, fitness);
    check_projector(settings, fitness);
    check_eye(settings, fitness);
    const geometry::Pinhole& picture = settings.projector.pinhole;
    check_stereo(stereo_of(settings), settings.projector.stereo, "projector", {picture.width, picture.height},
                 fitness);
    check_screen(settings, fitness);
}

} // namespace frustumscreen::settings
