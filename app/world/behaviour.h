/// A behaviour: what moves which cells, for how long, and what starts it.
///
/// Frames   a channel's values replace parts of its cell's LocalPose: base_from_cell. A spring's and a pendulum's
///          motion is added to the cell's rest: base_from_cell = rest * motion.
/// Units    seconds from the behaviour's start; radians; lengths in the cell's own frame.
/// Threads  values; any.
/// Source   Khronos, glTF 2.0, 3.11 and appendix C (curves); a damped harmonic oscillator (springs).
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::world {

inline constexpr std::size_t max_behaviours = 32;
inline constexpr std::size_t max_channels = 1024; ///< of all behaviours of a world
inline constexpr std::size_t max_keys = 1 << 20;  ///< of all of them
inline constexpr double max_seconds = 3600.0;

enum class Interpolation : std::uint8_t { Step, Linear, CubicSpline };
enum class Path : std::uint8_t { Translation, Rotation, Scale, Light };

/// A value over time. Before the first key it has the first key's value, after the last the last key's.
struct Curve {
    Interpolation interpolation = Interpolation::Linear;
    std::vector<float> times_s; ///< ascending, at least one
    /// One for each key; a cubic spline has three: the tangent that comes in, the value, the tangent that leaves.
    /// A rotation is x, y, z, w; the others are x, y, z, or red, green and blue in linear light.
    std::vector<glm::vec4> values;

    [[nodiscard]] bool operator==(const Curve&) const = default;
};
struct Channel {
    std::size_t cell = 0;
    Path path = Path::Translation;
    Curve curve;

    [[nodiscard]] bool operator==(const Channel&) const = default;
};

/// A cell on a damped spring: it is pulled to `reach` while the behaviour is on, and back to 0 when it is off.
/// x'' = -stiffness (x - target) - damping x'; mass 1.
struct Spring {
    std::size_t cell = 0;
    bool turns = false;              ///< about the axis; otherwise it slides along it
    glm::dvec3 axis{0.0, 0.0, 1.0};  ///< unit, cell frame
    double reach = 0.0;              ///< radians, or a length in the cell's frame
    double stiffness_per_s2 = 100.0; ///< above 0
    double damping_per_s = 20.0;     ///< 0 or more; 2 sqrt(stiffness): critical

    [[nodiscard]] bool operator==(const Spring&) const = default;
};
/// A cell that hangs and swings about an axis, for small angles: x'' = -(g / length) x - damping x'. When the behaviour
/// starts it is pushed: it gets the speed that makes a first swing of `angle`.
struct Pendulum {
    std::size_t cell = 0;
    glm::dvec3 axis{0.0, 1.0, 0.0}; ///< unit, cell frame
    double angle_rad = 0.2;
    double length_m = 0.25;
    double damping_per_s = 0.3;

    [[nodiscard]] bool operator==(const Pendulum&) const = default;
};

enum class Trigger : std::uint8_t {
    Button,    ///< the button `behaviour`
    Dwell,     ///< a visitor has looked for a while without moving the prop
    Hotspot,   ///< the prop is turned so that a hotspot is shown
    Narration, ///< the audio description has reached a time
    Arrival,   ///< the artifact has come
};
inline constexpr std::array<std::string_view, 5> trigger_names{"button", "dwell", "hotspot", "narration",
                                                               "arrival"};

struct Behaviour {
    std::string name; ///< unique in its world
    Trigger trigger = Trigger::Button;
    std::uint32_t hotspot = 0; ///< for Trigger::Hotspot: index into the pack's hotspots
    double narration_s = 0.0;  ///< for Trigger::Narration
    double seconds = 0.0;      ///< of one run; for a spring or pendulum until it counts as still
    bool repeats = false;      ///< begins again until it is ended
    /// Keeps its end until it is triggered again; otherwise it returns to rest at its end.
    bool stays = false;
    std::vector<Channel> channels{};
    std::vector<Spring> springs{};
    std::vector<Pendulum> pendulums{};

    [[nodiscard]] bool operator==(const Behaviour&) const = default;
};

} // namespace frustumscreen::world
