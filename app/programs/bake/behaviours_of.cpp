#include "app/programs/bake/behaviours_of.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace frustumscreen::programs {

namespace {

constexpr double gravity_m_per_s2 = 9.81;
constexpr double metres_per_mm = 1e-3; // glTF measures in metres
constexpr std::size_t max_listed_bytes = 200;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

double seconds_of(const std::vector<world::Channel>& channels) {
    double seconds = 0.0;
    for (const world::Channel& channel : channels) {
        seconds = std::max(seconds, static_cast<double>(channel.curve.times_s.back()));
    }
    return seconds;
}

template <typename Named> std::string names_of(const std::vector<Named>& all) {
    std::vector<std::string> names;
    for (const Named& each : all) {
        names.push_back(each.name);
    }
    return names.empty() ? "it has none"
                         : "it has " + printable(fmt::format("{}", fmt::join(names, ", ")), max_listed_bytes);
}

Result<const bake::SourceAnimation*> animation_of(const folder::ArtifactBehaviour& written,
                                                  const bake::SourceMesh& mesh) {
    for (const bake::SourceAnimation& each : mesh.animations) {
        if (each.name == written.animation) {
            return &each;
        }
    }
    return bad_input("behaviour.no_animation", "{}: the model has no animation '{}' that moves parts; {}",
                     written.place, printable(written.animation, 40), names_of(mesh.animations));
}

Result<std::size_t> node_of(const folder::ArtifactBehaviour& written, const bake::SourceMesh& mesh) {
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
        if (mesh.nodes[k].name == written.cell) {
            return k;
        }
    }
    return bad_input("behaviour.no_part", "{}: the model has no part '{}'; {}", written.place,
                     printable(written.cell, 40), names_of(mesh.nodes));
}

glm::dmat3 file_from_node(const bake::SourceMesh& mesh, std::size_t node) {
    glm::dmat3 transform(1.0);
    for (std::optional<std::size_t> at = node; at; at = mesh.nodes[*at].parent) {
        transform = glm::dmat3(mesh.nodes[*at].parent_from_base) * glm::dmat3(mesh.nodes[*at].rest.matrix()) *
                    transform;
    }
    return transform;
}

/// A length of the model as the node's own frame measures it along `axis`.
double in_node(double metres, const bake::SourceMesh& mesh, std::size_t node, const glm::dvec3& axis) {
    const double stretch = glm::length(file_from_node(mesh, node) * axis);
    return stretch > 0.0 ? metres / stretch : 0.0;
}

world::Spring spring_of(const folder::ArtifactSpring& written, const bake::SourceMesh& mesh,
                        std::size_t node) {
    world::Spring spring{.cell = node,
                         .turns = written.reach_deg.has_value(),
                         .axis = written.axis,
                         .reach = 0.0,
                         .stiffness_per_s2 = written.stiffness_per_s2,
                         .damping_per_s = written.damping_per_s};
    spring.reach = spring.turns
                       ? radians(*written.reach_deg)
                       : in_node(written.reach_mm.value_or(0.0) * metres_per_mm, mesh, node, written.axis);
    return spring;
}

world::Pendulum pendulum_of(const folder::ArtifactPendulum& written, std::size_t node) {
    return {.cell = node,
            .axis = written.axis,
            .angle_rad = radians(written.reach_deg),
            .length_m = written.length_m,
            .damping_per_s = written.damping_per_s};
}

/// From the part's own colours to the written ones.
world::Channel light_of(const folder::ArtifactLight& written, std::size_t node) {
    world::Channel channel{.cell = node, .path = world::Path::Light, .curve = {}};
    channel.curve.times_s = {0.0F};
    channel.curve.values = {glm::vec4(glm::vec3(written.colour), 0.0F)};
    if (const auto end_s = static_cast<float>(written.seconds); end_s > 0.0F) {
        channel.curve.times_s.push_back(end_s);
        channel.curve.values.insert(channel.curve.values.begin(), glm::vec4(1.0F, 1.0F, 1.0F, 0.0F));
    }
    return channel;
}

Result<pack::PackBehaviour> behaviour_of(const folder::ArtifactBehaviour& written,
                                         const bake::SourceMesh& mesh) {
    pack::PackBehaviour made;
    world::Behaviour& behaviour = made.behaviour;
    behaviour.name = written.name;
    behaviour.trigger = written.trigger;
    behaviour.hotspot =
        written.trigger == world::Trigger::Hotspot ? static_cast<std::uint32_t>(written.hotspot) : 0;
    behaviour.narration_s = written.narration_s;
    behaviour.repeats = written.repeats;
    behaviour.stays = written.stays;
    made.titles = written.titles;
    if (!written.animation.empty()) {
        TRY(const bake::SourceAnimation* const animation, animation_of(written, mesh));
        behaviour.channels = animation->channels;
        behaviour.seconds = seconds_of(behaviour.channels);
        return made;
    }
    TRY(const std::size_t node, node_of(written, mesh));
    if (written.spring) {
        behaviour.springs.push_back(spring_of(*written.spring, mesh, node));
        behaviour.seconds = settling_s(written.spring->stiffness_per_s2, written.spring->damping_per_s);
    } else if (written.pendulum) {
        behaviour.pendulums.push_back(pendulum_of(*written.pendulum, node));
        behaviour.seconds =
            settling_s(gravity_m_per_s2 / written.pendulum->length_m, written.pendulum->damping_per_s);
    } else {
        behaviour.channels.push_back(light_of(*written.light, node));
        behaviour.seconds = written.light->seconds;
    }
    return made;
}

/// `name`, or with a number after it if a behaviour has it.
std::string free_name(const std::string& name, const std::vector<pack::PackBehaviour>& behaviours) {
    const auto is_taken = [&](const std::string& wanted) {
        return std::any_of(behaviours.begin(), behaviours.end(),
                           [&](const pack::PackBehaviour& each) { return each.behaviour.name == wanted; });
    };
    std::string free = name;
    for (std::size_t number = 2; is_taken(free); ++number) {
        free = fmt::format("{} {}", name, number);
    }
    return free;
}

} // namespace

double settling_s(double stiffness_per_s2, double damping_per_s) {
    // The slowest decay; (1 + x) exp(-x) is 0.001 at 9.23, which no other damping exceeds.
    const double half = damping_per_s / 2.0;
    const double discriminant = half * half - stiffness_per_s2;
    const double rate_per_s = discriminant > 0.0 ? stiffness_per_s2 / (half + std::sqrt(discriminant)) : half;
    return rate_per_s > 0.0 ? std::min(world::max_seconds, 9.3 / rate_per_s) : world::max_seconds;
}

Result<std::vector<pack::PackBehaviour>> behaviours_of(std::span<const folder::ArtifactBehaviour> written,
                                                       const bake::SourceMesh& mesh,
                                                       std::vector<std::string>& lost) {
    std::vector<pack::PackBehaviour> made;
    for (const folder::ArtifactBehaviour& each : written) {
        TRY(pack::PackBehaviour behaviour, behaviour_of(each, mesh));
        made.push_back(std::move(behaviour));
    }
    for (const bake::SourceAnimation& animation : mesh.animations) {
        const bool is_named =
            std::any_of(written.begin(), written.end(), [&](const folder::ArtifactBehaviour& each) {
                return each.animation == animation.name;
            });
        if (is_named) {
            continue;
        }
        if (made.size() >= world::max_behaviours) {
            lost.push_back(fmt::format("the animation '{}': {} behaviours are allowed; take some out of "
                                       "artifact.toml",
                                       animation.name, world::max_behaviours));
            continue;
        }
        pack::PackBehaviour& behaviour = made.emplace_back();
        behaviour.behaviour.name = free_name(animation.name, made);
        behaviour.behaviour.channels = animation.channels;
        behaviour.behaviour.seconds = seconds_of(animation.channels);
    }
    return made;
}

Result<std::vector<pack::PackBehaviour>> movements_of(const BakeRequest& request,
                                                      const bake::SourceMesh& mesh, const CellsChoice& cells,
                                                      std::vector<bake::SourceNote>& notes) {
    std::vector<std::string> lost;
    TRY(std::vector<pack::PackBehaviour> behaviours, behaviours_of(request.behaviours, mesh, lost));
    if (!cells.nodes && !behaviours.empty()) {
        const std::string movements =
            behaviours.size() == 1 ? "the movement" : fmt::format("{} movements", behaviours.size());
        lost = {fmt::format("{} of its parts, since {}", movements, cells.why)};
        behaviours.clear();
    }
    for (const std::string& each : lost) {
        notes.push_back({bake::SourceNote::Kind::Lost, each});
    }
    return behaviours;
}

} // namespace frustumscreen::programs
