#include "app/library/next_set_file.h"

#include "app/library/trusted_keys.h"

#include <algorithm>
#include <utility>

namespace frustumscreen::library {

void remember(SetFile& known, const std::vector<StickPack>& packs,
              const std::optional<SignedExhibitFile>& exhibit) {
    for (const StickPack& each : packs) {
        if (each.told.outcome != ImportOutcome::Taken || each.pack.serial == 0) {
            continue;
        }
        known.latest_day = latest_day(known.latest_day, signing_day(each.pack.serial));
        if (each.pack.id.empty()) {
            continue;
        }
        const auto place =
            std::find_if(known.serials.begin(), known.serials.end(),
                         [&](const AcceptedSerial& serial) { return serial.id == each.pack.id; });
        if (place == known.serials.end()) {
            known.serials.push_back({each.pack.id, each.pack.serial});
        } else {
            place->serial = std::max(place->serial, each.pack.serial);
        }
    }
    if (exhibit && exhibit->signer) {
        known.exhibit_serial = exhibit->serial();
        known.exhibit_sha256 = exhibit->sha256;
        known.latest_day = latest_day(known.latest_day, signing_day(exhibit->serial()));
    }
}

InstalledSet set_to_go_back_to(const SetChoice& choice, const std::optional<SetVerdict>& verdict) {
    const bool is_judged = verdict && verdict->number == choice.set.number;
    if (is_judged && verdict->state == TrialState::Good) {
        return choice.set;
    }
    if (choice.last_good) {
        return *choice.last_good;
    }
    return is_judged && verdict->state == TrialState::Bad ? InstalledSet() : choice.set;
}

bool is_judged(const SetFile& known, const std::optional<SetVerdict>& verdict, TrialState as) {
    return verdict && verdict->number == known.choice.set.number && verdict->state == as;
}

void replace_set(SetFile& known, InstalledSet set, const std::optional<SetVerdict>& verdict) {
    // A bad set is not shown; a set on its last trial still is.
    InstalledSet before =
        is_judged(known, verdict, TrialState::Bad) ? set_to_show(known.choice, verdict) : known.choice.set;
    set.number = std::max(known.choice.set.number, verdict ? verdict->number : 0) + 1;
    known.choice.last_good = set_to_go_back_to(known.choice, verdict);
    known.before = std::move(before);
    known.choice.set = std::move(set);
}

} // namespace frustumscreen::library
