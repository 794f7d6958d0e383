#include "app/programs/import/listed_signers.h"

#include "app/library/pack_signers.h"
#include "firmware_host/base/disk_tree.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace frustumscreen::programs {

SignerList::SignerList(const std::filesystem::path& library, const std::vector<ListedKey>& keys,
                       bool knows_settings, std::vector<pack::TrustedKey> counting,
                       std::optional<std::chrono::sys_days> today)
    : keys_(keys), knows_settings_(knows_settings), counting_(std::move(counting)), today_(today) {
    if (Result<std::unique_ptr<WritableTree>> tree = open_tree(library)) {
        library_ = *std::move(tree);
    }
}

ListedSigner SignerList::of(const library::InstalledPack& pack) const {
    ListedSigner signer;
    signer.is_signed = pack.serial > 0;
    signer.id = library_ != nullptr ? library::signing_key(*library_, pack) : std::nullopt;
    if (!signer.id) {
        return signer;
    }
    const auto known =
        std::find_if(keys_.begin(), keys_.end(), [&](const ListedKey& key) { return key.id == *signer.id; });
    if (known != keys_.end()) {
        signer.name = known->name;
        signer.until = known->until;
    }
    if (knows_settings_) {
        signer.counts = library::counts_today(counting_, *signer.id, today_);
    }
    return signer;
}

nlohmann::ordered_json json_of(const ListedSigner& signer) {
    if (!signer.id) {
        return nullptr;
    }
    nlohmann::ordered_json json{{"id", *signer.id}, {"name", signer.name}};
    json["counts"] = signer.counts ? nlohmann::ordered_json(*signer.counts) : nlohmann::ordered_json(nullptr);
    return json;
}

std::string text_of(const ListedSigner& signer) {
    if (!signer.id) {
        return signer.is_signed ? "its file cannot be read" : "unsigned";
    }
    const std::string who =
        signer.name.empty() ? fmt::format("the key {}", *signer.id) : printable(signer.name, 100);
    if (signer.counts.value_or(true)) {
        return "signed by " + who;
    }
    return fmt::format("signed by {}, which is no longer trusted{}", who,
                       signer.until.empty() ? "" : fmt::format(" (until {})", signer.until));
}

} // namespace frustumscreen::programs
