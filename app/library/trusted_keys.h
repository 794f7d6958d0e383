/// Whom the kiosk believes: the keys of its settings, and those that signed sets brought.
///
/// Chain    a key that was brought counts while the one that signed for it counts, and had not ended on the day on which it came.
///          What the settings name needs nobody, and they alone say when it ends. So a key that is taken out of the settings, or
///          whose last day is set before another one came, takes that one with it; one that merely grew old does not.
/// Days     no clock is believed that goes back: the latest day that was seen counts, be it the clock's or that of a signature. A
///          day that is more than ten years beyond is not remembered, since a clock that jumps must not end keys for ever.
/// Threads  pure; any.
#pragma once

#include "app/library/set_file.h"
#include "app/pack/signature/signature.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen {

/// Those of the settings, then those of `carried` that count.
[[nodiscard]] std::vector<TrustedKey> trusted_keys(std::span<const TrustedKey> settings,
                                                   std::span<const CarriedKey> carried);

/// `carried` with the keys that a set file brought, `signer` signed and was taken on `day`. A key that is there gets the new name,
/// end and signer. Errors, one sentence: a key that would vouch for itself.
[[nodiscard]] Result<std::vector<CarriedKey>>
with_brought_keys(std::vector<CarriedKey> carried, std::span<const CarriedKey> brought, const Signer& signer,
                  std::span<const TrustedKey> settings, std::optional<std::chrono::sys_days> day);

/// On which it was signed, if the serial is a time as frustumscreen-pack and minisign give it.
[[nodiscard]] std::optional<std::chrono::sys_days> signing_day(std::uint64_t serial);
/// The latest day, as set.txt has it, once `day` was seen too.
[[nodiscard]] std::string latest_day(const std::string& latest, std::optional<std::chrono::sys_days> day);
/// What the kiosk takes for today; none: there is no clock, and no key ends.
[[nodiscard]] std::optional<std::chrono::sys_days> day_here(std::optional<std::chrono::sys_days> clock,
                                                            const std::string& latest);

} // namespace frustumscreen
