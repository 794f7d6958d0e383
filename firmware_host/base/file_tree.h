/// A folder and its contents: the part of a file system that an importer needs. Tests replace it by files in
/// memory.
///
/// Paths    relative to the folder, "a/b"; "" is the folder itself. Links are never followed.
/// Order    as in POSIX: appended bytes are on the disk after sync(). A new, removed or renamed name is on
///          the disk only after sync_folder() of its folder. rename() replaces atomically or not at all.
/// Errors   an errno (FileFault). No retries.
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

    /// Visits the entries in any order, without "." and "..", until `visit` returns false.
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
    /// An existing file of this name is truncated.
    virtual FileResult<std::unique_ptr<NewFile>> create(const std::string& path) = 0;
    virtual FileResult<void> rename(const std::string& from, const std::string& to) = 0;
    virtual FileResult<void> remove(const std::string& path) = 0;
    /// Succeeds if the folder exists already.
    virtual FileResult<void> make_folder(const std::string& path) = 0;
    virtual FileResult<void> sync_folder(const std::string& path) = 0;
    /// Bytes that this process may still write.
    virtual FileResult<std::uint64_t> free_bytes() = 0;
};

} // namespace frustumscreen
