// The data of the sections cells and behaviours, a line each: refused in one line, or every cell has a finite pose, every
// behaviour moves cells that are there, and written again they read equal.
#include "app/pack/check_world.h"
#include "app/pack/world_sections.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>

using namespace frustumscreen;

namespace {

pack::PackDescription with_sections(std::string cells, std::string behaviours) {
    pack::PackDescription pack;
    pack.box_size = {1.0, 0.5, 0.8};
    pack.hotspots.resize(2);
    pack.sections = {{"cells", std::move(cells), {}}, {"behaviours", std::move(behaviours), {}}};
    return pack;
}

Result<pack::PackWorld> checked_world(const pack::PackDescription& pack) {
    TRY(pack::PackWorld world, pack::read_world_sections(pack));
    TRY_VOID(pack::check_cells(world.cells, pack));
    TRY_VOID(pack::check_behaviours(world, pack, pack::Curves::NotRead));
    return world;
}

void require_poses(const pack::PackWorld& world) {
    std::vector<world::Cell> cells;
    for (const pack::PackCell& packed : world.cells) {
        fuzz::require(!packed.cell.parent || *packed.cell.parent < cells.size(),
                      "a parent comes before its children");
        cells.push_back(packed.cell);
    }
    for (const world::CellPose& pose : world::poses_at_rest(cells)) {
        for (int column = 0; column < 4; ++column) {
            fuzz::require(fuzz::is_finite(pose.box_from_geometry[column]),
                          "a cell has a finite pose at rest");
        }
    }
}

void require_movers(const pack::PackWorld& world) {
    const auto is_there = [&](const auto& mover) { return mover.cell < world.cells.size(); };
    for (const pack::PackBehaviour& packed : world.behaviours) {
        const world::Behaviour& behaviour = packed.behaviour;
        fuzz::require(std::all_of(behaviour.channels.begin(), behaviour.channels.end(), is_there) &&
                          std::all_of(behaviour.springs.begin(), behaviour.springs.end(), is_there) &&
                          std::all_of(behaviour.pendulums.begin(), behaviour.pendulums.end(), is_there),
                      "what is moved is there");
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::text_of(data, size);
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string behaviours(text.substr(std::min(end + 1, text.size())));
    const auto world = checked_world(with_sections(std::string(text.substr(0, end)),
                                                   behaviours.empty() ? R"({"behaviours":[]})" : behaviours));
    if (!world) {
        fuzz::require_one_line(world.error().message);
        return 0;
    }
    require_poses(*world);
    require_movers(*world);
    const auto again =
        checked_world(with_sections(pack::write_cells(*world), pack::write_behaviours(world->behaviours)));
    fuzz::require(again.has_value(), "what was written is read",
                  again ? std::string() : again.error().message);
    fuzz::require(*again == *world, "a world written again is the same");
    return 0;
}
