#include "app/programs/batch/content_hash.h"

#include "app/pack/container/sha256.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace frustumscreen::programs {

namespace {

namespace fs = std::filesystem;

struct NamedFile {
    std::string name; ///< relative to the folder
    fs::path path;
};

/// Sorted by name, bytewise.
Result<std::vector<NamedFile>> files_of(const fs::path& folder) {
    std::vector<NamedFile> files;
    std::error_code error;
    constexpr int max_depth = 16; // a link may lead back to its own folder
    fs::recursive_directory_iterator entries(folder, fs::directory_options::follow_directory_symlink, error);
    for (; !error && entries != fs::recursive_directory_iterator(); entries.increment(error)) {
        std::error_code none;
        if (entries->path().filename().string().starts_with('.') || entries.depth() >= max_depth) {
            entries.disable_recursion_pending();
        } else if (entries->is_regular_file(none)) {
            files.push_back({entries->path().lexically_relative(folder).string(), entries->path()});
        }
    }
    if (error) {
        return bad_input("batch.unreadable_object", "{}: cannot be read: {}", folder.string(),
                         error.message());
    }
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return files;
}

} // namespace

Result<std::string> hash_of_file(const fs::path& file) {
    pack::Sha256 hash;
    std::ifstream stream(file, std::ios::binary);
    std::vector<char> block(1U << 20U);
    while (stream) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        hash.add(as_bytes({block.data(), static_cast<std::size_t>(stream.gcount())}));
    }
    if (!stream.eof()) {
        return bad_input("batch.unreadable_file", "{}: cannot be read: {}", file.string(),
                         std::strerror(errno));
    }
    return hash.hex();
}

std::string hash_of_texts(std::span<const std::string> texts) {
    std::string all;
    for (const std::string& text : texts) {
        all += fmt::format("{}:{},", text.size(), text);
    }
    return pack::sha256_hex(as_bytes(all));
}

Result<std::string> hash_of_object(const fs::path& input) {
    std::error_code none;
    if (!fs::is_directory(input, none)) {
        return hash_of_file(input);
    }
    TRY(const std::vector<NamedFile> files, files_of(input));
    std::vector<std::string> texts;
    for (const NamedFile& file : files) {
        TRY(std::string hash, hash_of_file(file.path));
        texts.push_back(file.name);
        texts.push_back(std::move(hash));
    }
    return hash_of_texts(texts);
}

} // namespace frustumscreen::programs
