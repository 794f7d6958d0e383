#include "app/library/pack_signers.h"

#include "app/pack/pack_reader.h"
#include "app/pack/signed_pack.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace frustumscreen::library {

std::optional<std::string> signing_key(FileTree& library, const InstalledPack& pack) {
    FileResult<std::unique_ptr<const FileContent>> content = library.open(pack.file);
    if (!content) {
        return std::nullopt;
    }
    Result<std::optional<pack::SignatureClaim>> claim =
        pack::PackReader::open(OpenFile(*std::move(content))).and_then([](pack::PackReader&& reader) {
            return pack::claim_of(reader);
        });
    return claim && *claim ? std::optional((*claim)->key_id) : std::nullopt;
}

bool counts_today(std::span<const pack::TrustedKey> counting, std::string_view key_id,
                  std::optional<std::chrono::sys_days> today) {
    return std::any_of(counting.begin(), counting.end(), [&](const pack::TrustedKey& each) {
        const bool has_ended = each.until && today && *today > *each.until;
        return pack::text_of_key_id(each.key.id) == key_id && !has_ended;
    });
}

std::vector<std::string> packs_of_ended_keys(FileTree& library, const InstalledSet& set,
                                             std::span<const pack::TrustedKey> counting,
                                             std::optional<std::chrono::sys_days> today) {
    std::vector<std::string> names;
    for (const InstalledPack& pack : set.packs) {
        if (const std::optional<std::string> key = signing_key(library, pack);
            key && !counts_today(counting, *key, today)) {
            names.push_back(printable(pack.id.empty() ? pack.title : pack.id, 100));
        }
    }
    return names;
}

std::string names_in_words(std::span<const std::string> names) {
    constexpr std::size_t most = 5;
    const std::string some = fmt::format("{}", fmt::join(names.first(std::min(names.size(), most)), ", "));
    return names.size() <= most ? some : fmt::format("{} and {} more", some, names.size() - most);
}

} // namespace frustumscreen::library
