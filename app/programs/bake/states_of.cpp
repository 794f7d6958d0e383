#include "app/programs/bake/states_of.h"

#include "app/programs/bake/torch_layers.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace frustumscreen::programs {

namespace {

using folder::ArtifactState;

constexpr std::size_t max_listed_bytes = 200;

std::string listed(const std::vector<std::string>& names) {
    return names.empty() ? "it has none"
                         : "it has " + printable(fmt::format("{}", fmt::join(names, ", ")), max_listed_bytes);
}

/// For each node: the state hides it, by its own name or as a part of a hidden one.
Result<std::vector<bool>> hidden_nodes(const ArtifactState& state, const bake::SourceMesh& mesh) {
    std::vector<bool> hidden(mesh.nodes.size(), false);
    for (const std::string& name : state.hide) {
        bool found = false;
        std::vector<std::string> names;
        for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
            const bool is_it = mesh.nodes[k].name == name;
            hidden[k] = hidden[k] || is_it;
            found = found || is_it;
            names.push_back(mesh.nodes[k].name);
        }
        if (!found) {
            return bad_input("states.no_part", "{}: the model has no part '{}' to hide; {}", state.place,
                             printable(name, 40), listed(names));
        }
    }
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
        for (std::optional<std::size_t> at = mesh.nodes[k].parent; at; at = mesh.nodes[*at].parent) {
            hidden[k] = hidden[k] || hidden[*at];
        }
    }
    return hidden;
}

Result<std::optional<std::size_t>> behaviour_of(const ArtifactState& state,
                                                std::span<const pack::PackBehaviour> behaviours) {
    if (state.behaviour.empty()) {
        return std::optional<std::size_t>();
    }
    std::vector<std::string> names;
    for (std::size_t k = 0; k < behaviours.size(); ++k) {
        if (behaviours[k].behaviour.name == state.behaviour) {
            return std::optional(k);
        }
        names.push_back(behaviours[k].behaviour.name);
    }
    return bad_input("states.no_behaviour", "{}: the artifact has no behaviour '{}'; {}", state.place,
                     printable(state.behaviour, 40), listed(names));
}

/// The cells of the hidden nodes. A node that was joined with others into one cell cannot be hidden alone.
Result<std::vector<std::size_t>> hidden_cells(const ArtifactState& state, const bake::SourceMesh& mesh,
                                              std::span<const std::optional<std::size_t>> cell_of) {
    TRY(const std::vector<bool> hidden, hidden_nodes(state, mesh));
    std::set<std::size_t> cells, others;
    for (std::size_t k = 0; k < hidden.size() && k < cell_of.size(); ++k) {
        if (cell_of[k]) {
            (hidden[k] ? cells : others).insert(*cell_of[k]);
        }
    }
    const bool is_joined =
        std::any_of(cells.begin(), cells.end(), [&](std::size_t cell) { return others.contains(cell); });
    if (!state.hide.empty() && (cells.empty() || is_joined)) {
        return bad_input("states.no_cell",
                         "{}: {} cannot be hidden, since the bake made {} of it; allowed are parts with a "
                         "surface, with --cells nodes or without the option, of a model of at most {} parts",
                         state.place, printable(fmt::format("{}", fmt::join(state.hide, ", ")), 80),
                         is_joined ? "one cell with others" : "no cell", world::max_cells);
    }
    if (!cells.empty() && others.empty()) {
        return bad_input("states.nothing_left",
                         "{}: it hides every part of the artifact; allowed is all but one", state.place);
    }
    return std::vector<std::size_t>(cells.begin(), cells.end());
}

std::string line_of(const ArtifactState& state) {
    std::vector<std::string> parts;
    if (!state.hide.empty()) {
        parts.push_back("without " + fmt::format("{}", fmt::join(state.hide, ", ")));
    }
    if (!state.behaviour.empty()) {
        parts.push_back("at the end of " + state.behaviour);
    }
    if (state.layer) {
        parts.push_back("in " + state.layer->file.filename().string());
    }
    return printable(
        fmt::format("{}: {}", state.name,
                    parts.empty() ? "as it is at rest" : fmt::format("{}", fmt::join(parts, ", "))),
        max_listed_bytes);
}

} // namespace

bool hides_parts(const BakeRequest& request) {
    return std::any_of(request.states.begin(), request.states.end(),
                       [](const ArtifactState& state) { return !state.hide.empty(); });
}

Result<std::vector<std::string>> check_states(const BakeRequest& request, const bake::SourceMesh& mesh,
                                              std::span<const pack::PackBehaviour> behaviours) {
    std::vector<std::string> lines;
    for (const ArtifactState& state : request.states) {
        TRY_VOID(without_value(hidden_nodes(state, mesh)));
        TRY_VOID(without_value(behaviour_of(state, behaviours)));
        lines.push_back(line_of(state));
    }
    return lines;
}

Result<std::vector<pack::PackState>> states_of(const BakeRequest& request, const bake::SourceMesh& mesh,
                                               const pack::PackWorld& world,
                                               std::span<const std::optional<std::size_t>> cell_of) {
    std::vector<pack::PackState> states;
    for (const ArtifactState& written : request.states) {
        pack::PackState& state = states.emplace_back();
        state.name = written.name;
        state.titles = written.titles;
        TRY(state.hidden, hidden_cells(written, mesh, cell_of));
        TRY(state.behaviour, behaviour_of(written, world.behaviours));
        if (written.layer) {
            state.layer = state_layer_of(request, *written.layer);
        }
    }
    return states;
}

} // namespace frustumscreen::programs
