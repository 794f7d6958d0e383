#include "app/library/set_plan.h"

#include "firmware_host/base/letters_apart.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::library {

namespace {

tl::unexpected<ImportFailure> no_set(ImportRefusal refusal, std::string reason) {
    return tl::unexpected<ImportFailure>(
        ImportFailure{.refusal = refusal, .reason = std::move(reason), .whole = true, .by_set_file = true});
}

bool names(const std::vector<std::string>& ids, const std::string& id) {
    return !id.empty() && std::find(ids.begin(), ids.end(), id) != ids.end();
}

void put_in(std::vector<InstalledPack>& set, const InstalledPack& pack) {
    const auto same = std::find_if(set.begin(), set.end(),
                                   [&](const InstalledPack& each) { return is_same_artifact(each, pack); });
    if (same != set.end()) {
        *same = pack;
    } else {
        set.push_back(pack);
    }
}

tl::unexpected<ImportFailure> torn(const ImportedPack& refused) {
    return no_set(refused.refusal, fmt::format("{} is refused ({}), and with {} the stick is taken whole or "
                                               "not at all",
                                               refused.file, refused.reason, exhibit_file_name));
}

/// Refuses a set with a gap: a pack that is refused for any reason but that a newer one is there.
tl::expected<void, ImportFailure> check_packs(std::span<const StickPack> packs,
                                              std::span<const ImportedPack> unread, const ExhibitFile& file) {
    if (!unread.empty()) {
        return torn(unread.front());
    }
    for (const StickPack& each : packs) {
        const std::string name = printable(each.path);
        const bool is_older = each.told.refusal == ImportRefusal::Older && !each.clashes;
        if (each.told.outcome == ImportOutcome::Refused && !is_older) {
            return torn(each.told);
        }
        if (names(file.remove, each.pack.id)) {
            return no_set(ImportRefusal::NotAPack,
                          fmt::format("{} removes \"{}\", and {} on the same stick brings it; take one of "
                                      "the two away",
                                      exhibit_file_name, each.pack.id, name));
        }
        if (file.only && !names(file.order, each.pack.id)) {
            return no_set(ImportRefusal::NotAPack,
                          fmt::format("{} says only = true, and its order does not name {} (id \"{}\"); name "
                                      "it, or take it off the stick",
                                      exhibit_file_name, name, each.pack.id));
        }
    }
    return {};
}

/// ", or write the nearest id, vase"; empty: no id is near.
std::string nearest_id(const std::vector<InstalledPack>& packs, const std::string& id) {
    const auto apart = [&](const InstalledPack& pack) { return letters_apart(id, pack.id); };
    const auto nearest =
        std::min_element(packs.begin(), packs.end(),
                         [&](const InstalledPack& a, const InstalledPack& b) { return apart(a) < apart(b); });
    return nearest != packs.end() && !nearest->id.empty() && 3 * apart(*nearest) <= id.size()
               ? fmt::format(", or write the nearest id, {}", nearest->id)
               : std::string();
}

tl::expected<void, ImportFailure> apply(const ExhibitFile& file, PlannedSet& planned) {
    std::vector<InstalledPack>& packs = planned.set.packs;
    std::vector<InstalledPack> ordered;
    for (const std::string& id : file.order) {
        const auto found = std::find_if(packs.begin(), packs.end(),
                                        [&](const InstalledPack& each) { return each.id == id; });
        if (found == packs.end()) {
            return no_set(ImportRefusal::NotAPack,
                          fmt::format("{} names \"{}\", which is neither on the stick nor installed; put its "
                                      "pack on the stick{}",
                                      exhibit_file_name, id, nearest_id(packs, id)));
        }
        ordered.push_back(*found);
    }
    for (const InstalledPack& pack : packs) {
        if (names(file.order, pack.id)) {
            continue;
        }
        const bool goes = file.only || names(file.remove, pack.id);
        (goes ? planned.removed : ordered).push_back(pack);
    }
    packs = std::move(ordered);
    planned.set.attract = file.attract.value_or(planned.set.attract);
    return {};
}

} // namespace

tl::expected<PlannedSet, ImportFailure> plan_set(const InstalledSet& shown, std::span<const StickPack> packs,
                                                 std::span<const ImportedPack> unread,
                                                 const std::optional<ExhibitFile>& file) {
    PlannedSet planned{shown, {}};
    for (const StickPack& each : packs) {
        if (each.is_wanted()) {
            put_in(planned.set.packs, each.pack);
        }
    }
    if (file) {
        TRY_VOID(check_packs(packs, unread, *file));
        TRY_VOID(apply(*file, planned));
    }
    if (planned.set.packs.size() > max_installed_packs) {
        return no_set(ImportRefusal::TooMuch,
                      fmt::format("with this stick the exhibit would have {} packs; allowed are {}",
                                  planned.set.packs.size(), max_installed_packs));
    }
    return planned;
}

} // namespace frustumscreen::library
