#include "app/pack/check_pack.h"
#include "app/pack/check_world.h"
#include "app/pack/curves_part.h"
#include "app/pack/pack_text.h"
#include "app/pack/world_sections.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>

namespace frustumscreen::pack {

namespace {

constexpr double unit_tolerance = 1e-3;
constexpr float min_quaternion = 1e-3F;
constexpr double max_reach = 1e6;
constexpr double min_stiffness_per_s2 = 1e-3, max_stiffness_per_s2 = 1e9;
constexpr double max_damping_per_s = 1e6;
constexpr double min_length_m = 1e-3, max_length_m = 1e3;

/// False for NaN.
bool lies_in(double value, double low, double high) {
    return value >= low && value <= high;
}

bool is_finite(const glm::vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

Result<void> check_times(const std::string& place, const std::vector<float>& times_s) {
    for (std::size_t k = 0; k < times_s.size(); ++k) {
        if (!lies_in(static_cast<double>(times_s[k]), 0.0, world::max_seconds)) {
            return bad_input("behaviour.key_time", "{} has key {} at {} s; allowed are 0 to {} s", place, k,
                             times_s[k], world::max_seconds);
        }
        if (k > 0 && !(times_s[k] > times_s[k - 1])) {
            return bad_input("behaviour.times_back",
                             "{} has key {} at {} s after one at {} s; allowed are times that go on", place,
                             k, times_s[k], times_s[k - 1]);
        }
    }
    return {};
}

Result<void> check_values(const std::string& place, const world::Channel& channel) {
    const world::Curve& curve = channel.curve;
    const std::size_t per_key = values_per_key(curve.interpolation);
    for (std::size_t k = 0; k < curve.values.size(); ++k) {
        const glm::vec4& value = curve.values[k];
        const bool is_tangent = per_key == 3 && k % 3 != 1;
        if (!is_finite(value)) {
            return bad_input("behaviour.key_value", "{} has a value that is not a finite number at key {}",
                             place, k / per_key);
        }
        if (channel.path == world::Path::Rotation && !is_tangent && !(glm::length(value) >= min_quaternion)) {
            return bad_input("behaviour.no_rotation",
                             "{} has a quaternion of no length at key {}; allowed are unit quaternions",
                             place, k / per_key);
        }
        if (channel.path == world::Path::Light && !is_tangent &&
            !(std::min({value.x, value.y, value.z}) >= 0.0F)) {
            return bad_input("behaviour.dark_light", "{} has light below 0 at key {}; allowed is 0 and more",
                             place, k / per_key);
        }
    }
    return {};
}

Result<void> check_curve(const std::string& place, const world::Channel& channel) {
    const world::Curve& curve = channel.curve;
    if (curve.times_s.empty() ||
        curve.values.size() != curve.times_s.size() * values_per_key(curve.interpolation)) {
        return bad_input(
            "behaviour.keys",
            "{} has {} times and {} values; allowed are one time at least, and {} values for each", place,
            curve.times_s.size(), curve.values.size(), values_per_key(curve.interpolation));
    }
    TRY_VOID(check_times(place, curve.times_s));
    return check_values(place, channel);
}

Result<void> check_target(const std::string& place, std::size_t cell, std::size_t cells) {
    return cell < cells
               ? Result<void>()
               : bad_input("behaviour.no_cell", "{} moves cell {}; the pack has {} cells, counted from 0",
                           place, cell, cells);
}

Result<void> check_channels(const std::string& place, const world::Behaviour& behaviour, std::size_t cells,
                            Curves curves) {
    std::set<std::pair<std::size_t, world::Path>> moved;
    for (const world::Channel& channel : behaviour.channels) {
        TRY_VOID(check_target(place, channel.cell, cells));
        const std::string_view path = path_names.at(static_cast<std::size_t>(channel.path));
        if (!moved.insert({channel.cell, channel.path}).second) {
            return bad_input("behaviour.channel_twice",
                             "{} has two channels for the {} of cell {}; allowed is one", place, path,
                             channel.cell);
        }
        if (curves == Curves::Read) {
            TRY_VOID(check_curve(fmt::format("{}, {} of cell {},", place, path, channel.cell), channel));
        }
    }
    return {};
}

Result<void> check_axis(const std::string& place, const glm::dvec3& axis) {
    return std::abs(glm::length(axis) - 1.0) <= unit_tolerance // false for NaN
               ? Result<void>()
               : bad_input("behaviour.axis", "{} has the axis ({}, {}, {}); allowed is one of length 1",
                           place, axis.x, axis.y, axis.z);
}

Result<void> check_spring(const std::string& place, const world::Spring& spring, std::size_t cells) {
    TRY_VOID(check_target(place, spring.cell, cells));
    TRY_VOID(check_axis(place, spring.axis));
    if (!lies_in(spring.reach, -max_reach, max_reach) ||
        !lies_in(spring.stiffness_per_s2, min_stiffness_per_s2, max_stiffness_per_s2) ||
        !lies_in(spring.damping_per_s, 0.0, max_damping_per_s)) {
        return bad_input(
            "behaviour.spring",
            "{} has a spring of reach {}, stiffness {} and damping {}; allowed are {} to {}, {} to {}, "
            "and 0 to {}",
            place, spring.reach, spring.stiffness_per_s2, spring.damping_per_s, -max_reach, max_reach,
            min_stiffness_per_s2, max_stiffness_per_s2, max_damping_per_s);
    }
    return {};
}

Result<void> check_pendulum(const std::string& place, const world::Pendulum& pendulum, std::size_t cells) {
    TRY_VOID(check_target(place, pendulum.cell, cells));
    TRY_VOID(check_axis(place, pendulum.axis));
    if (!lies_in(pendulum.angle_rad, -std::numbers::pi, std::numbers::pi) ||
        !lies_in(pendulum.length_m, min_length_m, max_length_m) ||
        !lies_in(pendulum.damping_per_s, 0.0, max_damping_per_s)) {
        return bad_input(
            "behaviour.pendulum",
            "{} has a pendulum of angle {}, length {} m and damping {}; allowed are -pi to pi, {} to {} "
            "m, and 0 to {}",
            place, pendulum.angle_rad, pendulum.length_m, pendulum.damping_per_s, min_length_m, max_length_m,
            max_damping_per_s);
    }
    return {};
}

Result<void> check_times_of_run(const std::string& place, const world::Behaviour& behaviour) {
    if (!lies_in(behaviour.seconds, 0.0, world::max_seconds) ||
        !lies_in(behaviour.narration_s, 0.0, world::max_seconds)) {
        return bad_input("behaviour.seconds",
                         "{} lasts {} s, and begins {} s after the description; allowed are 0 to {} s", place,
                         behaviour.seconds, behaviour.narration_s, world::max_seconds);
    }
    return {};
}

Result<void> check_behaviour(const std::string& place, const PackBehaviour& packed, const PackWorld& world,
                             const PackDescription& pack, Curves curves) {
    const world::Behaviour& behaviour = packed.behaviour;
    const std::size_t cells = world.cells.size();
    TRY_VOID(check_times_of_run(place, behaviour));
    if (behaviour.trigger == world::Trigger::Hotspot && behaviour.hotspot >= pack.hotspots.size()) {
        return bad_input("behaviour.hotspot",
                         "{} is started by hotspot {}; the pack has {} hotspots, counted from 0", place,
                         behaviour.hotspot, pack.hotspots.size());
    }
    if (behaviour.channels.empty() && behaviour.springs.empty() && behaviour.pendulums.empty()) {
        return bad_input("behaviour.moves_nothing",
                         "{} moves nothing; give it an animation of the model, a spring or a pendulum",
                         place);
    }
    TRY_VOID(check_channels(place, behaviour, cells, curves));
    for (const world::Spring& spring : behaviour.springs) {
        TRY_VOID(check_spring(place, spring, cells));
    }
    for (const world::Pendulum& pendulum : behaviour.pendulums) {
        TRY_VOID(check_pendulum(place, pendulum, cells));
    }
    return check_labels(place, packed.titles);
}

Result<void> check_counts(const PackWorld& world) {
    std::size_t channels = 0;
    std::size_t keys = 0;
    for (const PackBehaviour& packed : world.behaviours) {
        channels += packed.behaviour.channels.size();
        for (const world::Channel& channel : packed.behaviour.channels) {
            keys += channel.curve.times_s.size();
        }
        if (std::max(packed.behaviour.springs.size(), packed.behaviour.pendulums.size()) > world::max_cells) {
            return bad_input("behaviour.spring_count",
                             "behaviour '{}' has more than {} springs or pendulums; allowed are fewer",
                             printable(packed.behaviour.name, 40), world::max_cells);
        }
    }
    if (world.behaviours.size() > world::max_behaviours || channels > world::max_channels ||
        keys > world::max_keys) {
        return bad_input("behaviour.count",
                         "the pack has {} behaviours with {} channels and {} keys; allowed are {}, {} and {}",
                         world.behaviours.size(), channels, keys, world::max_behaviours, world::max_channels,
                         world::max_keys);
    }
    return {};
}

} // namespace

Result<void> check_behaviours(const PackWorld& world, const PackDescription& pack, Curves curves) {
    TRY_VOID(check_counts(world));
    std::set<std::string_view> names;
    for (std::size_t k = 0; k < world.behaviours.size(); ++k) {
        const std::string& name = world.behaviours[k].behaviour.name;
        if (const std::optional<std::string> fault = fault_of_text(name, TextShape::Line)) {
            return bad_input("behaviour.name", "the name of behaviour {} {} (it is '{}')", k, *fault,
                             printable(name, 40));
        }
        if (name.empty() || !names.insert(name).second) {
            return bad_input("behaviour.name_twice",
                             "behaviour {} is called '{}'; each behaviour needs a name of its own", k,
                             printable(name, 40));
        }
        const std::string place = fmt::format("behaviour '{}'", printable(name, 40));
        TRY_VOID(check_behaviour(place, world.behaviours[k], world, pack, curves));
    }
    return {};
}

} // namespace frustumscreen::pack
