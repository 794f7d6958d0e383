/// The keys that the kiosk trusts: those of its settings, and those that signed sets brought.
///
/// Chain    a carried key counts if its signer counts, and if the signer had not expired on the day the key came.
///          The keys of the settings need no signer, and the settings alone say when they expire. So removing a key
///          from the settings, or setting its last day before a carried key came, removes that carried key too; a
///          key that merely expires does not.
/// Days     a clock that goes back is not trusted: the latest day seen counts, whether from the clock or from a
///          signature. A day more than ten years later is not recorded, because a clock that jumps must not expire
///          keys for ever.
/// Threads  pure; any.
#pragma once

#include "app/library/set_file.h"
#include "app/pack/signature/signature.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::library {

/// The keys of the settings, then those of `carried` that count.
[[nodiscard]] std::vector<pack::TrustedKey> trusted_keys(std::span<const pack::TrustedKey> settings,
                                                         std::span<const CarriedKey> carried);

/// `carried` with the keys that a set file brought; `signer` signed the file, and it was taken on `day`. A known
/// key gets the new name, last day and signer. Errors, one sentence: a key that would vouch for itself.
[[nodiscard]] Result<std::vector<CarriedKey>> with_brought_keys(std::vector<CarriedKey> carried,
                                                                std::span<const CarriedKey> brought,
                                                                const pack::Signer& signer,
                                                                std::span<const pack::TrustedKey> settings,
                                                                std::optional<std::chrono::sys_days> day);

/// The day of signing, if the serial is a time, as frustumscreen-pack and minisign write it.
[[nodiscard]] std::optional<std::chrono::sys_days> signing_day(std::uint64_t serial);
/// The latest day, as in set.txt, once `day` has been seen too.
[[nodiscard]] std::string latest_day(const std::string& latest, std::optional<std::chrono::sys_days> day);
/// The day that the kiosk takes as today; none: there is no clock, and no key expires.
[[nodiscard]] std::optional<std::chrono::sys_days> day_here(std::optional<std::chrono::sys_days> clock,
                                                            const std::string& latest);

} // namespace frustumscreen::library
