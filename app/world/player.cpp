#include "app/world/player.h"

#include "app/world/run_time.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace frustumscreen::world {

namespace {

/// A motion too small to see, in cell sizes: a fiftieth of a pixel on the usual prop.
constexpr double still_share = 1e-4;
/// If a step spans more rounds than this, the pushes of the oldest ones are left out.
constexpr std::int64_t max_rounds_in_step = 1000;

glm::dvec4 rest_of(const Cell& cell, Path path) {
    switch (path) {
    case Path::Translation:
        return {cell.rest.translation, 0.0};
    case Path::Rotation:
        return {cell.rest.rotation.x, cell.rest.rotation.y, cell.rest.rotation.z, cell.rest.rotation.w};
    case Path::Scale:
        return {cell.rest.scale, 0.0};
    case Path::Light:
        break;
    }
    return {1.0, 1.0, 1.0, 0.0};
}

void set(LocalPose& pose, Path path, const glm::dvec4& value) {
    switch (path) {
    case Path::Translation:
        pose.translation = glm::dvec3(value);
        break;
    case Path::Rotation:
        pose.rotation = glm::dquat(value.w, value.x, value.y, value.z);
        break;
    case Path::Scale:
        pose.scale = glm::dvec3(value);
        break;
    case Path::Light:
        break;
    }
}

/// The swing of a cell that is not seen any more: a length, or an angle.
double still_of(const CellExtent& extent, bool turns) {
    const double length = still_share * (extent.size > 0.0 ? extent.size : 1.0);
    return turns ? length / std::max({extent.radius, extent.size, std::numeric_limits<double>::min()})
                 : length;
}

} // namespace

std::vector<CellPose> poses_at(std::span<const Cell> cells, const Behaviour& behaviour, double seconds) {
    Player player({cells.begin(), cells.end()}, {behaviour});
    const MonotonicTime start;
    player.start(0, start);
    const double ns = std::clamp(seconds, 0.0, 1e9) * 1e9;
    const std::span<const CellPose> poses = player.step(start + Nanoseconds(std::llround(ns)));
    return {poses.begin(), poses.end()};
}

Player::Player(std::vector<Cell> cells, std::vector<Behaviour> behaviours)
    : cells_(std::move(cells)), behaviours_(std::move(behaviours)), runs_(behaviours_.size()),
      local_(cells_.size()), base_from_cell_(cells_.size()), poses_(poses_at_rest(cells_)) {
    make_parts();
    make_springs();
}

void Player::make_parts() {
    for (std::size_t k = 0; k < behaviours_.size(); ++k) {
        for (const Channel& channel : behaviours_[k].channels) {
            auto part = std::find_if(parts_.begin(), parts_.end(), [&](const Part& one) {
                return one.motion.cell() == channel.cell && one.motion.path() == channel.path;
            });
            if (part == parts_.end()) {
                const glm::dvec4 rest = rest_of(cells_.at(channel.cell), channel.path);
                parts_.push_back({MovingPart(channel.cell, channel.path, rest), {}});
                part = std::prev(parts_.end());
            }
            part->movers.push_back({k, &channel});
        }
    }
}

void Player::make_springs() {
    const std::vector<CellExtent> extents = extents_of(cells_);
    for (std::size_t k = 0; k < behaviours_.size(); ++k) {
        for (const Spring& spring : behaviours_[k].springs) {
            const double still = still_of(extents.at(spring.cell), spring.turns);
            springs_.push_back({.motion = CellSpring(spring, still), .behaviour = k});
        }
        for (const Pendulum& pendulum : behaviours_[k].pendulums) {
            const double still = still_of(extents.at(pendulum.cell), true);
            springs_.push_back({.motion = CellSpring(pendulum, still), .behaviour = k});
        }
    }
}

void Player::trigger(std::size_t behaviour, MonotonicTime now) {
    advance(now);
    is_on(behaviour) ? end(behaviour, now) : start(behaviour, now);
}

void Player::start(std::size_t behaviour, MonotonicTime now) {
    advance(now);
    runs_.at(behaviour) = {.on = true, .began = now, .turn = ++starts_};
    for (Part& part : parts_) {
        for (const Link& link : part.movers) {
            if (link.behaviour == behaviour) {
                part.motion.follow(Driver{&behaviours_[behaviour], link.channel, now}, now);
            }
        }
    }
    for (Swinging& swinging : springs_) {
        if (swinging.behaviour == behaviour) {
            swinging.rounds = 0;
            swinging.motion.start(now);
        }
    }
}

void Player::end(std::size_t behaviour, MonotonicTime now) {
    advance(now);
    if (is_on(behaviour)) {
        finish(behaviour, now);
    }
}

void Player::end_all(MonotonicTime now) {
    for (std::size_t k = 0; k < behaviours_.size(); ++k) {
        end(k, now);
    }
}

bool Player::is_on(std::size_t behaviour) const {
    return runs_.at(behaviour).on;
}

void Player::finish(std::size_t behaviour, MonotonicTime now) {
    runs_[behaviour].on = false;
    for (Part& part : parts_) {
        if (part.motion.follows(behaviours_[behaviour])) {
            part.motion.follow(newest(part), now);
        }
    }
    for (Swinging& swinging : springs_) {
        if (swinging.behaviour == behaviour) {
            swinging.motion.end(now);
        }
    }
}

std::optional<Driver> Player::newest(const Part& part) const {
    const Link* newest = nullptr;
    for (const Link& link : part.movers) {
        const Run& run = runs_[link.behaviour];
        if (run.on && (newest == nullptr || run.turn >= runs_[newest->behaviour].turn)) {
            newest = &link;
        }
    }
    if (newest == nullptr) {
        return std::nullopt;
    }
    return Driver{&behaviours_[newest->behaviour], newest->channel, runs_[newest->behaviour].began};
}

void Player::advance(MonotonicTime now) {
    const auto over_at = [this](std::size_t k) { return runs_[k].began + length_of(behaviours_[k]); };
    // In the order of their times, as if each had been a step of its own.
    while (true) {
        std::optional<std::size_t> first;
        for (std::size_t k = 0; k < runs_.size(); ++k) {
            const bool over = runs_[k].on && runs_out(behaviours_[k]) && over_at(k) <= now;
            if (over && (!first || over_at(k) < over_at(*first))) {
                first = k;
            }
        }
        if (!first) {
            break;
        }
        finish(*first, over_at(*first));
    }
    for (Swinging& swinging : springs_) {
        push(swinging, now);
    }
}

void Player::push(Swinging& swinging, MonotonicTime now) const {
    const Behaviour& behaviour = behaviours_[swinging.behaviour];
    const Run& run = runs_[swinging.behaviour];
    if (!run.on || !behaviour.repeats) {
        return;
    }
    const Nanoseconds length = length_of(behaviour);
    const std::int64_t rounds = (now - run.began) / length;
    swinging.rounds = std::max(swinging.rounds, rounds - max_rounds_in_step);
    while (swinging.rounds < rounds) {
        ++swinging.rounds;
        swinging.motion.push(run.began + swinging.rounds * length);
    }
}

bool Player::at_rest(MonotonicTime now) const {
    return std::all_of(parts_.begin(), parts_.end(),
                       [now](const Part& part) { return part.motion.at_rest(now); }) &&
           std::all_of(springs_.begin(), springs_.end(),
                       [now](const Swinging& swinging) { return swinging.motion.at_rest(now); });
}

std::span<const CellPose> Player::step(MonotonicTime now) {
    advance(now);
    const bool moved = moves_;
    moves_ = !at_rest(now);
    if (!moves_ && !moved) {
        return poses_; // at rest still
    }
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        local_[k] = cells_[k].rest;
        poses_[k].light = glm::vec3(1.0F);
    }
    for (const Part& part : parts_) {
        const glm::dvec4 value = part.motion.at(now);
        set(local_[part.motion.cell()], part.motion.path(), value);
        if (part.motion.path() == Path::Light) {
            poses_[part.motion.cell()].light = glm::vec3(glm::max(value, 0.0));
        }
    }
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        base_from_cell_[k] = local_[k].matrix();
        if (cells_[k].parent) {
            poses_[k].light *= poses_[*cells_[k].parent].light;
        }
    }
    for (const Swinging& swinging : springs_) {
        base_from_cell_[swinging.motion.cell()] *= swinging.motion.matrix(now);
    }
    pose_cells(cells_, base_from_cell_, poses_);
    return poses_;
}

} // namespace frustumscreen::world
