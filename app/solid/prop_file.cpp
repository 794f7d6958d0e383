#include "app/solid/prop_file.h"

#include "app/solid/make_solid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace frustumscreen::solid {

namespace {

/// Whole nanometres, without minus zero.
double in_file_mm(double length_m) {
    return std::round(length_m * 1e9) / 1e6 + 0.0;
}

/// Whether the axis x = y = 0 runs through the inside.
bool axis_runs_through(const Solid& solid) {
    const SolidBox box = box_around(solid);
    double low = box.low.z;
    double high = box.high.z;
    for (const SolidFace& face : solid.faces) {
        const double rise = face.plane.normal.z;
        if (rise > 0.0) {
            high = std::fmin(high, face.plane.offset / rise);
        } else if (rise < 0.0) {
            low = std::fmax(low, face.plane.offset / rise);
        } else if (face.plane.offset <= 0.0) {
            return false;
        }
    }
    return low < high;
}

} // namespace

Result<PropFile> parse_prop_file(std::string_view text, LengthUnit unit) {
    TRY(ObjText obj, parse_obj(text, unit));
    TRY(MadeSolid made, make_solid(std::move(obj.mesh)));
    PropFile file{.solid = std::move(made.solid), .notes = std::move(obj.notes)};
    std::move(made.notes.begin(), made.notes.end(), std::back_inserter(file.notes));
    return file;
}

std::string write_prop_file(const Solid& solid) {
    std::string text(prop_file_heading);
    for (const glm::dvec3& corner : solid.corners) {
        text += fmt::format("v {} {} {}\n", in_file_mm(corner.x), in_file_mm(corner.y), in_file_mm(corner.z));
    }
    for (const SolidFace& face : solid.faces) {
        text += fmt::format("g {}\nf", face.name);
        for (const glm::dvec3& corner : face.corners) {
            const auto found = std::find(solid.corners.begin(), solid.corners.end(), corner);
            text += fmt::format(" {}", found - solid.corners.begin() + 1);
        }
        text += '\n';
    }
    return text;
}

Result<void> check_stand(const Solid& solid) {
    const double lowest = box_around(solid).low.z;
    if (std::abs(lowest) > flatness_m) {
        return bad_input(
            "prop_file.stand",
            "its lowest corner lies {} {} z = 0, on which a prop stands; move it {} by that much",
            in_mm(lowest), lowest > 0.0 ? "above" : "below", lowest > 0.0 ? "down" : "up");
    }
    if (!axis_runs_through(solid)) {
        const SolidBox box = box_around(solid);
        return bad_input(
            "prop_file.axis",
            "the axis x = y = 0, in which an artifact stands, runs beside it; move it so that the "
            "axis runs through its middle, which is at {} now",
            in_mm(0.5 * (box.low + box.high)));
    }
    return {};
}

Result<void> check_foot(const Solid& solid) {
    if (std::none_of(solid.faces.begin(), solid.faces.end(), is_underside)) {
        return bad_input(
            "prop_file.foot",
            "none of its faces lies on z = 0, where the artifact in it stands; turn it until one "
            "does");
    }
    return {};
}

Result<PropFile> parse_standing_prop(std::string_view text, LengthUnit unit) {
    TRY(PropFile file, parse_prop_file(text, unit));
    TRY_VOID(check_stand(file.solid));
    TRY_VOID(check_foot(file.solid));
    return file;
}

std::optional<std::string> narrowness(const Solid& solid, double eyes_m) {
    const SolidWidth width = min_width(solid);
    if (width.width_m >= eyes_m) {
        return std::nullopt;
    }
    return fmt::format(
        "its least width is {}, less than the {} between a person's eyes: the two eyes together may "
        "see faces on opposite sides of it, which no projector lights at once; make it wider",
        in_mm(width.width_m), in_mm(eyes_m));
}

} // namespace frustumscreen::solid
