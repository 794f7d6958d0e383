// The cells of an artifact as windows show them: its states, and the cells as they move.
#include "app/residency/run_cells.h"
#include "app/scene/cell_plan.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::residency {

namespace {

/// After twice its time a spring is still, and a curve has its last value.
std::vector<world::CellPose> poses_at_end(const std::vector<world::Cell>& cells, world::Behaviour behaviour) {
    behaviour.repeats = false;
    behaviour.stays = true;
    return world::poses_at(cells, behaviour, 2.0 * behaviour.seconds);
}

} // namespace

void RunCells::add_states(const pack::PackWorld& world, std::span<const pack::PackState> states) {
    const std::vector<world::Cell> cells = pack::tree_of(world);
    const std::vector<world::CellPose> at_rest = world::poses_at_rest(cells);
    std::vector<scene::Part> all;
    const auto add_to_ball = [&](const std::vector<world::CellPose>& poses) {
        for (const Cell& cell : cells_) {
            const std::size_t option =
                is_site_ ? end_of(static_cast<std::size_t>(&cell - cells_.data())) - 1 : cell.first;
            scene::Part& part = all.emplace_back(scene::Part{options_[option].placed, std::nullopt});
            scene::set_pose(part.level, poses[cell.number], metres_per_box_);
        }
    };
    for (const pack::PackState& state : states) {
        State& made = states_.emplace_back();
        made.poses =
            state.behaviour ? poses_at_end(cells, world.behaviours[*state.behaviour].behaviour) : at_rest;
        made.hidden.assign(cells.size(), false);
        for (const std::size_t cell : state.hidden) {
            made.hidden[cell] = true;
        }
        made.layer = state.layer;
        add_to_ball(made.poses);
    }
    if (!states_.empty()) {
        add_to_ball(at_rest);
        states_ball_ = scene::ball_around(all);
        if (states_ball_) {
            states_ball_->radius *= 1.01; // other levels reach a little farther
        }
    }
}

std::optional<std::size_t> RunCells::window_option(std::size_t cell, bool is_mesh) const {
    const std::size_t begin = cells_[cell].first;
    const std::size_t end = end_of(cell);
    std::optional<std::size_t>
        found; // the last that is good enough, else the first: they are sorted, best first
    for (std::size_t option = begin; option < end; ++option) {
        const bool fits = (!is_mesh || options_[option].placed.triangles != nullptr) && !is_page(option);
        if (fits && (!found || options_[option].is_enough)) {
            found = option;
        }
    }
    return found;
}

bool RunCells::show_state(std::size_t state, std::vector<scene::Part>& parts) const {
    const State& shown = states_.at(state);
    for (std::size_t k = 0; k < cells_.size(); ++k) {
        if (shown.hidden[cells_[k].number]) {
            continue;
        }
        const std::optional<std::size_t> option = window_option(k, shown.layer.has_value());
        if (!option) {
            continue;
        }
        scene::Part& part = parts.emplace_back(scene::Part{options_[*option].placed, std::nullopt});
        scene::set_pose(part.level, shown.poses[cells_[k].number], metres_per_box_);
        if (shown.layer) {
            part.level.drawable.material.texture = part.level.drawable.layers.at(*shown.layer);
            if (part.level.drawable.material.texture == scene::TextureId::None) {
                return false;
            }
        }
    }
    return true;
}

void RunCells::show_moving(std::vector<scene::Part>& parts) const {
    for (std::size_t k = 0; k < cells_.size() && !poses_.empty(); ++k) {
        if (const std::optional<std::size_t> option = window_option(k, false)) {
            scene::Part& part = parts.emplace_back(scene::Part{options_[*option].placed, std::nullopt});
            scene::set_pose(part.level, poses_[cells_[k].number], metres_per_box_);
        }
    }
}

} // namespace frustumscreen::residency
