#include "app/settings/check_settings.h"
#include "app/settings/command.h"
#include "app/settings/settings.h"
#include "app/settings/table_reader.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen {

namespace {

constexpr std::uintmax_t largest_file_bytes = std::uintmax_t{1} << 20;
/// Each dot of a key nests a table, and toml++ takes tables apart by recursion: this bounds its depth.
constexpr std::ptrdiff_t most_dots = 5000;
constexpr std::size_t most_packs = 256;
constexpr std::size_t most_presses = 1000;
constexpr double longest_script_s = 86400.0;

/// By PanelKind and LineBias.
constexpr std::array<std::string_view, 3> panel_names{"scripted", "gpio", "keys"};
constexpr std::array<std::string_view, 4> bias_names{"as-is", "pull-up", "pull-down", "disabled"};
constexpr double shortest_direction = 1e-3;

/// By DisplayKind.
constexpr std::array<std::string_view, 2> display_names{"kms", "surfaceless"};

/// By PropKind and PropZone.
constexpr std::array<std::string_view, 2> prop_names{"frustum", "cube"};
constexpr std::array<std::string_view, 2> prop_zone_names{"table", "hand"};
/// By TrackerKind.
constexpr std::array<std::string_view, 5> tracker_names{"simulated", "replay", "usb", "spacemouse", "none"};

constexpr Range near_the_table{-10.0, 10.0, "metres"};

void read_rigid(TableReader& table, std::string_view key, RigidTransform& value) {
    glm::dmat4 matrix = value.matrix();
    table.matrix(key, matrix, near_the_table);
    if (const auto rigid = rigid_from_matrix(matrix)) {
        value = *rigid;
    } else {
        table.refuse(key,
                     "scales, shears, mirrors or has a last row other than 0 0 0 1; allowed is a rotation "
                     "and a translation in metres, column by column");
    }
}

/// The projector at `position` looking at `aim`, its picture's top towards the table's far side (+Y), turned
/// by `roll_deg` about its axis, clockwise as the projector sees it. Nothing if it looks along +-Y or
/// nowhere.
std::optional<RigidTransform> looking_at(const glm::dvec3& position, const glm::dvec3& aim, double roll_deg) {
    constexpr double least_m = 1e-6;
    const glm::dvec3 far_side(0.0, 1.0, 0.0);
    if (glm::distance(aim, position) < least_m) {
        return std::nullopt;
    }
    const glm::dvec3 forward = glm::normalize(aim - position);
    const glm::dvec3 up = far_side - forward * glm::dot(far_side, forward);
    if (glm::length(up) < least_m) {
        return std::nullopt;
    }
    const glm::dvec3 down = -glm::normalize(up);
    const double roll = glm::radians(roll_deg);
    const glm::dquat rolled = glm::angleAxis(roll, glm::dvec3(0.0, 0.0, 1.0));
    const glm::dquat rotation = glm::quat_cast(glm::dmat3(glm::cross(down, forward), down, forward));
    return RigidTransform{glm::normalize(rotation * rolled), position};
}

void read_projector_pose(TableReader& table, RigidTransform& pose) {
    glm::dvec3 position = pose.translation;
    double roll_deg = 0.0;
    table.vector("position_m", position, near_the_table);
    glm::dvec3 aim(position.x, position.y, 0.0);
    table.vector("aim_m", aim, near_the_table);
    table.number("roll_deg", roll_deg, {-360.0, 360.0, "degrees"});
    const bool by_matrix = table.has("table_from_projector");
    for (const std::string_view key : {"position_m", "aim_m", "roll_deg"}) {
        if (by_matrix && table.has(key)) {
            table.refuse(key, "stands beside table_from_projector; allowed is one of the two ways");
        }
    }
    read_rigid(table, "table_from_projector", pose);
    if (!by_matrix) {
        if (const auto looking = looking_at(position, aim, roll_deg)) {
            pose = *looking;
        } else {
            table.refuse(
                "aim_m",
                "gives no direction that looks down from position_m; allowed is a point on the table");
        }
    }
}

void read_projector(TableReader table, ProjectorSettings& projector) {
    constexpr Range focal_length{50.0, 200000.0, "pixels"};
    Pinhole& pinhole = projector.pinhole;
    const double default_throw_ratio = pinhole.fx / pinhole.width;
    table.integer("width", pinhole.width, 64, 8192);
    table.integer("height", pinhole.height, 64, 8192);
    double throw_ratio = default_throw_ratio;
    table.number("throw_ratio", throw_ratio, {0.1, 20.0, "(distance over the picture's width)"});
    if (table.has("throw_ratio") && (table.has("fx") || table.has("fy"))) {
        table.refuse("throw_ratio", "stands beside fx or fy; allowed is one of the two ways");
    }
    pinhole.fx = throw_ratio * pinhole.width;
    table.number("fx", pinhole.fx, focal_length);
    pinhole.fy = pinhole.fx;
    table.number("fy", pinhole.fy, focal_length);
    // Lens shift moves the axis by up to one and a half pictures.
    pinhole.cx = 0.5 * pinhole.width;
    pinhole.cy = 0.5 * pinhole.height;
    table.number("cx", pinhole.cx, {-1.0 * pinhole.width, 2.0 * pinhole.width, "pixels"});
    table.number("cy", pinhole.cy, {-1.0 * pinhole.height, 2.0 * pinhole.height, "pixels"});
    table.number("refresh_hz", projector.refresh_hz, {10.0, 480.0, "hertz"});
    read_projector_pose(table, projector.table_from_projector);
    table.finish();
}

void read_display(TableReader table, DisplaySettings& display) {
    int kind = static_cast<int>(display.kind);
    table.choice("kind", kind, display_names);
    display.kind = static_cast<DisplayKind>(kind);
    table.text("card", display.card);
    table.text("connector", display.connector);
    std::string mode = text_of(display.mode);
    table.text("mode", mode);
    if (const auto read = parse_display_mode(mode)) {
        display.mode = *read;
    } else {
        table.refuse("mode", fmt::format("is the text \"{}\"; allowed are \"preferred\", \"1280x800\" and "
                                         "\"1280x800@60\", of 64 to 8192 pixels and 10 to 480 hertz",
                                         printable(mode, 40)));
    }
    table.flag("force", display.force);
    table.finish();
}

void read_render(TableReader table, RenderSettings& render) {
    table.number("error_tolerance_px", render.error_tolerance_px, {0.01, 20.0, "pixels"});
    table.finish();
}

void read_prop(TableReader table, PropSettings& prop) {
    int kind = static_cast<int>(prop.kind);
    table.choice("kind", kind, prop_names);
    prop.kind = static_cast<PropKind>(kind);
    table.number("base_m", prop.base_m, {0.02, 2.0, "metres"});
    const bool cube = prop.kind == PropKind::Cube;
    for (const std::string_view key : {"top_m", "height_m"}) {
        if (cube && table.has(key)) {
            double& value = key == "top_m" ? prop.top_m : prop.height_m;
            table.number(key, value, {prop.base_m, prop.base_m, "metres: a cube's edges are prop.base_m"});
        }
    }
    table.number("top_m", prop.top_m, {0.005, 2.0, "metres"});
    table.number("height_m", prop.height_m, {0.01, 2.0, "metres"});
    if (cube) {
        prop.top_m = prop.base_m;
        prop.height_m = prop.base_m;
    }
    int zone = static_cast<int>(cube ? PropZone::Hand : PropZone::Table);
    table.choice("zone", zone, prop_zone_names);
    prop.zone = static_cast<PropZone>(zone);
    table.finish();
}

void read_table(TableReader table, TableSettings& top) {
    table.number("width_m", top.width_m, {0.05, 10.0, "metres"});
    table.number("depth_m", top.depth_m, {0.05, 10.0, "metres"});
    table.finish();
}

void read_eye(TableReader table, EyeSettings& eye) {
    table.vector("default_m", eye.default_m, near_the_table);
    table.number("lowest_elevation_deg", eye.lowest_elevation_deg, {1.0, 89.0, "degrees"});
    table.number("nearest_m", eye.nearest_m, {0.05, 10.0, "metres"});
    table.number("farthest_m", eye.farthest_m, {0.1, 20.0, "metres"});
    table.flag("tracked", eye.tracked);
    table.finish();
}

void read_tracker(TableReader table, const std::filesystem::path& folder, TrackerSettings& tracker) {
    int kind = 0;
    table.choice("kind", kind, tracker_names);
    tracker.kind = static_cast<TrackerKind>(kind);
    table.integer("seed", tracker.seed);
    std::string poses;
    table.text("poses", poses);
    if (!poses.empty()) {
        tracker.poses = (folder / poses).lexically_normal();
        tracker.poses_key = table.place("poses");
    }
    table.number("replay_speed", tracker.replay_speed, {0.01, 100.0, "times as fast as recorded"});
    table.vector("hemisphere", tracker.hemisphere, {-1.0, 1.0, ""});
    if (glm::length(tracker.hemisphere) < shortest_direction) {
        table.refuse("hemisphere", "gives no direction; allowed are three numbers of which one is not 0");
    }
    read_rigid(table, "table_from_tracker", tracker.table_from_tracker);
    table.number("display_latency_ms", tracker.display_latency_ms, {0.0, 200.0, "milliseconds"});
    table.finish();
}

void read_panel(TableReader table, PanelSettings& panel) {
    int kind = 0;
    table.choice("kind", kind, panel_names);
    panel.kind = static_cast<PanelKind>(kind);
    int bias = static_cast<int>(panel.bias);
    table.choice("bias", bias, bias_names);
    panel.bias = static_cast<LineBias>(bias);
    table.text("chip", panel.chip);
    table.texts("lines", panel.lines, button_commands.size());
    table.flag("active_low", panel.active_low);
    table.texts("lamps", panel.lamps, button_commands.size());
    table.text("device", panel.device);
    table.texts("keys", panel.keys, button_commands.size());
    table.number("debounce_ms", panel.debounce_ms, {1.0, 500.0, "milliseconds"});
    table.number("stuck_s", panel.stuck_s, {5.0, 3600.0, "seconds"});
    for (TableReader& press : table.tables("script", most_presses)) {
        ScriptedPress read;
        press.number("at_s", read.at_s, {0.0, longest_script_s, "seconds"});
        press.integer("button", read.button, 0, static_cast<int>(button_commands.size()) - 1);
        press.finish();
        panel.script.push_back(read);
    }
    table.number("repeat_s", panel.repeat_s, {0.0, longest_script_s, "seconds"});
    table.finish();
}

/// The shape of a BCP 47 tag: letters, then subtags of letters and digits.
bool is_language(std::string_view tag) {
    std::size_t length = 0;
    bool first = true;
    for (const char c : tag) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        if (c == '-' && length > 0) {
            first = false;
            length = 0;
        } else if (letter || (!first && c >= '0' && c <= '9')) {
            ++length;
        } else {
            return false;
        }
        if (length > 8) {
            return false;
        }
    }
    return length > 0 && tag.find('-') != 1 && !(first && length < 2);
}

void read_exhibit(TableReader table, const std::filesystem::path& folder, ExhibitSettings& exhibit) {
    std::vector<std::string> packs;
    table.texts("packs", packs, most_packs);
    for (const std::string& pack : packs) {
        exhibit.packs.push_back((folder / pack).lexically_normal());
    }
    table.text("language", exhibit.language);
    if (!is_language(exhibit.language)) {
        table.refuse("language",
                     fmt::format("is the text \"{}\"; allowed are language tags such as \"en\" or \"de-CH\"",
                                 printable(exhibit.language, 40)));
    }
    table.flag("captions", exhibit.captions);
    table.number("caption_height_m", exhibit.caption_height_m, {0.002, 0.2, "metres"});
    table.finish();
}

Settings read_settings(const toml::table& root, const std::filesystem::path& folder, ReadState& state) {
    Settings settings;
    TableReader file(state, &root, "");
    read_projector(file.table("projector"), settings.projector);
    read_display(file.table("display"), settings.display);
    read_render(file.table("render"), settings.render);
    read_prop(file.table("prop"), settings.prop);
    read_table(file.table("table"), settings.table);
    read_eye(file.table("eye"), settings.eye);
    read_tracker(file.table("tracker"), folder, settings.tracker);
    read_panel(file.table("panel"), settings.panel);
    read_exhibit(file.table("exhibit"), folder, settings.exhibit);
    file.finish();
    return settings;
}

} // namespace

std::string_view name_of(DisplayKind kind) {
    return display_names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(PropKind kind) {
    return prop_names.at(static_cast<std::size_t>(kind));
}

std::string_view name_of(PropZone zone) {
    return prop_zone_names.at(static_cast<std::size_t>(zone));
}

PropSettings cube_settings(double edge_m) {
    return {PropKind::Cube, edge_m, edge_m, edge_m, PropZone::Hand};
}

PropShape make_prop(const PropSettings& prop) {
    return prop.kind == PropKind::Cube ? make_cube(prop.base_m)
                                       : make_frustum({prop.base_m, prop.top_m, prop.height_m});
}

std::string_view name_of(PanelKind kind) {
    return panel_names[static_cast<std::size_t>(kind)];
}

std::string_view name_of(LineBias bias) {
    return bias_names[static_cast<std::size_t>(bias)];
}

std::string_view name_of(TrackerKind kind) {
    return tracker_names[static_cast<std::size_t>(kind)];
}

Result<CheckedSettings> parse_settings(std::string_view text, const std::filesystem::path& file) {
    const auto refuse = [](std::string message) {
        return fail(ErrorKind::BadConfiguration, std::move(message));
    };
    ReadState state{printable(file.string(), 4096), {}, std::nullopt};
    if (text.size() > largest_file_bytes) {
        return refuse(
            located(state.file, 0,
                    fmt::format("is {} bytes; allowed are at most {}", text.size(), largest_file_bytes)));
    }
    if (const auto dots = std::count(text.begin(), text.end(), '.'); dots > most_dots) {
        return refuse(
            located(state.file, 0, fmt::format("holds {} dots; allowed are at most {}", dots, most_dots)));
    }
    try {
        const toml::table root = toml::parse(text);
        Settings settings = read_settings(root, file.parent_path(), state);
        if (!state.error) {
            state.error = unfit(settings, state.file, state.lines);
        }
        if (state.error) {
            return refuse(*state.error);
        }
        return CheckedSettings(std::move(settings));
    } catch (const toml::parse_error& error) {
        return refuse(located(state.file, static_cast<std::uint32_t>(error.source().begin.line),
                              fmt::format("is not TOML: {}", printable(error.description(), 200))));
    } catch (const std::exception& error) {
        return refuse(
            located(state.file, 0, fmt::format("cannot be read: {}", printable(error.what(), 200))));
    }
}

Result<CheckedSettings> load_settings(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file, largest_file_bytes);
    if (!bytes) {
        return fail(ErrorKind::BadConfiguration, bytes.error().message);
    }
    return parse_settings(as_text(*bytes), file);
}

} // namespace frustumscreen
