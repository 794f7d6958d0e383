#include "app/report/write_report.h"

#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace frustumscreen::report {

namespace {

constexpr std::uint64_t cluster_bytes = 64U << 10U; ///< the largest of FAT; a file takes whole ones
constexpr std::uint64_t margin_bytes = 1U << 20U;   ///< for the folder, and names in it
constexpr std::size_t piece_bytes = std::size_t{1} << 20U;
constexpr std::uint64_t bytes_between_syncs = 8U << 20U; ///< so that what is told as copied is on the stick
constexpr std::string_view next_name = "frustumscreen.part";

std::uint64_t in_clusters(std::uint64_t bytes) {
    return (bytes / cluster_bytes + 1) * cluster_bytes;
}

std::uint64_t bytes_on_stick(std::span<const ReportFile> files, const CopiedFiles& large) {
    std::uint64_t bytes = margin_bytes;
    for (const ReportFile& file : files) {
        bytes += in_clusters(file.text.size());
    }
    for (const CopiedFile& file : large.files) {
        bytes += in_clusters(file.bytes);
    }
    return bytes;
}

tl::unexpected<library::ImportFailure> failed(library::ImportRefusal refusal, std::string reason) {
    return tl::unexpected<library::ImportFailure>(
        library::ImportFailure{.refusal = refusal, .reason = std::move(reason), .whole = false});
}

tl::unexpected<library::ImportFailure> no_space_on_stick(std::uint64_t needed) {
    constexpr std::uint64_t bytes_per_mb = 1000000;
    return failed(library::ImportRefusal::NoRoom,
                  fmt::format("the stick is full; {} MB are needed on it: make room, or take another stick",
                              needed / bytes_per_mb + 1));
}

tl::unexpected<library::ImportFailure> stick_refuses(FileFault fault, std::uint64_t needed) {
    switch (fault.number) {
    case ENOSPC:
    case EDQUOT:
        return no_space_on_stick(needed);
    case EROFS:
    case EACCES:
    case EPERM:
        return failed(library::ImportRefusal::Unwritable,
                      "the stick cannot be written; take another one, with FAT32 or exFAT");
    default:
        return failed(
            library::ImportRefusal::Unreadable,
            fmt::format("the stick was pulled out or cannot be written ({}); put it in again, and if "
                        "this is said again, take another one",
                        std::strerror(fault.number)));
    }
}

FileResult<bool> is_empty(WritableTree& folder) {
    bool empty = true;
    TRY_VOID(folder.list("", [&](const FolderEntry&) {
        empty = false;
        return false;
    }));
    return empty;
}

FileResult<void> write_texts(WritableTree& folder, std::span<const ReportFile> files) {
    for (const ReportFile& file : files) {
        TRY_VOID(replace_text(folder, file.name, next_name, file.text));
    }
    return {};
}

library::ImportFailure disk_cannot_be_read(const CopiedFile& file, FileFault fault) {
    return {.refusal = library::ImportRefusal::Unwritable,
            .reason = fmt::format("{} cannot be read from the kiosk's disk ({}); call a technician",
                                  file.name, std::strerror(fault.number)),
            .whole = false};
}

tl::expected<void, library::ImportFailure> copy_file(WritableTree& folder, const CopiedFiles& large,
                                                     const CopiedFile& file, std::uint64_t needed) {
    const FileResult<std::unique_ptr<const FileContent>> from = large.from->open(file.source);
    if (!from) {
        return tl::unexpected<library::ImportFailure>(disk_cannot_be_read(file, from.error()));
    }
    const auto refused = [&](FileFault fault) { return stick_refuses(fault, needed); };
    const FileResult<std::unique_ptr<NewFile>> to = folder.create(std::string(next_name));
    if (!to) {
        return refused(to.error());
    }
    Bytes piece;
    for (std::uint64_t at = 0; at < (*from)->bytes(); at += piece.size()) {
        piece.resize(std::min<std::uint64_t>(piece_bytes, (*from)->bytes() - at));
        if (const int fault = (*from)->read(at, piece); fault != 0) {
            return tl::unexpected<library::ImportFailure>(disk_cannot_be_read(file, {fault}));
        }
        const bool is_to_sync = (at + piece.size()) % bytes_between_syncs == 0;
        const FileResult<void> written =
            (*to)->append(piece).and_then([&] { return is_to_sync ? (*to)->sync() : FileResult<void>(); });
        if (!written) {
            return refused(written.error());
        }
        large.copied(piece.size());
    }
    const FileResult<void> named =
        (*to)->sync().and_then([&] { return folder.rename(std::string(next_name), file.name); });
    return named ? tl::expected<void, library::ImportFailure>() : refused(named.error());
}

tl::expected<void, library::ImportFailure> write_all(WritableTree& folder, std::span<const ReportFile> files,
                                                     const CopiedFiles& large, std::uint64_t needed) {
    const auto refused = [&](FileFault fault) { return stick_refuses(fault, needed).value(); };
    TRY_VOID(write_texts(folder, files).map_error(refused));
    for (const CopiedFile& file : large.files) {
        TRY_VOID(copy_file(folder, large, file, needed));
    }
    return folder.sync_folder("").map_error(refused);
}

/// Frees the space on a full stick. It may fail, because the stick may be gone.
void take_back(WritableTree& folder, std::span<const ReportFile> files, const CopiedFiles& large) {
    static_cast<void>(folder.remove(std::string(next_name)));
    for (const ReportFile& file : files) {
        static_cast<void>(folder.remove(file.name));
    }
    for (const CopiedFile& file : large.files) {
        static_cast<void>(folder.remove(file.name));
    }
    static_cast<void>(folder.sync_folder(""));
}

} // namespace

tl::expected<void, library::ImportFailure>
write_report(WritableTree& folder, std::span<const ReportFile> files, const CopiedFiles& large) {
    const std::uint64_t needed = bytes_on_stick(files, large);
    const FileResult<bool> empty = is_empty(folder);
    const FileResult<std::uint64_t> free = folder.free_bytes();
    if (!empty || !free) {
        return stick_refuses(empty ? free.error() : empty.error(), needed);
    }
    if (!*empty) {
        return failed(library::ImportRefusal::Unwritable,
                      "the folder for the report has files in it; a report goes into an empty one");
    }
    if (*free < needed) {
        return no_space_on_stick(needed);
    }
    tl::expected<void, library::ImportFailure> written = write_all(folder, files, large, needed);
    if (!written) {
        take_back(folder, files, large);
    }
    return written;
}

} // namespace frustumscreen::report
