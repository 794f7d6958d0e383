#include "app/pack/pack_states.h"

#include "app/pack/check_pack.h"
#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "app/pack/pack_text.h"
#include "app/pack/pack_torches.h"
#include "app/pack/pack_world.h"
#include "app/pack/world_sections.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

namespace frustumscreen::pack {

namespace {

struct HiddenRecord {
    std::size_t cell = 0;
};
/// A state as in the file.
struct StateRecord {
    PackState state;
    std::vector<HiddenRecord> hidden;
};

void state_fields(auto& fields, auto& record) {
    auto& state = record.state;
    fields.text("name", state.name);
    fields.objects("titles", state.titles, max_languages, [](auto& item, auto& title) {
        item.text("language", title.language);
        item.text("text", title.text);
    });
    fields.objects("hidden", record.hidden, world::max_cells,
                   [](auto& item, auto& hidden) { item.whole("cell", hidden.cell, world::max_cells - 1); });
    fields.whole_or_null("behaviour", state.behaviour, world::max_behaviours - 1);
    fields.whole_or_null("layer", state.layer, max_layers - 1);
}

void states_fields(auto& fields, auto& records) {
    fields.objects("states", records, max_states,
                   [](auto& item, auto& record) { state_fields(item, record); });
}

Result<std::vector<PackState>> read_states(const PackSection& section) {
    Refusal refusal;
    const nlohmann::json data = parse_json(refusal, section.data);
    std::vector<StateRecord> records;
    if (!refusal.error) {
        JsonReader fields(refusal, &data, fmt::format("sections.{}.data", states_section));
        states_fields(fields, records);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    std::vector<PackState> states;
    for (StateRecord& record : records) {
        PackState& state = states.emplace_back(std::move(record.state));
        for (const HiddenRecord& hidden : record.hidden) {
            state.hidden.push_back(hidden.cell);
        }
    }
    return states;
}

std::string write_states(const std::vector<PackState>& states) {
    std::vector<StateRecord> records;
    for (const PackState& state : states) {
        StateRecord& record = records.emplace_back(StateRecord{state, {}});
        for (const std::size_t cell : state.hidden) {
            record.hidden.push_back({cell});
        }
    }
    JsonWriter fields;
    states_fields(fields, std::as_const(records));
    return nlohmann::json(fields.document()).dump(); // keys in order
}

/// `which`: "cell"; `index` of the `count` that the pack has.
Result<void> check_index(const std::string& place, std::string_view which, std::size_t index,
                         std::size_t count) {
    return index < count
               ? Result<void>()
               : bad_input("state_section.index", "{} names {} {}; the pack has {} of them, counted from 0",
                           place, which, index, count);
}

Result<void> check_state(const std::string& place, const PackState& state, const PackWorld& world,
                         std::size_t layers) {
    if (state.titles.empty()) {
        return bad_input("state_section.no_title",
                         "{} has no title; allowed is one for each language at most, and one at least",
                         place);
    }
    TRY_VOID(check_labels(place, state.titles));
    for (std::size_t k = 0; k < state.hidden.size(); ++k) {
        TRY_VOID(check_index(place, "cell", state.hidden[k], world.cells.size()));
        if (k > 0 && state.hidden[k] <= state.hidden[k - 1]) {
            return bad_input("state_section.hidden",
                             "{} hides cell {} after cell {}; allowed is each once, in ascending order",
                             place, state.hidden[k], state.hidden[k - 1]);
        }
    }
    if (state.behaviour) {
        TRY_VOID(check_index(place, "behaviour", *state.behaviour, world.behaviours.size()));
    }
    return state.layer ? check_index(place, "layer", *state.layer, layers) : Result<void>();
}

Result<void> check_states(const std::vector<PackState>& states, const PackDescription& pack) {
    if (states.size() > max_states) {
        return bad_input("state_section.count", "the pack has {} states; allowed are {}", states.size(),
                         max_states);
    }
    TRY(const PackWorld world, world_outline_of(pack));
    TRY(const PackTorches torches, torches_of(pack));
    std::set<std::string_view> names;
    for (std::size_t k = 0; k < states.size(); ++k) {
        const std::string& name = states[k].name;
        if (name.empty() || fault_of_text(name, TextShape::Line) || !names.insert(name).second) {
            return bad_input("state_section.name",
                             "state {} is called '{}'; allowed is one line, not empty, each name once", k,
                             printable(name, 40));
        }
        const std::string place = fmt::format("state '{}'", printable(name, 40));
        TRY_VOID(check_state(place, states[k], world, torches.layers.size()));
    }
    return {};
}

} // namespace

Result<std::vector<PackState>> states_of(const PackDescription& pack) {
    const PackSection* const section = find_section(pack, states_section);
    if (section == nullptr) {
        return std::vector<PackState>();
    }
    if (!section->parts.empty()) {
        return bad_input("state_section.parts", "the section {} has {} parts; allowed is none",
                         states_section, section->parts.size());
    }
    TRY(std::vector<PackState> states, read_states(*section));
    TRY_VOID(check_states(states, pack));
    return states;
}

Result<void> put_states(Pack& pack, std::vector<PackState> states) {
    assert(find_section(pack, states_section) == nullptr);
    if (states.empty()) {
        return {};
    }
    TRY_VOID(check_states(states, pack));
    pack.sections.push_back({std::string(states_section), write_states(states), {}});
    return {};
}

} // namespace frustumscreen::pack
