#include "app/show/library_files.h"

#include "app/library/library_folder.h"
#include "app/library/pack_signers.h"
#include "app/library/trusted_keys.h"
#include "firmware_host/base/disk_tree.h"
#include "firmware_host/base/file.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace frustumscreen::show {

namespace {

constexpr std::uintmax_t max_verdict_bytes = 64U << 10U;

} // namespace

std::optional<FileStamp> stamp_of_set(const std::filesystem::path& library) {
    struct stat file {};
    if (::stat((library / library::set_file_name).c_str(), &file) != 0) {
        return std::nullopt;
    }
    return FileStamp{.device = file.st_dev,
                     .inode = file.st_ino,
                     .bytes = static_cast<std::uint64_t>(file.st_size),
                     .changed_s = file.st_ctim.tv_sec,
                     .changed_ns = file.st_ctim.tv_nsec};
}

Result<std::optional<library::SetChoice>> read_choice(const std::filesystem::path& library) {
    if (!stamp_of_set(library)) {
        return std::optional<library::SetChoice>();
    }
    const std::filesystem::path path = library / library::set_file_name;
    TRY(const Bytes bytes, read_file(path, library::max_set_file_bytes));
    TRY(library::SetFile file, at(path.string(), library::parse_set_file(as_text(bytes))));
    return std::optional(std::move(file.choice));
}

std::optional<library::SetVerdict> read_verdict(const std::filesystem::path& library) {
    const Result<Bytes> bytes = read_file(library / library::verdict_file_name, max_verdict_bytes);
    const Result<library::SetVerdict> verdict =
        bytes ? library::parse_verdict(as_text(*bytes))
              : Result<library::SetVerdict>(tl::unexpected<Error>(bytes.error()));
    return verdict ? std::optional(*verdict) : std::nullopt;
}

Result<void> keep_verdict(const std::filesystem::path& library, const library::SetVerdict& verdict) {
    const std::filesystem::path path = library / library::verdict_file_name;
    std::error_code failed; // if this fails, write_file fails too and reports why
    std::filesystem::create_directories(path.parent_path(), failed);
    return write_file(path, as_bytes(library::write_verdict(verdict)));
}

std::string packs_of_ended_keys(const std::filesystem::path& library, const library::InstalledSet& set,
                                const settings::Settings& settings,
                                std::optional<std::chrono::sys_days> clock) {
    const Result<std::unique_ptr<WritableTree>> tree = open_tree(library);
    if (settings.exhibit.keys.empty() || set.packs.empty() || !tree) {
        return {};
    }
    const tl::expected<library::SetFile, library::ImportFailure> file = library::read_set_file(**tree);
    if (!file) {
        return {}; // reported elsewhere
    }
    return library::names_in_words(
        library::packs_of_ended_keys(**tree, set, library::trusted_keys(settings.exhibit.keys, file->keys),
                                     library::day_here(clock, file->latest_day)));
}

LibraryStart start_library(const std::filesystem::path& library, Trust trust) {
    LibraryStart start;
    Result<std::optional<library::SetChoice>> choice = read_choice(library);
    if (!choice) {
        start.trouble = choice.error().message;
        return start;
    }
    if (!*choice) {
        return start;
    }
    clear_partial_files(library / library::verdict_file_name);
    start.trial.emplace(std::move(**choice), read_verdict(library), trust);
    const Result<void> kept = keep_verdict(library, start.trial->verdict());
    start.trial->note_kept(kept.has_value());
    start.trouble = kept ? "" : kept.error().message;
    return start;
}

SetRequest request_of(const library::InstalledSet& set, const std::filesystem::path& library,
                      const settings::Settings& settings) {
    SetRequest request;
    request.number = set.number;
    if (set.packs.empty()) {
        request.packs = settings.exhibit.packs;
        request.packs_key = settings.exhibit.packs_key;
    }
    std::transform(set.packs.begin(), set.packs.end(), std::back_inserter(request.packs),
                   [&](const library::InstalledPack& pack) { return library / pack.file; });
    std::transform(set.attract.begin(), set.attract.end(), std::back_inserter(request.attract),
                   [](const library::AttractText& text) {
                       return AttractLine{text.language, text.text};
                   });
    return request;
}

std::string fault_of(const library::UnshownPacks& left_out, bool shows_nothing) {
    if (left_out && !left_out->empty()) {
        return fmt::format("{}: {}", left_out->front().pack, left_out->front().reason);
    }
    return shows_nothing ? "none of its artifacts can be shown" : "";
}

} // namespace frustumscreen::show
