#include "firmware_host/base/file.h"

#include "firmware_host/base/descriptor.h"
#include "firmware_host/base/folder_entries.h"
#include "firmware_host/base/open_file.h"
#include "firmware_host/base/streamed_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>

namespace frustumscreen {

namespace {

/// Between the target's name and the number of the writing process.
constexpr std::string_view part_suffix = ".part";

/// An output file under its temporary name; deleted unless `keep_as` succeeded.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::filesystem::path& target)
        : path_(target.string() + std::string(part_suffix) + std::to_string(::getpid())),
          descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {}
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (descriptor_ >= 0) {
            ::close(descriptor_);
            ::unlink(path_.c_str());
        }
    }

    [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
    [[nodiscard]] bool write(std::span<const std::byte> bytes) const {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) {
                continue;
            }
            if (written < 0) {
                return false;
            }
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
        return sync();
    }
    [[nodiscard]] bool sync() const { return ::fsync(descriptor_) == 0; }
    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] bool keep_as(const std::filesystem::path& target) {
        if (::rename(path_.c_str(), target.c_str()) != 0) {
            return false;
        }
        ::close(descriptor_);
        descriptor_ = -1;
        return true;
    }

private:
    std::string path_;
    int descriptor_;
};

/// Overwrites an existing file in place; returns whether that succeeded. The blocks are allocated before the
/// first byte is written, so a full disk leaves the file unchanged.
bool write_over(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    const auto size = static_cast<off_t>(bytes.size());
    return file.number() >= 0 && (size == 0 || ::posix_fallocate(file.number(), 0, size) == 0) &&
           ::pwrite(file.number(), bytes.data(), bytes.size(), 0) == std::ssize(bytes) &&
           ::ftruncate(file.number(), size) == 0;
}

std::string system_reason() {
    return std::strerror(errno);
}

/// Whether `name` is a temporary name of `target` whose process no longer exists. A process of another user
/// counts as existing.
bool is_left_behind(std::string_view name, const std::string& target) {
    const std::string begin = target + std::string(part_suffix);
    if (!name.starts_with(begin)) {
        return false;
    }
    const std::string_view number = name.substr(begin.size());
    pid_t process = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), process);
    return error == std::errc() && end == number.data() + number.size() && process > 0 &&
           ::kill(process, 0) != 0 && errno == ESRCH;
}

} // namespace

Result<Bytes> read_file(const std::filesystem::path& path, std::uintmax_t limit_bytes) {
    // The size is that of the open file; another file may replace it at any time.
    TRY(const OpenFile file, OpenFile::open(path, limit_bytes));
    Bytes bytes(static_cast<std::size_t>(file.bytes()));
    if (!file.read(0, bytes)) {
        return bad_input("file.shortened",
                         path.string() + ": cannot be read: it became shorter, or its disk fails");
    }
    return bytes;
}

Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    TemporaryFile file(path);
    if (!file.is_open() || !file.write(bytes) || !file.keep_as(path)) {
        return bad_input("file.not_written", path.string() + ": cannot be written: " + system_reason());
    }
    return {};
}

Result<void> renew_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    Result<void> written = write_file(path, bytes);
    return written || !write_over(path, bytes) ? written : Result<void>();
}

Result<void> write_file_with(const std::filesystem::path& path,
                             const std::function<Result<void>(int descriptor)>& write) {
    TemporaryFile file(path);
    if (file.is_open()) {
        TRY_VOID(write(file.descriptor()));
    }
    if (!file.is_open() || !file.sync() || !file.keep_as(path)) {
        return bad_input("file.not_renamed", path.string() + ": cannot be written: " + system_reason());
    }
    return {};
}

void clear_partial_files(const std::filesystem::path& path) {
    const std::string target = path.filename().string();
    for (const std::filesystem::directory_entry& entry :
         entries_of(path.has_parent_path() ? path.parent_path() : ".")) {
        std::error_code kept; // files that cannot be listed or removed stay
        if (is_left_behind(entry.path().filename().string(), target) && entry.is_regular_file(kept)) {
            std::filesystem::remove(entry.path(), kept);
        }
    }
}

std::span<const std::byte> as_bytes(std::string_view text) {
    return std::as_bytes(std::span<const char>(text.data(), text.size()));
}

std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace frustumscreen
