#include "app/pack/key_folder.h"

#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen {

namespace {

constexpr std::uintmax_t most_file_bytes = 4096;

Result<std::vector<std::filesystem::path>> key_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code stop;
    std::filesystem::directory_iterator entry(folder, stop);
    for (; !stop && entry != std::filesystem::directory_iterator(); entry.increment(stop)) {
        const std::string name = entry->path().filename().string();
        if (!name.ends_with(".pub") || name.starts_with('.')) {
            continue;
        }
        if (files.size() == most_trusted_keys) {
            return bad_input(fmt::format("{}: it has more than {} public keys; take some away",
                                         folder.string(), most_trusted_keys));
        }
        files.push_back(entry->path());
    }
    if (stop) {
        return bad_input(
            fmt::format("{}: the folder of public keys cannot be read: {}", folder.string(), stop.message()));
    }
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

Result<PublicKey> read_public_key(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file, most_file_bytes);
    if (!bytes) {
        return tl::unexpected<Error>(bytes.error());
    }
    Result<PublicKey> key = parse_public_key(as_text(*bytes));
    if (!key) {
        return at(file.string(), key.error());
    }
    return key;
}

Result<std::vector<TrustedKey>> read_key_folder(const std::filesystem::path& folder) {
    const Result<std::vector<std::filesystem::path>> files = key_files(folder);
    if (!files) {
        return tl::unexpected<Error>(files.error());
    }
    std::vector<TrustedKey> keys;
    for (const std::filesystem::path& file : *files) {
        const Result<PublicKey> key = read_public_key(file);
        if (!key) {
            return tl::unexpected<Error>(key.error());
        }
        keys.push_back({file.stem().string(), *key, std::nullopt});
    }
    return keys;
}

} // namespace frustumscreen
