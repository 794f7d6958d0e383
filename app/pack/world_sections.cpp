#include "app/pack/world_sections.h"

#include "app/pack/container/limits.h"
#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace frustumscreen::pack {

namespace {

/// The first three rows of an affine matrix, column by column.
using Affine = std::array<double, 12>;

/// A cell as in the file.
struct CellRecord {
    std::string name;
    std::optional<std::size_t> parent;
    Affine parent_from_base{};
    glm::dvec3 translation{0.0};
    std::array<double, 4> rotation{}; ///< x, y, z, w
    glm::dvec3 scale{1.0};
    Affine cell_from_geometry{};
    std::string part;
    std::uint64_t triangles = 0;
    glm::dvec3 low{0.0}, high{0.0};
};

Affine affine_of(const glm::dmat4& matrix) {
    Affine numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        numbers[k] = matrix[static_cast<glm::length_t>(k / 3)][static_cast<glm::length_t>(k % 3)];
    }
    return numbers;
}

glm::dmat4 matrix_of(const Affine& numbers) {
    glm::dmat4 matrix(1.0);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        matrix[static_cast<glm::length_t>(k / 3)][static_cast<glm::length_t>(k % 3)] = numbers[k];
    }
    return matrix;
}

CellRecord record_of(const PackCell& packed) {
    const world::Cell& cell = packed.cell;
    const glm::dquat& rotation = cell.rest.rotation;
    return {.name = cell.name,
            .parent = cell.parent,
            .parent_from_base = affine_of(cell.parent_from_base),
            .translation = cell.rest.translation,
            .rotation = {rotation.x, rotation.y, rotation.z, rotation.w},
            .scale = cell.rest.scale,
            .cell_from_geometry = affine_of(cell.cell_from_geometry),
            .part = packed.part,
            .triangles = packed.triangles,
            .low = packed.low,
            .high = packed.high};
}

PackCell cell_of(const CellRecord& record) {
    const auto& [x, y, z, w] = record.rotation;
    world::Cell cell;
    cell.name = record.name;
    cell.parent = record.parent;
    cell.parent_from_base = matrix_of(record.parent_from_base);
    cell.rest = {record.translation, glm::dquat(w, x, y, z), record.scale};
    cell.cell_from_geometry = matrix_of(record.cell_from_geometry);
    cell.has_geometry = !record.part.empty();
    return {.cell = std::move(cell),
            .part = record.part,
            .triangles = record.triangles,
            .low = record.low,
            .high = record.high};
}

void vector_field(auto& fields, const char* name, auto& vector) {
    fields.numbers(name, std::span(glm::value_ptr(vector), 3));
}

void cell_fields(auto& fields, auto& cell) {
    fields.text("name", cell.name);
    fields.whole_or_null("parent", cell.parent, world::max_cells - 1);
    fields.numbers("parent_from_base", std::span(cell.parent_from_base));
    vector_field(fields, "translation", cell.translation);
    fields.numbers("rotation", std::span(cell.rotation));
    vector_field(fields, "scale", cell.scale);
    fields.numbers("cell_from_geometry", std::span(cell.cell_from_geometry));
    fields.text("part", cell.part);
    fields.whole("triangles", cell.triangles, std::numeric_limits<std::uint64_t>::max());
    vector_field(fields, "low", cell.low);
    vector_field(fields, "high", cell.high);
}

void cells_fields(auto& fields, auto& cells, auto& drawn_at_rest) {
    fields.objects("cells", cells, world::max_cells, [](auto& item, auto& cell) { cell_fields(item, cell); });
    fields.flag_or("drawn_at_rest", drawn_at_rest, false);
}

void target_field(auto& fields, auto& mover) {
    fields.whole("cell", mover.cell, world::max_cells - 1);
}

void spring_fields(auto& fields, auto& spring) {
    target_field(fields, spring);
    fields.flag("turns", spring.turns);
    vector_field(fields, "axis", spring.axis);
    fields.number("reach", spring.reach);
    fields.number("stiffness_per_s2", spring.stiffness_per_s2);
    fields.number("damping_per_s", spring.damping_per_s);
}

void pendulum_fields(auto& fields, auto& pendulum) {
    target_field(fields, pendulum);
    vector_field(fields, "axis", pendulum.axis);
    fields.number("angle_rad", pendulum.angle_rad);
    fields.number("length_m", pendulum.length_m);
    fields.number("damping_per_s", pendulum.damping_per_s);
}

void behaviour_fields(auto& fields, auto& packed) {
    auto& behaviour = packed.behaviour;
    fields.text("name", behaviour.name);
    fields.choice("trigger", behaviour.trigger, world::trigger_names);
    fields.whole("hotspot", behaviour.hotspot, max_hotspots);
    fields.number("narration_s", behaviour.narration_s);
    fields.number("seconds", behaviour.seconds);
    fields.flag("repeats", behaviour.repeats);
    fields.flag("stays", behaviour.stays);
    fields.objects("titles", packed.titles, max_languages, [](auto& item, auto& title) {
        item.text("language", title.language);
        item.text("text", title.text);
    });
    fields.objects("channels", behaviour.channels, world::max_channels, [](auto& item, auto& channel) {
        target_field(item, channel);
        item.choice("path", channel.path, path_names);
    });
    fields.objects("springs", behaviour.springs, world::max_cells,
                   [](auto& item, auto& spring) { spring_fields(item, spring); });
    fields.objects("pendulums", behaviour.pendulums, world::max_cells,
                   [](auto& item, auto& pendulum) { pendulum_fields(item, pendulum); });
}

void behaviours_fields(auto& fields, auto& behaviours) {
    fields.objects("behaviours", behaviours, world::max_behaviours,
                   [](auto& item, auto& behaviour) { behaviour_fields(item, behaviour); });
}

/// Calls read(fields) with the section's fields; does nothing without the section.
template <typename Read>
Result<void> read_section(std::string_view name, const PackDescription& pack, const Read& read) {
    const PackSection* const section = find_section(pack, name);
    if (section == nullptr) {
        return {};
    }
    Refusal refusal;
    const nlohmann::json data = parse_json(refusal, section->data);
    if (!refusal.error) {
        JsonReader fields(refusal, &data, fmt::format("sections.{}.data", name));
        read(fields);
        fields.finish();
    }
    return refusal.error ? Result<void>(tl::unexpected<Error>(*std::move(refusal.error))) : Result<void>();
}

std::string text_of(const JsonWriter& fields) {
    return nlohmann::json(fields.document()).dump(); // keys in order
}

} // namespace

const PackSection* find_section(const PackDescription& pack, std::string_view name) {
    const auto found = std::find_if(pack.sections.begin(), pack.sections.end(),
                                    [name](const PackSection& section) { return section.name == name; });
    return found != pack.sections.end() ? &*found : nullptr;
}

Result<PackWorld> read_world_sections(const PackDescription& pack) {
    std::vector<CellRecord> records;
    PackWorld world;
    TRY_VOID(read_section(cells_section, pack,
                          [&](JsonReader& fields) { cells_fields(fields, records, world.drawn_at_rest); }));
    std::transform(records.begin(), records.end(), std::back_inserter(world.cells), cell_of);
    TRY_VOID(read_section(behaviours_section, pack,
                          [&](JsonReader& fields) { behaviours_fields(fields, world.behaviours); }));
    return world;
}

std::string write_cells(const PackWorld& world) {
    std::vector<CellRecord> records;
    std::transform(world.cells.begin(), world.cells.end(), std::back_inserter(records), record_of);
    JsonWriter fields;
    cells_fields(fields, std::as_const(records), world.drawn_at_rest);
    return text_of(fields);
}

std::string write_behaviours(const std::vector<PackBehaviour>& behaviours) {
    JsonWriter fields;
    behaviours_fields(fields, behaviours);
    return text_of(fields);
}

} // namespace frustumscreen::pack
