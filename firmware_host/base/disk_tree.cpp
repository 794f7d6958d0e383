#include "firmware_host/base/disk_tree.h"

#include "firmware_host/base/descriptor.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

namespace frustumscreen {

namespace {

constexpr mode_t file_mode = 0644; // the exhibit runs as another user and must read them
constexpr mode_t folder_mode = 0755;

FileResult<void> done(int returned) {
    return returned == 0 ? FileResult<void>() : file_fault(errno);
}

class DiskFile final : public NewFile {
public:
    explicit DiskFile(Descriptor file) : file_(std::move(file)) {}

    FileResult<void> append(std::span<const std::byte> bytes) override {
        while (!bytes.empty()) {
            const ssize_t written = ::write(file_.number(), bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) {
                continue;
            }
            if (written <= 0) {
                return file_fault(written < 0 ? errno : EIO);
            }
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
        return {};
    }
    FileResult<void> sync() override {
        const FileResult<void> synced = done(::fsync(file_.number()));
        // Drop the cached pages, so a later read sees what the disk has, not what was meant to be written.
        // This is advice; it may fail.
        static_cast<void>(::posix_fadvise(file_.number(), 0, 0, POSIX_FADV_DONTNEED));
        return synced;
    }

private:
    Descriptor file_;
};

/// The folder and the name of a path's last component.
struct Place {
    Descriptor folder;
    std::string name;
};

class DiskTree final : public WritableTree {
public:
    explicit DiskTree(Descriptor root) : root_(std::move(root)) {}

    FileResult<void> list(const std::string& folder,
                          const std::function<bool(const FolderEntry&)>& visit) override;
    FileResult<std::unique_ptr<const FileContent>> open(const std::string& path) override;
    FileResult<std::unique_ptr<NewFile>> create(const std::string& path) override;
    FileResult<void> rename(const std::string& from, const std::string& to) override;
    FileResult<void> remove(const std::string& path) override;
    FileResult<void> make_folder(const std::string& path) override;
    FileResult<void> sync_folder(const std::string& path) override;
    FileResult<std::uint64_t> free_bytes() override;

private:
    [[nodiscard]] FileResult<Descriptor> open_folder(std::string_view path) const;
    [[nodiscard]] FileResult<Place> place_of(const std::string& path) const;
    Descriptor root_;
};

/// Opens one component at a time: a link in the middle of a path must not lead elsewhere.
FileResult<Descriptor> DiskTree::open_folder(std::string_view path) const {
    constexpr int flags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
    Descriptor folder(::openat(root_.number(), ".", flags));
    while (folder.number() >= 0 && !path.empty()) {
        const std::string name(path.substr(0, path.find('/')));
        path.remove_prefix(std::min(path.size(), name.size() + 1));
        folder = Descriptor(::openat(folder.number(), name.c_str(), flags));
    }
    if (folder.number() < 0) {
        return file_fault(errno);
    }
    return folder;
}

FileResult<Place> DiskTree::place_of(const std::string& path) const {
    const std::size_t slash = path.rfind('/');
    const bool inner = slash != std::string::npos;
    TRY(Descriptor folder, open_folder(inner ? path.substr(0, slash) : std::string()));
    return Place{std::move(folder), inner ? path.substr(slash + 1) : path};
}

EntryKind kind_of(int folder, const dirent& entry) {
    if (entry.d_type != DT_UNKNOWN) {
        return entry.d_type == DT_REG   ? EntryKind::File
               : entry.d_type == DT_DIR ? EntryKind::Folder
                                        : EntryKind::Other;
    }
    struct stat status {};
    if (::fstatat(folder, entry.d_name, &status, AT_SYMLINK_NOFOLLOW) != 0) {
        return EntryKind::Other;
    }
    return S_ISREG(status.st_mode)   ? EntryKind::File
           : S_ISDIR(status.st_mode) ? EntryKind::Folder
                                     : EntryKind::Other;
}

FileResult<void> DiskTree::list(const std::string& folder,
                                const std::function<bool(const FolderEntry&)>& visit) {
    TRY(Descriptor opened, open_folder(folder));
    const std::unique_ptr<DIR, int (*)(DIR*)> stream(::fdopendir(opened.number()), ::closedir);
    if (!stream) {
        return file_fault(errno);
    }
    static_cast<void>(opened.release()); // the stream owns it now
    for (;;) {
        errno = 0;
        const dirent* entry = ::readdir(stream.get());
        if (entry == nullptr) {
            return done(errno);
        }
        const std::string_view name = entry->d_name;
        if (name != "." && name != ".." &&
            !visit({std::string(name), kind_of(::dirfd(stream.get()), *entry)})) {
            return {};
        }
    }
}

FileResult<std::unique_ptr<const FileContent>> DiskTree::open(const std::string& path) {
    TRY(const Place place, place_of(path));
    // Opening a pipe or a device must not block before it is refused.
    Descriptor file(::openat(place.folder.number(), place.name.c_str(),
                             O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    struct stat status {};
    if (file.number() < 0 || ::fstat(file.number(), &status) != 0) {
        return file_fault(errno);
    }
    if (!S_ISREG(status.st_mode)) {
        return file_fault(EINVAL);
    }
    return content_of(file.release(), static_cast<std::uint64_t>(status.st_size));
}

FileResult<std::unique_ptr<NewFile>> DiskTree::create(const std::string& path) {
    TRY(const Place place, place_of(path));
    Descriptor file(::openat(place.folder.number(), place.name.c_str(),
                             O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, file_mode));
    if (file.number() < 0) {
        return file_fault(errno);
    }
    return std::make_unique<DiskFile>(std::move(file));
}

FileResult<void> DiskTree::rename(const std::string& from, const std::string& to) {
    TRY(const Place old_place, place_of(from));
    TRY(const Place new_place, place_of(to));
    return done(::renameat(old_place.folder.number(), old_place.name.c_str(), new_place.folder.number(),
                           new_place.name.c_str()));
}

FileResult<void> DiskTree::remove(const std::string& path) {
    TRY(const Place place, place_of(path));
    return done(::unlinkat(place.folder.number(), place.name.c_str(), 0));
}

FileResult<void> DiskTree::make_folder(const std::string& path) {
    TRY(const Place place, place_of(path));
    const FileResult<void> made = done(::mkdirat(place.folder.number(), place.name.c_str(), folder_mode));
    return !made && made.error().number == EEXIST ? FileResult<void>() : made;
}

FileResult<void> DiskTree::sync_folder(const std::string& path) {
    TRY(const Descriptor folder, open_folder(path));
    return done(::fsync(folder.number()));
}

FileResult<std::uint64_t> DiskTree::free_bytes() {
    struct statvfs status {};
    if (::fstatvfs(root_.number(), &status) != 0) {
        return file_fault(errno);
    }
    return static_cast<std::uint64_t>(status.f_bavail) * status.f_frsize;
}

} // namespace

Result<std::unique_ptr<WritableTree>> open_tree(const std::filesystem::path& folder) {
    Descriptor root(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (root.number() < 0) {
        const std::string why = errno == ENOENT
                                    ? "there is no such folder"
                                    : std::string("cannot be opened as a folder: ") + std::strerror(errno);
        return bad_input("folder.unusable", folder.string() + ": " + why);
    }
    return std::make_unique<DiskTree>(std::move(root));
}

} // namespace frustumscreen
