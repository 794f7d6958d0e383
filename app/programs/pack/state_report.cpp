#include "app/programs/pack/state_report.h"

#include "app/pack/pack_states.h"
#include "app/pack/pack_torches.h"
#include "app/pack/pack_world.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace frustumscreen::programs {

namespace {

using Json = nlohmann::ordered_json;

/// A state with names in place of indices.
struct NamedState {
    pack::PackState state;
    std::vector<std::string> hidden;
    std::string behaviour, layer; ///< empty: none
};

std::vector<NamedState> named_states(const pack::PackDescription& pack) {
    std::vector<NamedState> named;
    const pack::PackWorld world = pack::world_outline_of(pack).value_or(pack::PackWorld());
    const pack::PackTorches torches = pack::torches_of(pack).value_or(pack::PackTorches());
    for (pack::PackState& state : pack::states_of(pack).value_or(std::vector<pack::PackState>())) {
        NamedState& made = named.emplace_back();
        for (const std::size_t cell : state.hidden) {
            made.hidden.push_back(world.cells[cell].cell.name);
        }
        made.behaviour = state.behaviour ? world.behaviours[*state.behaviour].behaviour.name : std::string();
        made.layer = state.layer ? torches.layers[*state.layer].name : std::string();
        made.state = std::move(state);
    }
    return named;
}

} // namespace

Json states_json(const pack::PackDescription& pack) {
    const auto name_or_null = [](const std::string& name) {
        return name.empty() ? Json(nullptr) : Json(name);
    };
    Json json = Json::array();
    for (const NamedState& each : named_states(pack)) {
        Json titles = Json::object();
        for (const pack::PackLabel& title : each.state.titles) {
            titles[title.language] = title.text;
        }
        json.push_back({{"name", each.state.name},
                        {"hidden", each.hidden},
                        {"behaviour", name_or_null(each.behaviour)},
                        {"layer", name_or_null(each.layer)},
                        {"titles", std::move(titles)}});
    }
    return json;
}

std::string states_text(const pack::PackDescription& pack) {
    std::string text;
    for (const NamedState& each : named_states(pack)) {
        text += fmt::format("  state {}:", each.state.name);
        text += each.hidden.empty() ? "" : fmt::format(" without {};", fmt::join(each.hidden, ", "));
        text += each.behaviour.empty() ? "" : fmt::format(" at the end of {};", each.behaviour);
        text += each.layer.empty() ? "" : fmt::format(" in {};", each.layer);
        for (std::size_t k = 0; k < each.state.titles.size(); ++k) {
            text += fmt::format("{} {}: {}", k > 0 ? ";" : "", each.state.titles[k].language,
                                each.state.titles[k].text);
        }
        text += "\n";
    }
    return text;
}

} // namespace frustumscreen::programs
