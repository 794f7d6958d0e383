#include "assets_baked/folder/artifact_behaviours.h"

#include "app/pack/pack_text.h"
#include "assets_baked/folder/artifact_labels.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace frustumscreen::folder {

namespace {

constexpr settings::Range angle{-180.0, 180.0, "degrees"};
constexpr settings::Range duration{0.0, world::max_seconds, "seconds"};
constexpr settings::Range damping{0.0, 1e6, "per second"};

/// A name of the folder's file or of the model: one line that can be shown.
void read_name(settings::TableReader& table, std::string_view key, std::string& name) {
    table.any_text(key, name);
    if (const std::optional<std::string> fault = pack::fault_of_text(name, pack::TextShape::Line)) {
        table.refuse("behaviours.name", key, *fault);
    }
    name = std::string(trimmed(name));
}

/// Left as it is, or of length 1.
void read_axis(settings::TableReader& table, glm::dvec3& axis) {
    table.vector("axis", axis, {-1e6, 1e6, ""});
    const double length = glm::length(axis);
    table.require("behaviours.axis", length > 1e-6, "axis",
                  "has no length; allowed is a direction, such as [0, 0, 1]");
    axis = length > 1e-6 ? axis / length : axis;
}

void read_spring(settings::TableReader& table, ArtifactSpring& spring) {
    read_axis(table, spring.axis);
    double reach_deg = 0.0;
    double reach_mm = 0.0;
    table.number("reach_deg", reach_deg, angle);
    table.number("reach_mm", reach_mm, {-1e6, 1e6, "mm"});
    table.number("stiffness", spring.stiffness_per_s2, {1e-3, 1e9, "per second squared"});
    table.number("damping", spring.damping_per_s, damping);
    table.finish(); // a misspelt key is reported before a missing one
    table.one_way("reach_deg", {"reach_mm"}, "reach_mm");
    table.require("behaviours.no_reach", table.has("reach_deg") || table.has("reach_mm"), "reach_deg",
                  "is missing, and so is reach_mm; write how far the part turns or slides");
    if (table.has("reach_deg")) {
        spring.reach_deg = reach_deg;
    } else {
        spring.reach_mm = reach_mm;
    }
}

void read_pendulum(settings::TableReader& table, ArtifactPendulum& pendulum) {
    read_axis(table, pendulum.axis);
    table.number("reach_deg", pendulum.reach_deg, angle);
    table.number("length_m", pendulum.length_m, {1e-3, 1e3, "m"});
    table.number("damping", pendulum.damping_per_s, damping);
}

/// A part `key` of the behaviour that is a table of its own.
template <typename Motion>
void read_motion(settings::TableReader& table, std::string_view key, std::optional<Motion>& motion,
                 const auto& read) {
    Motion written;
    table.table(key, {}, [&](settings::TableReader& inner) {
        if (table.has(key)) {
            read(inner, written);
        }
    });
    if (table.has(key)) {
        motion = written;
    }
}

/// The key that says what happens; refuses none and two of them.
void check_motion(settings::TableReader& table, const ArtifactBehaviour& behaviour) {
    constexpr std::array<std::string_view, 4> motions{"animation", "spring", "pendulum", "light"};
    const auto count = std::count_if(motions.begin(), motions.end(),
                                     [&](std::string_view motion) { return table.has(motion); });
    table.require("behaviours.motion", count == 1, "animation",
                  count == 0 ? "is missing; write animation, spring, pendulum or light: what happens"
                             : "is not alone; allowed is one of animation, spring, pendulum and light");
    const bool needs_cell = !table.has("animation");
    table.require("behaviours.no_cell", !needs_cell || !behaviour.cell.empty(), "cell",
                  "is missing; name the part of the model that moves");
    table.require("behaviours.cell_of_animation", needs_cell || !table.has("cell"), "cell",
                  "stands beside animation, which has its own parts; take it away");
    table.require("behaviours.seconds", table.has("light") || !table.has("seconds"), "seconds",
                  "stands without light; the other motions have their own time");
}

void check_trigger(settings::TableReader& table, const ArtifactBehaviour& behaviour, std::size_t hotspots) {
    const auto belongs = [&](std::string_view key, world::Trigger trigger) {
        const bool is_its = behaviour.trigger == trigger;
        const std::string_view word = world::trigger_names.at(static_cast<std::size_t>(trigger));
        table.require("behaviours.trigger_key", !table.has(key) || is_its, key,
                      fmt::format("stands without trigger = \"{}\"", word));
        table.require("behaviours.trigger_missing", table.has(key) || !is_its, key,
                      fmt::format("is missing; trigger = \"{}\" needs it", word));
    };
    belongs("hotspot", world::Trigger::Hotspot);
    belongs("narration_s", world::Trigger::Narration);
    table.require("behaviours.no_hotspot",
                  behaviour.trigger != world::Trigger::Hotspot ||
                      static_cast<std::size_t>(behaviour.hotspot) < hotspots,
                  "hotspot",
                  fmt::format("is {}; the file has {} tables [[hotspots]], counted from 0", behaviour.hotspot,
                              hotspots));
}

} // namespace

void read_behaviour(settings::TableReader& table, ArtifactBehaviour& behaviour, std::size_t hotspots,
                    const std::vector<ArtifactBehaviour>& before) {
    read_name(table, "name", behaviour.name);
    read_name(table, "animation", behaviour.animation);
    read_name(table, "cell", behaviour.cell);
    read_motion(table, "spring", behaviour.spring, read_spring);
    read_motion(table, "pendulum", behaviour.pendulum, read_pendulum);
    ArtifactLight light;
    table.vector("light", light.colour, {0.0, 100.0, "times the colour, linear light"});
    table.number("seconds", light.seconds, duration);
    if (table.has("light")) {
        behaviour.light = light;
    }
    table.choice("trigger", behaviour.trigger, world::trigger_names, {});
    table.integer("hotspot", behaviour.hotspot, 0, 1000, {});
    table.number("narration_s", behaviour.narration_s, duration);
    table.flag("repeats", behaviour.repeats, {});
    table.flag("stays", behaviour.stays, {});
    read_labels(table, "titles", behaviour.titles);
    table.finish(); // as for a spring
    behaviour.place = table.place("name");
    table.require("behaviours.no_name", !behaviour.name.empty(), "name",
                  "is missing or empty; every [[behaviours]] has a name of its own");
    const bool is_second = std::any_of(before.begin(), before.end(), [&](const ArtifactBehaviour& each) {
        return &each != &behaviour && each.name == behaviour.name;
    });
    table.require(
        "behaviours.name_twice", !is_second, "name",
        fmt::format("is \"{}\" a second time; allowed is each name once", printable(behaviour.name, 40)));
    check_motion(table, behaviour);
    check_trigger(table, behaviour, hotspots);
}

} // namespace frustumscreen::folder
