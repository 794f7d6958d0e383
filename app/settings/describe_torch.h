/// The settings of a torch, described as describe_settings.h describes the others.
///
/// Threads  pure; any.
#pragma once

#include "app/settings/range.h"
#include "app/settings/settings.h"

#include <array>
#include <cmath>
#include <string_view>

namespace frustumscreen::settings {

/// In the order of the enumeration.
inline constexpr std::array<std::string_view, 4> torch_source_names{"none", "tracker", "camera", "both"};

void beam_settings(auto& fields, auto& beam) {
    fields.choice(
        "shape", beam.shape, torch::shape_names,
        "shape of the light if the content has none of its own: a disc, or the content's rectangle");
    fields.choice("attenuation", beam.attenuation, torch::attenuation_names,
                  "how the light decreases with its distance from the torch, beyond full_m");
    fields.number("full_m", beam.full_m, {0.01, 10.0, "metres"}, "distance up to which the light is full");
    fields.number(
        "dark_m", beam.dark_m, {0.02, 20.0, "metres"},
        "linear, smooth_step: distance at which the light is 0; inverse_square ends where it is too "
        "dim to see");
}

/// The tag on a lamp. Its place is in the torch's frame, so that only the words differ from a prop's tag.
void lamp_tag_settings(auto& fields, auto& tag) {
    fields.integer("id", tag.id, 0, 586, "number in the family 36h11; none of the prop's");
    fields.number("size_m", tag.size_m, {0.005, 0.5, "metres"}, "side of the black square");
    fields.vector(
        "centre_m", tag.centre_m, {-1.0, 1.0, "metres"},
        "its middle in the torch's axes: +Z along the light, +X right, +Y down; from where the light "
        "comes out");
    fields.number("turn_deg", tag.turn_deg, {-360.0, 360.0, "degrees"},
                  "about the light's axis, clockwise seen along the light");
    fields.number(
        "lean_deg", tag.lean_deg, {-180.0, 180.0, "degrees"},
        "0: it looks along the light; 90: it lies on the lamp's upper side, its top towards the light");
}

template <typename Fields> void torch_settings(Fields& fields, auto& torch) {
    fields.choice(
        "source", torch.source, torch_source_names,
        "tracker: a sensor in it, station 3; camera: a tag on it, which needs camera.tags; both: one "
        "of each; none: no torch; only `frustumscreen render --torch` uses the beam below");
    constexpr Range opening{0.01, 179.0, "degrees"};
    double opening_deg = std::round(1e9 * glm::degrees(torch.beam.opening_rad)) / 1e9;
    fields.number("opening_deg", opening_deg, opening, "angle of the light across the content's width");
    if constexpr (Fields::reads) {
        torch.beam.opening_rad = glm::radians(opening_deg);
    }
    fields.number("min_opening_deg", torch.min_opening_deg, opening,
                  "narrowest angle, reached by a twist of the torch to the left");
    fields.number("max_opening_deg", torch.max_opening_deg, opening,
                  "widest angle, reached by a twist to the right");
    beam_settings(fields, torch.beam);
    fields.number("house_light", torch.house_light, {0.05, 1.0, "of its usual light"},
                  "the artifact's light while a torch is held; below 1 the torch's light stands out");
    fields.rigid("sensor_from_torch", torch.sensor_from_torch, {-1.0, 1.0, "metres"},
                 "tracker: where the light comes from, in the axes of the sensor in the torch; +Z along the "
                 "light, +Y down; 16 numbers, column by column");
    fields.table("tag", "camera: the tag on the lamp.",
                 [&](auto& inner) { lamp_tag_settings(inner, torch.tag); });
}

} // namespace frustumscreen::settings
