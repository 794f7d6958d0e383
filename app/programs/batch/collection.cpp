#include "app/programs/batch/collection.h"

#include "app/pack/container/sha256.h"
#include "assets_baked/folder/artifact_file.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/folder_entries.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <system_error>

namespace frustumscreen::programs {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> scan_endings{".glb", ".gltf", ".obj", ".ply", ".stl"};
constexpr std::size_t max_shards = 100'000;

bool is_scan(const fs::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(scan_endings.begin(), scan_endings.end(), ending) != scan_endings.end();
}

void add(const fs::directory_entry& entry, Collection& collection) {
    std::error_code none;
    const fs::path name = entry.path().filename();
    if (entry.is_directory(none)) {
        if (fs::exists(entry.path() / folder::artifact_file_name, none)) {
            collection.objects.push_back({name.string(), entry.path(), {}});
        } else {
            collection.skipped.push_back(name.string());
        }
    } else if (entry.is_regular_file(none) && is_scan(name)) {
        collection.objects.push_back({name.stem().string(), entry.path(), {}});
    }
}

/// Refuses objects with equal names, because their packs would replace each other.
void refuse_twins(std::vector<BatchObject>& objects) {
    for (std::size_t k = 1; k < objects.size(); ++k) {
        const BatchObject& first = objects[k - 1];
        if (objects[k].name == first.name) {
            objects[k].fault =
                fmt::format("{} and {} would have the same pack, {}.fspack; rename one of them",
                            printable(first.input.filename().string()),
                            printable(objects[k].input.filename().string()), printable(first.name));
        }
    }
}

/// Refuses objects whose page would have the name of the batch's own report.
void refuse_reports(std::vector<BatchObject>& objects) {
    for (BatchObject& object : objects) {
        if (object.name == "report" || object.name.starts_with("report.")) {
            object.fault = fmt::format("{}: the batch's own reports have this name; rename it",
                                       printable(object.input.filename().string()));
        }
    }
}

std::optional<std::size_t> whole_number(std::string_view text) {
    std::size_t value = 0;
    const std::from_chars_result read = std::from_chars(text.data(), text.data() + text.size(), value);
    return read.ec == std::errc() && read.ptr == text.data() + text.size() ? std::optional(value)
                                                                           : std::nullopt;
}

} // namespace

Result<Collection> list_collection(const fs::path& folder, const fs::path& output) {
    Collection collection;
    const FolderEntries listed = entries_of(folder);
    for (const fs::directory_entry& entry : listed) {
        std::error_code none;
        const bool is_hidden = entry.path().filename().string().starts_with('.');
        if (!is_hidden && !fs::equivalent(entry.path(), output, none)) {
            add(entry, collection);
        }
    }
    if (listed.failed) {
        return bad_input("batch.unreadable_folder",
                         "{}: cannot be read as a folder of objects: {}; name the folder in which they "
                         "lie",
                         folder.string(), listed.failed.message());
    }
    std::sort(collection.objects.begin(), collection.objects.end(), [](const auto& a, const auto& b) {
        return std::pair(a.name, a.input.string()) < std::pair(b.name, b.input.string());
    });
    std::sort(collection.skipped.begin(), collection.skipped.end());
    refuse_twins(collection.objects);
    refuse_reports(collection.objects);
    return collection;
}

Result<Shard> parse_shard(std::string_view text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto number = whole_number(text.substr(0, slash));
    const auto of = whole_number(text.substr(std::min(slash + 1, text.size())));
    if (!number || !of || *number < 1 || *number > *of || *of > max_shards) {
        return fail(ErrorKind::BadConfiguration, "batch.shard",
                    "--shard '{}': allowed are 1/N to N/N, such as 3/8 for the third of eight, N at most {}",
                    printable(text, 40), max_shards);
    }
    return Shard{*number, *of};
}

std::vector<BatchObject> share_of(std::span<const BatchObject> objects, const Shard& shard) {
    constexpr std::size_t digits = 8;
    std::vector<BatchObject> share;
    for (const BatchObject& object : objects) {
        const std::string hash = pack::sha256_hex(as_bytes(object.name)).substr(0, digits);
        if (std::stoul(hash, nullptr, 16) % shard.of == shard.number - 1) {
            share.push_back(object);
        }
    }
    return share;
}

} // namespace frustumscreen::programs
