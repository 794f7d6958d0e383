/// Reports changes of a folder's files, and of those in its subfolders: written and closed, renamed, removed.
///
/// Ignores hidden files, and files that editors keep only while they write. Folders behind links are watched
/// like subfolders; for a link to a file only the link itself is watched.
///
/// Errors   no such folder, too many watches; later: the folder itself is gone.
/// Threads  one caller. Never blocks.
/// Source   inotify(7).
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <map>
#include <set>
#include <string_view>

namespace frustumscreen::programs {

/// True if a file of this name is temporary, from an editor or a copy: `.x`, `x~`, `#x#`, `x.part123`, `4913`
/// and the like.
[[nodiscard]] bool is_passing_name(std::string_view name);

class FolderWatch {
public:
    [[nodiscard]] static Result<FolderWatch> open(const std::filesystem::path& folder);
    ~FolderWatch();
    FolderWatch(FolderWatch&& other) noexcept;
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;
    FolderWatch& operator=(FolderWatch&&) = delete;

    /// Readable if there are events.
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Takes all events; returns true if a relevant change was among them.
    [[nodiscard]] Result<bool> take();

private:
    FolderWatch(int descriptor, std::filesystem::path folder)
        : descriptor_(descriptor), folder_(std::move(folder)) {}
    /// Watches a folder and its subfolders.
    [[nodiscard]] Result<void> add(const std::filesystem::path& folder);
    /// `seen`: the kernel's numbers in this traversal; a link may lead back to its own folder.
    [[nodiscard]] Result<void> add(const std::filesystem::path& folder, std::set<int>& seen);

    int descriptor_;
    std::filesystem::path folder_;
    std::map<int, std::filesystem::path> watched_; ///< by the kernel's number
};

} // namespace frustumscreen::programs
