/// A folder and all that lies in it, as little of a file system as an importer needs: so that what it does with a stick and
/// with a disk is also tested with files that only exist in memory.
///
/// Paths    relative to the folder, "a/b"; "" is the folder itself. No link is ever followed.
/// Order    as POSIX has it: what was appended is on the disk after sync(); that a name is there, gone or another's only
///          after sync_folder() of the folder that holds it. rename() replaces at once or not at all.
/// Errors   an errno (FileFault). Retries nothing.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/open_file.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace frustumscreen {

struct FileFault {
    int number = 0; ///< errno
    [[nodiscard]] bool operator==(const FileFault&) const = default;
};
template <typename T> using FileResult = tl::expected<T, FileFault>;
[[nodiscard]] inline tl::unexpected<FileFault> file_fault(int number) {
    return tl::unexpected<FileFault>(FileFault{number});
}

enum class EntryKind : std::uint8_t { File, Folder, Other }; ///< Other: a link, a pipe, a device
struct FolderEntry {
    std::string name; ///< any bytes
    EntryKind kind = EntryKind::Other;
};

class FileTree {
public:
    FileTree() = default;
    FileTree(const FileTree&) = delete;
    FileTree& operator=(const FileTree&) = delete;
    virtual ~FileTree() = default;

    /// In no order, without "." and "..", until `visit` returns false.
    virtual FileResult<void> list(const std::string& folder,
                                  const std::function<bool(const FolderEntry&)>& visit) = 0;
    /// EINVAL: not a regular file.
    virtual FileResult<std::unique_ptr<const FileContent>> open(const std::string& path) = 0;
};

/// A new file, written from its beginning to its end.
class NewFile {
public:
    NewFile() = default;
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    virtual ~NewFile() = default;
    virtual FileResult<void> append(std::span<const std::byte> bytes) = 0;
    virtual FileResult<void> sync() = 0;
};

class WritableTree : public FileTree {
public:
    /// What was there under this name is emptied.
    virtual FileResult<std::unique_ptr<NewFile>> create(const std::string& path) = 0;
    virtual FileResult<void> rename(const std::string& from, const std::string& to) = 0;
    virtual FileResult<void> remove(const std::string& path) = 0;
    /// All is well if it is there already.
    virtual FileResult<void> make_folder(const std::string& path) = 0;
    virtual FileResult<void> sync_folder(const std::string& path) = 0;
    /// That this process may still fill.
    virtual FileResult<std::uint64_t> free_bytes() = 0;
};

} // namespace frustumscreen
