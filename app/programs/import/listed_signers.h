/// The signers of the installed packs, as listed by frustumscreen-import --list.
///
/// Threads  one caller; each pack's file is opened.
#pragma once

#include "app/programs/import/listed_keys.h"
#include "firmware_host/base/file_tree.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct ListedSigner {
    bool is_signed = false;
    std::optional<std::string> id; ///< id of the key; none: the pack is unsigned, or its file cannot be read
    std::string name;              ///< empty: the kiosk does not know the key
    std::string until;             ///< last day of the key; empty: no end
    std::optional<bool> counts;    ///< none: not known, because the settings are not known
};

class SignerList {
public:
    /// `counting`: as trusted_keys.h.
    SignerList(const std::filesystem::path& library, const std::vector<ListedKey>& keys, bool knows_settings,
               std::vector<pack::TrustedKey> counting, std::optional<std::chrono::sys_days> today);
    [[nodiscard]] ListedSigner of(const library::InstalledPack& pack) const;

private:
    std::unique_ptr<FileTree> library_; ///< none: it cannot be opened
    const std::vector<ListedKey>& keys_;
    bool knows_settings_;
    std::vector<pack::TrustedKey> counting_;
    std::optional<std::chrono::sys_days> today_;
};

/// {id, name, counts}, or null.
[[nodiscard]] nlohmann::ordered_json json_of(const ListedSigner& signer);
/// "signed by second, which is no longer trusted"
[[nodiscard]] std::string text_of(const ListedSigner& signer);

} // namespace frustumscreen::programs
