#include "app/library/library_folder.h"

#include "app/pack/container/sha256.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/tree_text.h"

#include <algorithm>
#include <cerrno>
#include <set>
#include <string>
#include <vector>

namespace frustumscreen::library {

namespace {

constexpr std::size_t max_verdict_bytes = 64U << 10U;
constexpr std::string_view pack_ending = ".fspack";

void note_files(const InstalledSet& set, std::set<std::string>& named) {
    for (const InstalledPack& pack : set.packs) {
        named.insert(pack.file);
    }
}

/// True for the importer's own files: others in the folder are left alone.
bool is_pack_of_ours(std::string_view name) {
    return name.ends_with(pack_ending) && is_sha256_text(name.substr(0, name.size() - pack_ending.size()));
}

} // namespace

tl::expected<SetFile, ImportFailure> read_set_file(FileTree& library) {
    const FileResult<std::string> text = read_text(library, set_file_name, max_set_file_bytes);
    if (!text) {
        return text.error().number == ENOENT
                   ? tl::expected<SetFile, ImportFailure>()
                   : tl::unexpected<ImportFailure>(disk_failure(set_file_name, text.error()));
    }
    Result<SetFile> file = parse_set_file(*text);
    if (!file) {
        return tl::unexpected<ImportFailure>(ImportFailure{
            .refusal = ImportRefusal::Unwritable,
            .reason = std::string(set_file_name) + " on the kiosk's disk: " + file.error().message +
                      "; call a technician, who removes it and puts all packs in again",
            .whole = true});
    }
    return *std::move(file);
}

tl::expected<std::optional<SetVerdict>, ImportFailure> read_verdict(FileTree& library) {
    const FileResult<std::string> text = read_text(library, verdict_file_name, max_verdict_bytes);
    if (!text && text.error().number != ENOENT) {
        return tl::unexpected<ImportFailure>(disk_failure(verdict_file_name, text.error()));
    }
    const Result<SetVerdict> verdict = parse_verdict(text.value_or(""));
    return verdict ? std::optional(*verdict) : std::nullopt;
}

bool is_sound(FileTree& library, const InstalledPack& pack, std::size_t step_bytes) {
    const FileResult<std::unique_ptr<const FileContent>> file = library.open(pack.file);
    if (!file || (*file)->bytes() != pack.bytes) {
        return false;
    }
    Bytes step(std::min<std::uint64_t>(step_bytes, pack.bytes));
    pack::Sha256 hash;
    for (std::uint64_t at = 0; at < pack.bytes; at += step.size()) {
        step.resize(std::min<std::uint64_t>(step.size(), pack.bytes - at));
        if ((*file)->read(at, step) != 0) {
            return false;
        }
        hash.add(step);
    }
    return hash.hex() == pack.sha256;
}

FileResult<void> settle(WritableTree& library) {
    // The writer of set.txt may have been stopped before its name was on the disk. Nothing may be removed before it
    // is.
    return library.make_folder(std::string(packs_folder_name)).and_then([&] {
        return library.sync_folder("");
    });
}

FileResult<void> switch_to(WritableTree& library, const SetFile& file) {
    return replace_text(library, set_file_name, next_set_file_name, write_set_file(file)).and_then([&] {
        return library.sync_folder("");
    });
}

void clear_away(WritableTree& library, const SetFile& file) {
    std::set<std::string> named;
    note_files(file.choice.set, named);
    note_files(file.choice.last_good.value_or(InstalledSet()), named);
    note_files(file.before.value_or(InstalledSet()), named);
    const std::string folder(packs_folder_name);
    std::vector<std::string> unnamed;
    const FileResult<void> listed = library.list(folder, [&](const FolderEntry& entry) {
        const std::string path = folder + "/" + entry.name;
        if (path == incoming_file_name || (is_pack_of_ours(entry.name) && !named.contains(path))) {
            unnamed.push_back(path);
        }
        return true;
    });
    if (listed) {
        for (const std::string& path : unnamed) {
            static_cast<void>(library.remove(path));
        }
    }
}

} // namespace frustumscreen::library
