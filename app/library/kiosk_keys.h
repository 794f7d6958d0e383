/// The keys that a kiosk trusts during an import: those of its settings and set.txt, and those that the stick's set
/// file brings. trusted_keys.h has the rules.
///
/// Threads  one caller.
#pragma once

#include "app/library/import_stick.h"
#include "app/library/set_file.h"
#include "app/pack/signed_pack.h"

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::library {

class KioskKeys {
public:
    /// `request` must outlive the keys.
    explicit KioskKeys(const ImportRequest& request) : request_(request) {}

    /// Takes the keys and the latest day of set.txt.
    void read(const SetFile& known);
    /// Adds the keys that a set file of this signer brings. Errors, one sentence: with_brought_keys.
    [[nodiscard]] Result<void> bring(std::span<const CarriedKey> brought, const pack::Signer& signer);

    /// True if a trusted key has a last day.
    [[nodiscard]] bool some_end() const;
    /// The keys that a signature is checked against today; valid until the keys change.
    [[nodiscard]] pack::PackTrust trust() const { return {trusted_, today(), request_.unsigned_packs}; }
    /// The keys to write into the next set.txt.
    [[nodiscard]] const std::vector<CarriedKey>& carried() const { return carried_; }

private:
    [[nodiscard]] std::optional<std::chrono::sys_days> today() const;

    const ImportRequest& request_;
    std::string latest_day_;
    std::vector<CarriedKey> carried_; ///< including those that the set file brings
    std::vector<pack::TrustedKey> trusted_;
};

} // namespace frustumscreen::library
