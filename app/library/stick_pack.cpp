#include "app/library/stick_pack.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace frustumscreen::library {

namespace {

void be_there_already(StickPack& pack, std::string reason) {
    pack.told.outcome = ImportOutcome::AlreadyThere;
    pack.told.reason = std::move(reason);
}

/// Removes the name, which the line already has: "exhibit.toml:2: is wrong" becomes "line 2: is wrong".
std::string without_name(const std::string& reason, const std::string& name) {
    if (!reason.starts_with(name + ":")) {
        return reason;
    }
    const std::string rest = reason.substr(name.size() + 1);
    return rest.starts_with(' ') ? rest.substr(1) : "line " + rest;
}

/// Refuses a pack that contradicts another one, and so the set that it belongs to: it is unknown which of the two is
/// meant.
void clash(StickPack& pack, std::string_view other) {
    pack.clashes = true;
    refuse(pack.told,
           {.refusal = ImportRefusal::Older,
            .reason = fmt::format(
                "it has the same id and the same serial {} as {}, and other contents; sign it again "
                "with a higher serial",
                pack.pack.serial, other),
            .whole = false});
}

const InstalledPack* find_same(const InstalledSet& set, const InstalledPack& pack) {
    const auto same = std::find_if(set.packs.begin(), set.packs.end(),
                                   [&](const InstalledPack& each) { return is_same_artifact(each, pack); });
    return same != set.packs.end() ? &*same : nullptr;
}

std::uint64_t highest_serial(const SetFile& known, const std::string& id) {
    const auto accepted = std::find_if(known.serials.begin(), known.serials.end(),
                                       [&](const AcceptedSerial& each) { return each.id == id; });
    return accepted != known.serials.end() && !id.empty() ? accepted->serial : 0;
}

bool holds_the_same(const InstalledPack& a, const InstalledPack& b) {
    return a.serial == b.serial && a.manifest_sha256 == b.manifest_sha256;
}

void weigh(StickPack& candidate, const InstalledSet& shown, const SetFile& known, const IsSound& is_sound) {
    const InstalledPack& pack = candidate.pack;
    const InstalledPack* installed = find_same(shown, pack);
    if (installed != nullptr && holds_the_same(*installed, pack)) {
        if (is_sound(*installed)) {
            be_there_already(candidate, "");
        } else {
            candidate.mends = true;
            candidate.told.reason = "its file on the kiosk's disk was damaged or gone, and is replaced";
        }
        return;
    }
    const std::uint64_t highest = highest_serial(known, pack.id);
    if (pack.serial < highest) {
        refuse(candidate.told,
               {.refusal = ImportRefusal::Older,
                .reason = candidate.is_signed
                              ? fmt::format("it is older (serial {}) than one that was taken before (serial "
                                            "{}); sign it again to go back to it",
                                            pack.serial, highest)
                              : "it is unsigned, and a signed one of the same id was taken before; sign it",
                .whole = false});
    } else if (installed != nullptr && pack.serial > 0 && installed->serial == pack.serial) {
        clash(candidate, "the one that is installed");
    }
}

} // namespace

void refuse(ImportedPack& told, const ImportFailure& failure) {
    told.outcome = ImportOutcome::Refused;
    told.refusal = failure.refusal;
    told.reason = without_name(failure.reason, told.file);
}

ImportedPack removed_line(const InstalledPack& pack) {
    return {.file = printable(pack.id.empty() ? pack.file : pack.id),
            .title = printable(pack.title),
            .outcome = ImportOutcome::Removed,
            .refusal = ImportRefusal::None,
            .reason = "the set file removes it"};
}

bool is_same_artifact(const InstalledPack& a, const InstalledPack& b) {
    return a.id == b.id && (!a.id.empty() || a.manifest_sha256 == b.manifest_sha256);
}

void weigh_packs(std::vector<StickPack>& packs, const InstalledSet& shown, const SetFile& known,
                 const IsSound& is_sound) {
    for (StickPack& pack : packs) {
        if (pack.told.outcome == ImportOutcome::Pending) {
            weigh(pack, shown, known, is_sound);
        }
    }
}

std::vector<std::size_t> copy_order(const std::vector<StickPack>& packs) {
    std::vector<std::size_t> order(packs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return packs[a].pack.serial > packs[b].pack.serial;
    });
    return order;
}

void weigh_against_taken(StickPack& pack, const std::vector<StickPack>& packs) {
    const auto taken = std::find_if(packs.begin(), packs.end(), [&](const StickPack& other) {
        return other.told.outcome == ImportOutcome::Taken && is_same_artifact(other.pack, pack.pack);
    });
    if (taken == packs.end()) {
        return;
    }
    const std::string name = printable(taken->path);
    if (holds_the_same(taken->pack, pack.pack)) {
        pack.is_double = true;
        be_there_already(pack, fmt::format("it is the same as {} on this stick", name));
        return;
    }
    if (taken->pack.serial == pack.pack.serial) {
        clash(pack, fmt::format("{} on this stick", name));
        return;
    }
    refuse(pack.told,
           {.refusal = ImportRefusal::Older,
            .reason = fmt::format(
                "{} on this stick has the same id and is newer (serial {} against {}), so that one "
                "is taken",
                name, taken->pack.serial, pack.pack.serial),
            .whole = false});
}

void refuse_all(std::vector<StickPack>& packs, const ImportFailure& failure) {
    for (StickPack& pack : packs) {
        if (pack.is_wanted() || pack.is_double) {
            refuse(pack.told, failure);
        }
    }
}

} // namespace frustumscreen::library
