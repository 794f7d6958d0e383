/// The settings of projector, display, prop, table, eyes and screen, described as describe_settings.h describes the others.
///
/// Threads  pure; any.
#pragma once

#include "app/settings/display_mode.h"
#include "app/settings/looking_at.h"
#include "app/settings/range.h"
#include "app/settings/settings.h"

#include <array>
#include <string>
#include <string_view>

namespace frustumscreen::settings {

inline constexpr Range focal_length{50.0, 200000.0, "pixels"};
inline constexpr Range near_the_table{-10.0, 10.0, "metres"};

/// Each list is in the order of its enumeration.
inline constexpr std::array<std::string_view, 2> display_names{"kms", "surfaceless"};
inline constexpr std::array<std::string_view, 5> stereo_names{"off", "side_by_side", "top_bottom",
                                                              "frame_sequential", "anaglyph"};
inline constexpr std::array<std::string_view, 6> output_stereo_names{
    "as_eye", "off", "side_by_side", "top_bottom", "frame_sequential", "anaglyph"};
inline constexpr std::array<std::string_view, 3> prop_names{"frustum", "cube", "solid"};
inline constexpr std::array<std::string_view, 2> unit_names{"mm", "m"};
inline constexpr std::array<std::string_view, 2> prop_zone_names{"table", "hand"};

void distortion_settings(auto& fields, auto& lens) {
    constexpr Range distortion{-0.5, 0.5, ""};
    fields.number("k1", lens.k1, distortion,
                  "radial distortion x (1 + k1 r^2 + k2 r^4), r from the optical axis in focal lengths, as "
                  "OpenCV has it; 0: none");
    fields.number("k2", lens.k2, distortion, "coefficient of r^4 in the same formula");
}

template <typename Fields> void lens_settings(Fields& fields, auto& pinhole) {
    const geometry::Pinhole usual = ProjectorSettings().pinhole;
    fields.integer("width", pinhole.width, 64, 8192, "columns of the picture; the projector's own");
    fields.integer("height", pinhole.height, 64, 8192, "rows of the picture; the projector's own");
    double throw_ratio = usual.fx / usual.width;
    fields.input("throw_ratio", throw_ratio, {0.1, 20.0, "(distance over the picture's width)"},
                 "how wide the picture is; set this, or fx and fy");
    if constexpr (Fields::reads) {
        fields.one_way("throw_ratio", {"fx", "fy"}, "fx or fy");
        pinhole.fx = throw_ratio * pinhole.width;
    }
    fields.number("fx", pinhole.fx, focal_length, "focal length along the rows, in place of throw_ratio");
    if constexpr (Fields::reads) {
        pinhole.fy = pinhole.fx;
        pinhole.cx = 0.5 * pinhole.width;
        pinhole.cy = 0.5 * pinhole.height;
    }
    fields.number("fy", pinhole.fy, focal_length, "focal length along the columns; left out: fx");
    fields.number("cx", pinhole.cx, {-1.0 * pinhole.width, 2.0 * pinhole.width, "pixels"},
                  "column of the optical axis, which a lens shift moves; left out: the picture's middle");
    fields.number("cy", pinhole.cy, {-1.0 * pinhole.height, 2.0 * pinhole.height, "pixels"},
                  "row of the optical axis; left out: the picture's middle");
    distortion_settings(fields, pinhole.lens);
}

template <typename Fields> void projector_pose_settings(Fields& fields, auto& pose) {
    glm::dvec3 position = pose.translation;
    double roll_deg = 0.0;
    fields.input("position_m", position, near_the_table, "where the lens is");
    glm::dvec3 aim(position.x, position.y, 0.0);
    fields.input("aim_m", aim, near_the_table,
                 "the point that the optical axis meets; left out: straight below position_m");
    fields.input(
        "roll_deg", roll_deg, {-360.0, 360.0, "degrees"},
        "0: the top of the picture lies at the table's far side; clockwise as the projector sees it");
    if constexpr (Fields::reads) {
        for (const char* key : {"position_m", "aim_m", "roll_deg"}) {
            fields.one_way(key, {"table_from_projector"}, "table_from_projector");
        }
    }
    fields.rigid("table_from_projector", pose, near_the_table,
                 "a measured pose, used instead of the three above: 16 numbers, column by column");
    if constexpr (Fields::reads) {
        if (!fields.has("table_from_projector")) {
            const auto looking = looking_at(position, aim, roll_deg);
            pose = looking.value_or(pose);
            fields.require(
                "settings.aim", looking.has_value(), "aim_m",
                "gives no direction that looks down from position_m; allowed is a point on the table");
        }
    }
}

void projector_settings(auto& fields, auto& projector) {
    lens_settings(fields, projector.pinhole);
    projector_pose_settings(fields, projector.table_from_projector);
    fields.number(
        "refresh_hz", projector.refresh_hz, {10.0, 480.0, "hertz"},
        "pictures a second; with \"frame_sequential\" both eyes' are counted: half of them for each");
    fields.choice("stereo", projector.stereo, output_stereo_names,
                  "layout of the two eyes' pictures for this projector; \"as_eye\": that of eye.stereo");
    fields.number(
        "aperture_mm", projector.aperture_mm, {0.1, 200.0, "millimetres"},
        "diameter of the lens's opening (focal length divided by the f-number): how fast the picture "
        "blurs away from the distance in focus");
}

void display_settings(auto& fields, auto& display) {
    fields.choice("kind", display.kind, display_names,
                  "a projector on this machine's graphics card, or no screen");
    fields.text("card", display.card,
                "kms: \"card1\" or a path; \"any\": the one that has a projector, also later");
    fields.text("connector", display.connector,
                "kms: as in /sys/class/drm, \"HDMI-A-1\"; \"any\": whichever has a projector");
    fields.parsed("mode", display.mode, text_of, parse_display_mode,
                  "\"preferred\", \"1280x800\" and \"1280x800@60\", of 64 to 8192 pixels and 10 to 480 hertz",
                  "kms; \"preferred\": the picture's own size at refresh_hz, if the projector has that, else "
                  "the projector's own choice. In another mode the picture is as large as it fits");
    fields.flag("force", display.force,
                "kms: sets the mode even if a bad EDID does not list it; with a named connector also while "
                "it reports that nothing is connected");
}

void render_settings(auto& fields, auto& render) {
    fields.number("error_tolerance_px", render.error_tolerance_px, {0.01, 20.0, "pixels"},
                  "allowed picture error, in projector pixels where they are smallest on the prop: the "
                  "cheapest level within it is drawn, if it keeps refresh_hz");
    fields.integer("highlight_code", render.highlight_code, 0, 255,
                   "sRGB code below which 98 % of an artifact's surface stays where the prop gets the least "
                   "light; 0: the pack's own colours");
}

/// The size of a frustum or a cube.
template <typename Fields> void prop_size_settings(Fields& fields, auto& prop) {
    const bool cube = prop.kind == PropKind::Cube;
    if constexpr (Fields::reads) {
        prop.base_m = cube ? cube_settings().base_m : prop.base_m;
    }
    fields.number("base_m", prop.base_m, {0.02, 2.0, "metres"},
                  "side of the bottom square; left out: 0.16 for a cube");
    const Range edge{prop.base_m, prop.base_m, "metres: a cube's edges are prop.base_m"};
    fields.number("top_m", prop.top_m, cube ? edge : Range{0.005, 2.0, "metres"},
                  "side of the top square; a cube's is base_m");
    fields.number("height_m", prop.height_m, cube ? edge : Range{0.01, 2.0, "metres"},
                  "from the bottom to the top; a cube's is base_m");
    if constexpr (Fields::reads) {
        prop.top_m = cube ? prop.base_m : prop.top_m;
        prop.height_m = cube ? prop.base_m : prop.height_m;
    }
}

/// The shape of a solid. read_prop.h reads it afterwards.
template <typename Fields> void prop_file_settings(Fields& fields, auto& prop) {
    fields.path("file", prop.file,
                "solid: its shape as a plain OBJ; `frustumscreen-bake --prop-file` makes one");
    fields.long_text(
        "shape", prop.shape_text,
        "solid: instead of `file`, the text of such an OBJ, so that the settings need no other file");
    fields.choice("unit", prop.unit, unit_names, "solid: unit of the numbers in the OBJ");
    fields.texts("lit_faces", prop.lit_faces, geometry::max_faces,
                 "solid: names of the faces that get a picture; left out: all, but on the table not the one "
                 "on which it stands");
    if constexpr (Fields::reads) {
        fields.one_way("shape", {"file"}, "prop.file");
    }
}

/// Refuses the keys that are not of this kind of prop.
void refuse_other_prop_keys(auto& fields, bool solid) {
    for (const std::string_view key : {"base_m", "top_m", "height_m"}) {
        fields.require(
            "settings.prop_size", !solid || !fields.has(key), key,
            "is the size of a frustum or a cube; a solid is as large as its file says, so leave this "
            "line out");
    }
    for (const std::string_view key : {"file", "shape", "unit", "lit_faces"}) {
        fields.require("settings.prop_file_kind", solid || !fields.has(key), key,
                       "is of a solid; set prop.kind to \"solid\", or leave this line out");
    }
    fields.require("settings.prop_without_file", !solid || fields.has("file") || fields.has("shape"), "kind",
                   "is \"solid\"; it needs prop.file, the shape as a plain OBJ, which `frustumscreen-bake "
                   "--prop-file` makes");
}

template <typename Fields> void prop_settings(Fields& fields, auto& prop) {
    fields.choice("kind", prop.kind, prop_names,
                  "a pyramidal frustum, a cube, or any convex shape with 4 to 16 flat faces");
    prop_size_settings(fields, prop);
    prop_file_settings(fields, prop);
    if constexpr (Fields::reads) {
        refuse_other_prop_keys(fields, prop.kind == PropKind::Solid);
        prop.zone = prop.kind == PropKind::Frustum ? PropZone::Table : PropZone::Hand;
    }
    fields.choice(
        "zone", prop.zone, prop_zone_names,
        "table: upright on the table, slid and turned; hand: lifted and turned in any way; left out: "
        "\"hand\" for a cube and a solid");
}

void table_settings(auto& fields, auto& table) {
    fields.number("width_m", table.width_m, {0.05, 10.0, "metres"}, "along X");
    fields.number("depth_m", table.depth_m, {0.05, 10.0, "metres"}, "along Y");
}

void eye_settings(auto& fields, auto& eye) {
    fields.vector("default_m", eye.default_m, near_the_table,
                  "where a visitor's eyes are while no head is tracked");
    fields.number("lowest_elevation_deg", eye.lowest_elevation_deg, {1.0, 89.0, "degrees"},
                  "lowest angle of visitors' eyes above the table, seen from the prop");
    fields.number("nearest_m", eye.nearest_m, {0.05, 10.0, "metres"},
                  "smallest distance of visitors' eyes to the prop");
    fields.number("farthest_m", eye.farthest_m, {0.1, 20.0, "metres"},
                  "largest distance of visitors' eyes from the prop");
    fields.flag("tracked", eye.tracked,
                "false: a fixed viewer at default_m, even if a tracker reports a head");
    fields.choice(
        "stereo", eye.stereo, stereo_names,
        "a picture for each eye, with glasses that suit the projector, and how it receives the two; "
        "\"off\": one picture, without glasses");
    fields.number("interocular_mm", eye.interocular_mm, {0.0, 200.0, "millimetres"},
                  "stereo: distance between the pupils; 63 suits most adults, 55 children");
}

void screen_settings(auto& fields, auto& screen) {
    fields.path("room", screen.room,
                "what stands in the room behind the screen (docs/room.md); left out: no screen, and the keys "
                "below are ignored");
    fields.points("corners_m", screen.corners_m, near_the_table,
                  "corners of the lit area, as people before it see it: top left, top right, bottom right, "
                  "bottom left");
    fields.integer("width", screen.width, 64, 8192, "columns of the picture; the screen's own");
    fields.integer("height", screen.height, 64, 8192, "rows of the picture; the screen's own");
    fields.number("refresh_hz", screen.refresh_hz, {10.0, 480.0, "hertz"}, "pictures a second");
    fields.text("card", screen.card, "kms: \"card1\" or a path; \"any\": the card of the connector");
    fields.text("connector", screen.connector,
                "kms: as in /sys/class/drm, \"DP-1\"; it differs from display.connector");
    fields.choice("stereo", screen.stereo, output_stereo_names,
                  "layout of the two eyes' pictures for this screen; \"as_eye\": that of eye.stereo");
}

} // namespace frustumscreen::settings
