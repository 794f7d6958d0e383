#include "app/library/kiosk_keys.h"

#include "app/library/trusted_keys.h"

#include <algorithm>

namespace frustumscreen::library {

void KioskKeys::read(const SetFile& known) {
    latest_day_ = known.latest_day;
    carried_ = known.keys;
    trusted_ = trusted_keys(request_.keys, carried_);
}

Result<void> KioskKeys::bring(std::span<const CarriedKey> brought, const pack::Signer& signer) {
    TRY(carried_, with_brought_keys(carried_, brought, signer, request_.keys, today()));
    trusted_ = trusted_keys(request_.keys, carried_);
    return {};
}

bool KioskKeys::some_end() const {
    return std::any_of(trusted_.begin(), trusted_.end(),
                       [](const pack::TrustedKey& key) { return key.until.has_value(); });
}

std::optional<std::chrono::sys_days> KioskKeys::today() const {
    return day_here(request_.today, latest_day_);
}

} // namespace frustumscreen::library
