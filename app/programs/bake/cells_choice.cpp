#include "app/programs/bake/cells_choice.h"

#include <fmt/format.h>

#include <set>

namespace frustumscreen::programs {

namespace {

std::size_t moved_parts(const bake::SourceMesh& mesh) {
    std::set<std::size_t> moved;
    for (const bake::SourceAnimation& animation : mesh.animations) {
        for (const world::Channel& channel : animation.channels) {
            moved.insert(channel.cell);
        }
    }
    return moved.size();
}

} // namespace

CellsChoice choose_cells(const std::string& option, const bake::SourceMesh& mesh, std::size_t behaviours,
                         bool hides) {
    if (option == "none") {
        return {.why = "--cells none says so"};
    }
    if (behaviours > 0) {
        return {.nodes = true, .why = "artifact.toml has [[behaviours]]"};
    }
    if (hides) {
        return {.nodes = true, .why = "a state of artifact.toml hides parts"};
    }
    if (!mesh.animations.empty()) {
        return {.nodes = true,
                .why = fmt::format("the file's animations move {} of its {} parts", moved_parts(mesh),
                                   mesh.nodes.size())};
    }
    if (option == "auto") {
        return {.found = true, .why = ""};
    }
    if (mesh.nodes.empty()) {
        return {.why = "the file is one part that does not move"};
    }
    if (option == "nodes") {
        return {.nodes = true, .why = "--cells nodes says so"};
    }
    return {.why = fmt::format("none of the file's {} parts moves", mesh.nodes.size())};
}

} // namespace frustumscreen::programs
