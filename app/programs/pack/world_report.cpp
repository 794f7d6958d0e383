#include "app/programs/pack/world_report.h"

#include "app/pack/pack_world.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

struct CellBox {
    glm::dvec3 low{0.0}, high{0.0};
};

pack::PackWorld known_world(const pack::PackDescription& pack) {
    return pack::world_outline_of(pack).value_or(pack::PackWorld());
}

/// Box units. A cell without geometry has the box of its children.
std::vector<std::optional<CellBox>> boxes_of(const std::vector<pack::PackCell>& cells) {
    std::vector<std::optional<CellBox>> boxes(cells.size());
    for (std::size_t k = cells.size(); k-- > 0;) { // children come after their parents
        if (cells[k].cell.has_geometry) {
            boxes[k] = CellBox{cells[k].low, cells[k].high};
        }
        const std::optional<std::size_t>& parent = cells[k].cell.parent;
        if (!boxes[k] || !parent || cells[*parent].cell.has_geometry) {
            continue;
        }
        std::optional<CellBox>& around = boxes[*parent];
        around = around
                     ? CellBox{glm::min(around->low, boxes[k]->low), glm::max(around->high, boxes[k]->high)}
                     : *boxes[k];
    }
    return boxes;
}

Json corner_json(const glm::dvec3& corner) {
    return Json::array({corner.x, corner.y, corner.z});
}

std::string_view name_of(world::Trigger trigger) {
    return world::trigger_names.at(static_cast<std::size_t>(trigger));
}

} // namespace

Json cells_json(const pack::PackDescription& pack, double metres_per_box) {
    const std::vector<pack::PackCell> cells = known_world(pack).cells;
    const std::vector<std::optional<CellBox>> boxes = boxes_of(cells);
    Json json = Json::array();
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const std::optional<std::size_t>& parent = cells[k].cell.parent;
        json.push_back({{"name", cells[k].cell.name},
                        {"parent", parent ? Json(cells[*parent].cell.name) : Json(nullptr)},
                        {"triangles", cells[k].triangles},
                        {"box", boxes[k] ? Json::array({corner_json(boxes[k]->low * metres_per_box),
                                                        corner_json(boxes[k]->high * metres_per_box)})
                                         : Json(nullptr)}});
    }
    return json;
}

Json behaviours_json(const pack::PackDescription& pack) {
    Json json = Json::array();
    for (const pack::PackBehaviour& packed : known_world(pack).behaviours) {
        json.push_back({{"name", packed.behaviour.name},
                        {"seconds", packed.behaviour.seconds},
                        {"trigger", name_of(packed.behaviour.trigger)}});
    }
    return json;
}

std::string world_text(const pack::PackDescription& pack, double mm_per_box) {
    const pack::PackWorld world = known_world(pack);
    const std::vector<std::optional<CellBox>> boxes = boxes_of(world.cells);
    std::string text;
    for (std::size_t k = 0; k < world.cells.size(); ++k) {
        const world::Cell& cell = world.cells[k].cell;
        const glm::dvec3 size = boxes[k] ? (boxes[k]->high - boxes[k]->low) * mm_per_box : glm::dvec3(0.0);
        text += fmt::format("  cell {}{}: {} triangles, {:.1f} x {:.1f} x {:.1f} mm\n", cell.name,
                            cell.parent ? ", on " + world.cells[*cell.parent].cell.name : "",
                            world.cells[k].triangles, size.x, size.y, size.z);
    }
    text += world.drawn_at_rest
                ? "  the cells are drawn at rest, too: together they are quicker than the whole\n"
                : "";
    for (const pack::PackBehaviour& packed : world.behaviours) {
        text += fmt::format("  behaviour {}: {:.3g} s, trigger {}", packed.behaviour.name,
                            packed.behaviour.seconds, name_of(packed.behaviour.trigger));
        for (const pack::PackLabel& title : packed.titles) {
            text += fmt::format("; {}: {}", title.language, title.text);
        }
        text += "\n";
    }
    return text;
}

} // namespace frustumscreen::programs
