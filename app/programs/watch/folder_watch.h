/// Tells when a file of a folder, or of a folder in it, has changed: written and closed, renamed, removed.
///
/// Files that editors keep only while they write, and hidden ones, do not count. Folders that links lead to are watched as if they
/// lay there; of a file that a link leads to, only the link is.
///
/// Errors   no such folder, too many watches; later: the folder itself is gone.
/// Threads  one caller. Nothing blocks.
/// Source   inotify(7).
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <map>
#include <set>
#include <string_view>

namespace frustumscreen {

/// Whether a file of this name comes and goes with an editor or a copy: `.x`, `x~`, `#x#`, `x.part123`, `4913` and the like.
[[nodiscard]] bool is_passing_name(std::string_view name);

class FolderWatch {
public:
    [[nodiscard]] static Result<FolderWatch> open(const std::filesystem::path& folder);
    ~FolderWatch();
    FolderWatch(FolderWatch&& other) noexcept;
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;
    FolderWatch& operator=(FolderWatch&&) = delete;

    /// Readable when there is something to take.
    [[nodiscard]] int descriptor() const { return descriptor_; }
    /// Takes all that was told; whether something changed that counts.
    [[nodiscard]] Result<bool> take();

private:
    FolderWatch(int descriptor, std::filesystem::path folder)
        : descriptor_(descriptor), folder_(std::move(folder)) {}
    /// Of a folder and those in it.
    [[nodiscard]] Result<void> add(const std::filesystem::path& folder);
    /// `seen`: the kernel's numbers in this walk; a link may lead back to where it lies.
    [[nodiscard]] Result<void> add(const std::filesystem::path& folder, std::set<int>& seen);

    int descriptor_;
    std::filesystem::path folder_;
    std::map<int, std::filesystem::path> watched_; ///< by the kernel's number
};

} // namespace frustumscreen
