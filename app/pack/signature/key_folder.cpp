#include "app/pack/signature/key_folder.h"

#include "firmware_host/base/file.h"
#include "firmware_host/base/folder_entries.h"

#include <fmt/format.h>

namespace frustumscreen::pack {

namespace {

constexpr std::uintmax_t max_file_bytes = 4096;

Result<std::vector<std::filesystem::path>> key_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    const FolderEntries listed = entries_of(folder);
    if (listed.failed) {
        return bad_input("keys.unreadable_folder", "{}: the folder of public keys cannot be read: {}",
                         folder.string(), listed.failed.message());
    }
    for (const std::filesystem::directory_entry& entry : listed) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".pub") || name.starts_with('.')) {
            continue;
        }
        if (files.size() == max_trusted_keys) {
            return bad_input("keys.too_many", "{}: it has more than {} public keys; remove some",
                             folder.string(), max_trusted_keys);
        }
        files.push_back(entry.path());
    }
    return files;
}

} // namespace

Result<PublicKey> read_public_key(const std::filesystem::path& file) {
    TRY(const Bytes bytes, read_file(file, max_file_bytes));
    return at(file.string(), parse_public_key(as_text(bytes)));
}

Result<std::vector<TrustedKey>> read_key_folder(const std::filesystem::path& folder) {
    TRY(const std::vector<std::filesystem::path> files, key_files(folder));
    std::vector<TrustedKey> keys;
    for (const std::filesystem::path& file : files) {
        TRY(const PublicKey key, read_public_key(file));
        keys.push_back({file.stem().string(), key, std::nullopt});
    }
    return keys;
}

} // namespace frustumscreen::pack
