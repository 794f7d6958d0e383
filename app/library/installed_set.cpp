#include "app/library/installed_set.h"

#include "app/library/json_document.h"
#include "firmware_host/base/printable.h"

#include <limits>

namespace frustumscreen::library {

namespace {

constexpr std::size_t max_verdict_bytes = 64U << 10U;
constexpr std::size_t max_reason_bytes = 1000;
constexpr int max_counted_starts = 1000000;

void verdict_fields(auto& fields, auto& verdict) {
    fields.whole("number", verdict.number, std::numeric_limits<std::uint64_t>::max());
    fields.choice("verdict", verdict.state, trial_state_names);
    fields.whole("starts", verdict.starts, max_counted_starts);
    fields.text("reason", verdict.reason);
}

} // namespace

const InstalledSet& set_to_show(const SetChoice& choice, const std::optional<SetVerdict>& verdict) {
    if (!choice.last_good || !verdict || verdict->number != choice.set.number) {
        return choice.set;
    }
    const bool gave_up = verdict->state == TrialState::Trying && verdict->starts >= max_starts;
    return verdict->state == TrialState::Bad || gave_up ? *choice.last_good : choice.set;
}

Result<SetVerdict> parse_verdict(std::string_view json) {
    Result<SetVerdict> verdict =
        parse_document<SetVerdict>(json, "the verdict", max_verdict_bytes,
                                   [](auto& fields, auto& value) { verdict_fields(fields, value); });
    if (verdict) {
        verdict->reason = printable(verdict->reason, max_reason_bytes);
    }
    return verdict;
}

std::string write_verdict(const SetVerdict& verdict) {
    return write_document(verdict, [](auto& fields, auto& value) { verdict_fields(fields, value); });
}

} // namespace frustumscreen::library
