#include "app/library/stick_walk.h"

#include "app/library/exhibit_file.h"
#include "app/library/report_request.h"
#include "app/library/stick_pack.h"
#include "app/library/stick_settings.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace frustumscreen::library {

namespace {

constexpr std::string_view pack_ending = ".fspack";
/// In small letters.
constexpr auto system_names =
    std::to_array<std::string_view>({"$recycle.bin", "recycler", "recycled", "system volume information",
                                     "lost+found", "found.000", "__macosx"});

std::string in_small_letters(std::string_view name) {
    std::string small(name);
    for (char& letter : small) {
        letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    return small;
}

/// True if a name is nearly STEM.toml. For "exhibit": exhibit.toml.txt, Exhibit.toml, exhibit (1).toml, and their
/// signatures.
bool looks_like(std::string_view stem, std::string_view name) {
    const std::string small = in_small_letters(name);
    return small.starts_with(stem) && small.find(".toml") != std::string::npos;
}

/// True of "kiosk (1).fsk" and "kiosk.fsk.txt", and of nothing that is called as it should be.
bool looks_like_copy(std::string_view name) {
    return in_small_letters(name).find(".fsk") != std::string::npos &&
           name != fmt::format("{}.minisig", kiosk_copy_name);
}

/// Keeps the first by name.
void keep_first(std::string& kept, const std::string& path) {
    kept = kept.empty() || path < kept ? path : kept;
}

class Walk {
public:
    Walk(FileTree& stick, const ImportLimits& limits, const std::function<bool()>& too_late)
        : stick_(stick), limits_(limits), too_late_(too_late) {}

    tl::expected<StickFiles, ImportFailure> all();

private:
    void look_at(const std::string& folder, const FolderEntry& entry);
    bool visit(const std::string& folder, const FolderEntry& entry);
    void look_into(const std::string& folder);
    void refuse(const std::string& path, const ImportFailure& failure);

    FileTree& stick_;
    const ImportLimits& limits_;
    const std::function<bool()>& too_late_;
    StickFiles found_;
    std::vector<std::string> folders_;
    std::string misnamed_; ///< path; empty: none
    std::string misnamed_settings_;
    std::string misnamed_request_;
    std::string misnamed_copy_request_;
    std::string misnamed_copy_;
    bool has_settings_ = false;
    bool has_copy_request_ = false;
    bool has_copy_ = false;
    bool has_request_ = false;
    std::size_t entries_ = 0;
    std::optional<ImportFailure> failure_;
};

void Walk::refuse(const std::string& path, const ImportFailure& failure) {
    frustumscreen::library::refuse(
        found_.refused.emplace_back(
            ImportedPack{.file = printable(path), .title = {}, .outcome = {}, .refusal = {}, .reason = {}}),
        failure);
}

void Walk::look_at(const std::string& folder, const FolderEntry& entry) {
    const std::string path = folder.empty() ? entry.name : folder + "/" + entry.name;
    if (entry.kind == EntryKind::Folder) {
        if (folder.empty()) {
            folders_.push_back(entry.name);
        }
    } else if (in_small_letters(entry.name).ends_with(pack_ending)) {
        if (entry.kind == EntryKind::File) {
            found_.packs.push_back(path);
        } else {
            refuse(path, {.refusal = ImportRefusal::NotAPack,
                          .reason = "it is a link or a device, not a file; put the pack itself on the stick",
                          .whole = false});
        }
    } else if (folder.empty() && entry.name == exhibit_file_name) {
        found_.has_exhibit_file = true;
    } else if (folder.empty() && entry.name == settings_file_name) {
        has_settings_ = true;
    } else if (folder.empty() && entry.name == report_request_name) {
        has_request_ = true;
    } else if (folder.empty() && entry.name == copy_request_name) {
        has_copy_request_ = true;
    } else if (folder.empty() && entry.name == kiosk_copy_name) {
        has_copy_ = true;
    } else if (looks_like("exhibit", entry.name)) {
        keep_first(misnamed_, path);
    } else if (looks_like("kiosk", entry.name)) {
        keep_first(misnamed_settings_, path);
    } else if (looks_like("frustumscreen-report", entry.name)) {
        keep_first(misnamed_request_, path);
    } else if (looks_like("frustumscreen-request", entry.name) && entry.name != copy_request_signature) {
        keep_first(misnamed_copy_request_, path);
    } else if (folder.empty() && looks_like_copy(entry.name)) { // a kiosk writes copies into folders
        keep_first(misnamed_copy_, path);
    }
}

/// Returns false to end the listing.
bool Walk::visit(const std::string& folder, const FolderEntry& entry) {
    ++entries_;
    if (too_late_()) {
        failure_ = too_slow();
    } else if (!is_ignored(entry.name)) {
        look_at(folder, entry);
    }
    if (entries_ > limits_.max_entries) {
        failure_ = too_much(fmt::format("the stick holds more than {} files; put the packs on a stick of "
                                        "their own",
                                        limits_.max_entries));
    } else if (folders_.size() > limits_.max_folders) {
        failure_ = too_much(
            fmt::format("the stick holds more than {} folders; put the packs on a stick of their own",
                        limits_.max_folders));
    } else if (found_.packs.size() + found_.refused.size() > limits_.max_packs) {
        failure_ =
            too_much(fmt::format("the stick holds more than {} packs; put fewer on it", limits_.max_packs));
    }
    return !failure_;
}

void Walk::look_into(const std::string& folder) {
    const FileResult<void> listed =
        stick_.list(folder, [&](const FolderEntry& entry) { return visit(folder, entry); });
    if (listed || failure_) {
        return;
    }
    ImportFailure failure = stick_failure(folder, listed.error());
    if (failure.whole) {
        failure_ = std::move(failure);
    } else {
        refuse(folder, failure);
    }
}

tl::expected<StickFiles, ImportFailure> Walk::all() {
    look_into("");
    std::sort(folders_.begin(), folders_.end());
    for (std::size_t k = 0; k < folders_.size() && !failure_; ++k) {
        look_into(folders_[k]);
    }
    if (failure_) {
        return tl::unexpected<ImportFailure>(*failure_);
    }
    std::sort(found_.packs.begin(), found_.packs.end());
    if (!misnamed_.empty() && !found_.has_exhibit_file) {
        found_.misnamed = {.file = printable(misnamed_),
                           .title = "",
                           .outcome = ImportOutcome::Refused,
                           .refusal = ImportRefusal::NotAPack,
                           .reason =
                               fmt::format("it is ignored; a set file is called {}, with its signature {} "
                                           "beside it, and both lie in the stick's root",
                                           exhibit_file_name, exhibit_signature_name)};
    }
    if (!misnamed_settings_.empty() && !has_settings_) {
        found_.misnamed_settings = {
            .file = printable(misnamed_settings_),
            .title = "",
            .outcome = ImportOutcome::Refused,
            .refusal = ImportRefusal::NotAPack,
            .reason =
                fmt::format("it is ignored; a kiosk's settings are called {} and lie in the stick's root: "
                            "rename it, and check that no .txt is hidden after the name",
                            settings_file_name)};
    }
    if (!misnamed_request_.empty() && !has_request_) {
        found_.misnamed_request = {
            .file = printable(misnamed_request_),
            .title = "",
            .outcome = ImportOutcome::Refused,
            .refusal = ImportRefusal::NotAPack,
            .reason =
                fmt::format("no report was written; the file that asks for one is called {} and lies in the "
                            "stick's root: rename it, and check that no .txt is hidden after the name",
                            report_request_name)};
    }
    if (!misnamed_copy_request_.empty() && !has_copy_request_) {
        found_.misnamed_copy.push_back(
            {.file = printable(misnamed_copy_request_),
             .title = "",
             .outcome = ImportOutcome::Refused,
             .refusal = ImportRefusal::NotAPack,
             .reason = fmt::format(
                 "nothing was written; a request is called {} and lies in the stick's root, with its "
                 "signature {} beside it",
                 copy_request_name, copy_request_signature)});
    }
    if (!misnamed_copy_.empty() && !has_copy_) {
        found_.misnamed_copy.push_back(
            {.file = printable(misnamed_copy_),
             .title = "",
             .outcome = ImportOutcome::Refused,
             .refusal = ImportRefusal::NotAPack,
             .reason =
                 fmt::format("it is ignored; the copy of a kiosk is called {}, with its signature {}.minisig "
                             "beside it, and both lie in the stick's root",
                             kiosk_copy_name, kiosk_copy_name)});
    }
    return std::move(found_);
}

} // namespace

bool is_ignored(std::string_view name) {
    return name.starts_with('.') ||
           std::find(system_names.begin(), system_names.end(), in_small_letters(name)) != system_names.end();
}

tl::expected<StickFiles, ImportFailure> walk_stick(FileTree& stick, const ImportLimits& limits,
                                                   const std::function<bool()>& too_late) {
    return Walk(stick, limits, too_late).all();
}

} // namespace frustumscreen::library
