#include "app/report/write_report.h"

#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

namespace frustumscreen::report {

namespace {

constexpr std::uint64_t cluster_bytes = 64U << 10U; ///< the largest of FAT; a file takes whole ones
constexpr std::uint64_t margin_bytes = 1U << 20U;   ///< for the folder, and names in it
constexpr std::string_view next_name = "frustumscreen.part";

std::uint64_t bytes_on_stick(std::span<const ReportFile> files) {
    std::uint64_t bytes = margin_bytes;
    for (const ReportFile& file : files) {
        bytes += (file.text.size() / cluster_bytes + 1) * cluster_bytes;
    }
    return bytes;
}

tl::unexpected<library::ImportFailure> failed(library::ImportRefusal refusal, std::string reason) {
    return tl::unexpected<library::ImportFailure>(
        library::ImportFailure{.refusal = refusal, .reason = std::move(reason), .whole = false});
}

tl::unexpected<library::ImportFailure> no_room_on_stick(std::uint64_t needed) {
    constexpr std::uint64_t bytes_per_mb = 1000000;
    return failed(
        library::ImportRefusal::NoRoom,
        fmt::format("the stick is full; the report needs {} MB on it: make room, or take another stick",
                    needed / bytes_per_mb + 1));
}

tl::unexpected<library::ImportFailure> stick_refuses(FileFault fault, std::uint64_t needed) {
    switch (fault.number) {
    case ENOSPC:
    case EDQUOT:
        return no_room_on_stick(needed);
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

FileResult<void> write_all(WritableTree& folder, std::span<const ReportFile> files) {
    for (const ReportFile& file : files) {
        TRY_VOID(replace_text(folder, file.name, next_name, file.text));
    }
    return folder.sync_folder("");
}

/// So that a full stick has its room again. It may fail: the stick may be gone.
void take_back(WritableTree& folder, std::span<const ReportFile> files) {
    static_cast<void>(folder.remove(std::string(next_name)));
    for (const ReportFile& file : files) {
        static_cast<void>(folder.remove(file.name));
    }
    static_cast<void>(folder.sync_folder(""));
}

} // namespace

tl::expected<void, library::ImportFailure> write_report(WritableTree& folder,
                                                        std::span<const ReportFile> files) {
    const std::uint64_t needed = bytes_on_stick(files);
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
        return no_room_on_stick(needed);
    }
    const FileResult<void> written = write_all(folder, files);
    if (!written) {
        take_back(folder, files);
        return stick_refuses(written.error(), needed);
    }
    return {};
}

} // namespace frustumscreen::report
