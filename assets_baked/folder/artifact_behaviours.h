/// The tables [[behaviours]] of artifact.toml: what moves, and what starts it.
///
/// Frames   an axis is in the moving part's own frame, as in the program that made the model.
/// Units    degrees; millimetres of a model whose file measures in metres, as glTF does; seconds.
/// Errors   in the table's ReadState.
/// Threads  one caller.
#pragma once

#include "app/pack/pack.h"
#include "app/settings/table_reader.h"
#include "app/world/behaviour.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::folder {

/// The part springs to `reach` while the behaviour is on. Exactly one of the two has a value.
struct ArtifactSpring {
    glm::dvec3 axis{0.0, 0.0, 1.0};
    std::optional<double> reach_deg;
    std::optional<double> reach_mm;
    double stiffness_per_s2 = 100.0;
    double damping_per_s = 20.0;
};
struct ArtifactPendulum {
    glm::dvec3 axis{0.0, 0.0, 1.0};
    double reach_deg = 10.0;
    double length_m = 0.25;
    double damping_per_s = 0.3;
};
/// The part's colours are multiplied by `colour`, linear light, little by little.
struct ArtifactLight {
    glm::dvec3 colour{1.0};
    double seconds = 1.0;
};

/// Exactly one of animation, spring, pendulum and light is there.
struct ArtifactBehaviour {
    std::string place; ///< file, line and key, for messages
    std::string name;
    std::string animation; ///< the model's own; empty: none
    std::string cell;      ///< name of the part, for all but an animation
    std::optional<ArtifactSpring> spring;
    std::optional<ArtifactPendulum> pendulum;
    std::optional<ArtifactLight> light;
    world::Trigger trigger = world::Trigger::Button;
    int hotspot = 0; ///< counted from 0
    double narration_s = 0.0;
    bool repeats = false;
    bool stays = false;
    std::vector<pack::PackLabel> titles; ///< what the visitor is told, in each language
};

/// `hotspots`: how many the artifact has. `before`: the behaviours above this one.
void read_behaviour(settings::TableReader& table, ArtifactBehaviour& behaviour, std::size_t hotspots,
                    const std::vector<ArtifactBehaviour>& before);

} // namespace frustumscreen::folder
