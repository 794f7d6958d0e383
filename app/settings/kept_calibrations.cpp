#include "app/settings/kept_calibrations.h"

#include "firmware_host/base/tree_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>

namespace frustumscreen::settings {

namespace {

constexpr std::string_view head = "calibration-", kept_ending = ".toml", undone_ending = ".undone";
constexpr const char* next_name = "calibration.next";

std::string name_of(int number, std::string_view ending) {
    return fmt::format("{}{:04}{}", head, number, ending);
}

std::optional<int> number_of(std::string_view name, std::string_view ending) {
    if (!name.starts_with(head) || !name.ends_with(ending)) {
        return std::nullopt;
    }
    name.remove_prefix(head.size());
    name.remove_suffix(std::min(ending.size(), name.size()));
    int number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    const bool whole = error == std::errc() && end == name.data() + name.size() && number > 0;
    return whole ? std::optional(number) : std::nullopt;
}

tl::unexpected<Error> failed(std::string_view name, const FileFault& fault, std::string_view what) {
    return fail(ErrorKind::BadInput, "kept.folder", "the folder of calibrations, {}: {}: {}", name, what,
                std::strerror(fault.number));
}

/// The files with this ending, the newest first.
Result<std::vector<KeptCalibration>> list(FileTree& folder, std::string_view ending) {
    std::vector<KeptCalibration> found;
    const FileResult<void> listed = folder.list("", [&](const FolderEntry& entry) {
        if (const std::optional<int> number = number_of(entry.name, ending);
            number && entry.kind == EntryKind::File) {
            found.push_back({*number, entry.name});
        }
        return true;
    });
    if (!listed) {
        return failed("all", listed.error(), "cannot be listed");
    }
    std::sort(found.begin(), found.end(),
              [](const KeptCalibration& a, const KeptCalibration& b) { return a.number > b.number; });
    return found;
}

} // namespace

Result<std::vector<KeptCalibration>> list_calibrations(FileTree& folder) {
    return list(folder, kept_ending);
}

Result<Calibration> read_calibration(FileTree& folder, const KeptCalibration& kept) {
    const FileResult<std::string> text = read_text(folder, kept.name, largest_calibration_bytes);
    if (!text) {
        return failed(kept.name, text.error(), "cannot be read");
    }
    return parse_calibration(*text, kept.name);
}

Result<KeptCalibration> keep_calibration(WritableTree& folder, const Calibration& calibration) {
    TRY(const std::vector<KeptCalibration> kept, list_calibrations(folder));
    TRY(const std::vector<KeptCalibration> undone, list(folder, undone_ending));
    int newest = 0;
    for (const auto* each : {&kept, &undone}) {
        newest = each->empty() ? newest : std::max(newest, each->front().number);
    }
    KeptCalibration next{newest + 1, name_of(newest + 1, kept_ending)};
    const FileResult<void> written =
        replace_text(folder, next.name, next_name, calibration_text(calibration)).and_then([&] {
            return folder.sync_folder("");
        });
    if (!written) {
        return failed(next.name, written.error(), "cannot be written");
    }
    // The new one is on the disk: a file that cannot be removed does no harm, and is removed with the next one.
    for (std::size_t k = max_kept_calibrations - 1; k < kept.size(); ++k) {
        static_cast<void>(folder.remove(kept[k].name));
    }
    for (const KeptCalibration& each : undone) {
        static_cast<void>(folder.remove(each.name));
    }
    return next;
}

Result<KeptCalibration> undo_calibration(WritableTree& folder) {
    TRY(const std::vector<KeptCalibration> kept, list_calibrations(folder));
    if (kept.empty()) {
        return fail(ErrorKind::BadInput, "kept.nothing_to_undo",
                    "there is no calibration to undo; the set-up is as the settings describe it");
    }
    const KeptCalibration& newest = kept.front();
    const FileResult<void> gone =
        folder.rename(newest.name, name_of(newest.number, undone_ending)).and_then([&] {
            return folder.sync_folder("");
        });
    if (!gone) {
        return failed(newest.name, gone.error(), "cannot be undone");
    }
    return newest;
}

} // namespace frustumscreen::settings
