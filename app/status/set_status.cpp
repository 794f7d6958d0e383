#include "app/status/set_status.h"

#include <fmt/format.h>

namespace frustumscreen::status {

namespace {

std::string verdict_of(const SetStatus& status) {
    const library::SetVerdict& newest = status.newest;
    if (newest.state == library::TrialState::Bad) {
        return fmt::format("; set {} is bad: {}", newest.number, newest.reason);
    }
    if (newest.number != status.shown) {
        return fmt::format("; set {} comes", newest.number);
    }
    return newest.state == library::TrialState::Good ? ", good" : status.on_trial ? ", on trial" : "";
}

} // namespace

std::string sentence_of(const SetStatus& status) {
    std::string sentence = status.shown == 0
                               ? "the packs of the settings are shown"
                               : fmt::format("set {} is shown, {} pack{}", status.shown, status.packs.size(),
                                             status.packs.size() == 1 ? "" : "s");
    if (status.newest.number != 0) {
        sentence += verdict_of(status);
    }
    return status.trouble.empty() ? sentence : sentence + "; " + status.trouble;
}

} // namespace frustumscreen::status
