#include "assets_baked/folder/artifact_states.h"

#include "app/pack/pack_text.h"
#include "app/world/cell.h"
#include "assets_baked/folder/artifact_labels.h"
#include "assets_baked/folder/artifact_path.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::folder {

namespace {

/// A name of the folder's file or of the model.
void read_name(settings::TableReader& table, std::string_view key, std::string& name) {
    table.any_text(key, name);
    if (const std::optional<std::string> fault = pack::fault_of_text(name, pack::TextShape::Line)) {
        table.refuse("state_file.name", key, *fault);
    }
    name = std::string(trimmed(name));
}

} // namespace

void read_state(settings::TableReader& table, ArtifactState& state,
                const std::vector<ArtifactState>& before) {
    read_name(table, "name", state.name);
    table.texts("hide", state.hide, world::max_cells);
    read_name(table, "behaviour", state.behaviour);
    ArtifactTorchStage layer;
    if (table.has("layer")) {
        read_layer(table, layer);
    } else {
        std::filesystem::path none;
        read_path(table, "layer", none); // so that the key is known
    }
    table.flag("lit", layer.lit, {});
    read_labels(table, "titles", state.titles);
    table.finish(); // a misspelt key is reported before a missing one
    if (table.has("layer")) {
        state.layer = std::move(layer);
    }
    state.place = table.place("name");
    table.require("state_file.no_name", !state.name.empty(), "name",
                  "is missing or empty; every [[states]] has a name of its own");
    const bool is_second = std::any_of(before.begin(), before.end(), [&](const ArtifactState& each) {
        return &each != &state && each.name == state.name;
    });
    table.require(
        "state_file.name_twice", !is_second, "name",
        fmt::format("is \"{}\" a second time; allowed is each name once", printable(state.name, 40)));
    table.require("state_file.no_title", !state.titles.empty(), "titles",
                  "has no text; write what visitors read under the window, one for each language, { en = "
                  "\"As found\" }");
    table.require("state_file.lit", table.has("layer") || !table.has("lit"), "lit",
                  "stands without layer; the artifact's own colours are always lit as it is");
}

} // namespace frustumscreen::folder
