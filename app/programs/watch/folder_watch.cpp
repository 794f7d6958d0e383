#include "app/programs/watch/folder_watch.h"

#include "firmware_host/base/folder_entries.h"

#include <fmt/format.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <system_error>
#include <utility>

namespace frustumscreen::programs {

namespace {

constexpr std::uint32_t changes =
    IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE | IN_CREATE | IN_DELETE_SELF | IN_MOVE_SELF;

/// A new file counts once it is written and closed; a new folder counts at once.
bool counts(const inotify_event& event, std::string_view name) {
    const bool is_only_begun = (event.mask & IN_CREATE) != 0 && (event.mask & IN_ISDIR) == 0;
    return !name.empty() && !is_only_begun && !is_passing_name(name);
}

} // namespace

bool is_passing_name(std::string_view name) {
    const std::size_t part = name.rfind(".part");
    const bool is_partial = part != std::string_view::npos &&
                            std::all_of(name.begin() + static_cast<std::ptrdiff_t>(part) + 5, name.end(),
                                        [](char c) { return c >= '0' && c <= '9'; });
    return name.starts_with('.') || name.starts_with('#') || name.ends_with('~') || name.ends_with(".swp") ||
           // Vim creates 4913 to test whether it may write.
           name.ends_with(".tmp") || name == "4913" || is_partial;
}

Result<FolderWatch> FolderWatch::open(const std::filesystem::path& folder) {
    FolderWatch watch(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC), folder);
    if (watch.descriptor_ < 0) {
        return fail(ErrorKind::Internal, "watch.no_watches",
                    "{}: cannot be watched: {}; end other programs that watch "
                    "folders",
                    folder.string(), std::strerror(errno));
    }
    TRY_VOID(watch.add(folder));
    return watch;
}

FolderWatch::~FolderWatch() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

FolderWatch::FolderWatch(FolderWatch&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), folder_(std::move(other.folder_)),
      watched_(std::move(other.watched_)) {}

Result<void> FolderWatch::add(const std::filesystem::path& folder) {
    std::set<int> seen;
    return add(folder, seen);
}

Result<void> FolderWatch::add(const std::filesystem::path& folder, std::set<int>& seen) {
    const int number = ::inotify_add_watch(descriptor_, folder.c_str(), changes | IN_ONLYDIR);
    if (number < 0 && !watched_.empty() && (errno == ENOENT || errno == ENOTDIR || errno == ELOOP)) {
        return {}; // it is already gone, which causes another event, or a link without a folder
    }
    if (number < 0) {
        return bad_input("watch.folder", "{}: cannot be watched: {}", folder.string(), std::strerror(errno));
    }
    if (!seen.insert(number).second) {
        return {};
    }
    watched_[number] = folder;
    for (const std::filesystem::directory_entry& entry : entries_of(folder)) {
        std::error_code none;
        if (entry.is_directory(none) && !is_passing_name(entry.path().filename().string())) {
            TRY_VOID(add(entry.path(), seen));
        }
    }
    return {};
}

Result<bool> FolderWatch::take() {
    bool changed = false;
    alignas(inotify_event) std::array<char, 16384> block{};
    for (ssize_t size = 0; (size = ::read(descriptor_, block.data(), block.size())) > 0;) {
        for (std::size_t at = 0; at < static_cast<std::size_t>(size);) {
            const auto& event = *reinterpret_cast<const inotify_event*>(block.data() + at);
            const std::string_view name(event.len > 0 ? block.data() + at + sizeof(event) : "");
            at += sizeof(event) + event.len;
            const auto place = watched_.find(event.wd);
            const bool is_itself = (event.mask & (IN_DELETE_SELF | IN_MOVE_SELF)) != 0;
            if (is_itself && place != watched_.end() && place->second == folder_) {
                return bad_input("watch.folder_gone", "{}: this folder is gone; it was watched until now",
                                 folder_.string());
            }
            const bool is_new = (event.mask & (IN_CREATE | IN_MOVED_TO)) != 0;
            std::error_code none;
            const bool is_new_link = is_new && place != watched_.end() && !is_passing_name(name) &&
                                     std::filesystem::is_symlink(place->second / name, none);
            const bool is_new_folder = is_new && ((event.mask & IN_ISDIR) != 0 || is_new_link);
            const bool missed_some = (event.mask & IN_Q_OVERFLOW) != 0; // new folders may be among them
            if (missed_some || (is_new_folder && place != watched_.end() && !is_passing_name(name))) {
                TRY_VOID(add(missed_some ? folder_ : place->second / name));
            }
            if ((event.mask & IN_IGNORED) != 0) {
                watched_.erase(event.wd);
            }
            changed = changed || counts(event, name) || is_new_link || missed_some;
        }
    }
    return changed;
}

} // namespace frustumscreen::programs
