#include "app/settings/read_prop.h"

#include "app/solid/prop_file.h"
#include "app/solid/shape_of.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace frustumscreen::settings {

namespace {

Result<solid::PropFile> read_shape(const PropSettings& prop) {
    if (prop.file.empty()) {
        return solid::parse_standing_prop(prop.shape_text, prop.unit);
    }
    TRY(const Bytes bytes, read_file(prop.file, solid::max_obj_bytes));
    return at(printable(prop.file.string(), 4096), solid::parse_standing_prop(as_text(bytes), prop.unit));
}

/// `shape` with pictures on the faces called `lit` alone; the others only bound it.
geometry::PropShape lit_alone(geometry::PropShape shape, const std::vector<std::string>& lit) {
    const auto is_dark = [&](const geometry::PropFace& face) {
        return std::find(lit.begin(), lit.end(), face.name) == lit.end();
    };
    const auto dark = std::stable_partition(shape.faces.begin(), shape.faces.end(), std::not_fn(is_dark));
    // Bounds begin with the faces' planes, in the faces' order.
    std::transform(shape.faces.begin(), shape.faces.end(), shape.bounds.begin(),
                   [](const geometry::PropFace& face) { return face.plane; });
    shape.faces.erase(dark, shape.faces.end());
    return shape;
}

/// The first of `lit_faces` that the shape does not have.
std::optional<std::string> unknown_face(const geometry::PropShape& shape, const PropSettings& prop) {
    for (const std::string& lit : prop.lit_faces) {
        if (std::none_of(shape.faces.begin(), shape.faces.end(),
                         [&](const geometry::PropFace& face) { return face.name == lit; })) {
            return lit;
        }
    }
    return std::nullopt;
}

std::vector<std::string> names_of(const geometry::PropShape& shape) {
    std::vector<std::string> names;
    for (const geometry::PropFace& face : shape.faces) {
        names.push_back(face.name);
    }
    return names;
}

/// Side of the upright square column around x = y = 0 that holds the solid.
double column_side_m(const solid::Solid& solid) {
    double half = 0.0;
    for (const glm::dvec3& corner : solid.corners) {
        half = std::fmax(half, std::fmax(std::abs(corner.x), std::abs(corner.y)));
    }
    return 2.0 * half;
}

void take_solid(ReadState& state, PropSettings& prop, solid::PropFile file) {
    const bool all_named = !prop.lit_faces.empty();
    geometry::PropShape shape =
        solid::shape_of(file.solid, prop.zone == PropZone::Table && !all_named ? solid::Underside::Dark
                                                                               : solid::Underside::Lit);
    if (const std::optional<std::string> unknown = unknown_face(shape, prop)) {
        state.refuse("settings.prop_face", state.line_of("prop.lit_faces"),
                     fmt::format("prop.lit_faces names \"{}\"; the shape has the faces {}",
                                 printable(*unknown, 40), fmt::join(names_of(shape), ", ")));
        return;
    }
    prop.notes = std::move(file.notes);
    if (const std::optional<std::string> narrow = solid::narrowness(file.solid)) {
        prop.notes.push_back(*narrow);
    }
    prop.base_m = prop.top_m = column_side_m(file.solid);
    prop.height_m = solid::box_around(file.solid).high.z;
    prop.shape = std::make_shared<const geometry::PropShape>(
        all_named ? lit_alone(std::move(shape), prop.lit_faces) : std::move(shape));
}

} // namespace

void read_prop(ReadState& state, PropSettings& prop) {
    if (state.error || prop.kind != PropKind::Solid) {
        return;
    }
    Result<solid::PropFile> file = read_shape(prop);
    if (file) {
        take_solid(state, prop, *std::move(file));
        return;
    }
    const std::string_view key = prop.file.empty() ? "prop.shape" : "prop.file";
    state.refuse(file.error().id, state.line_of(key), fmt::format("{}: {}", key, file.error().message));
}

} // namespace frustumscreen::settings
