#include "firmware_host/base/open_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace frustumscreen {

namespace {

class DescriptorContent final : public FileContent {
public:
    DescriptorContent(int descriptor, std::uint64_t bytes) : descriptor_(descriptor), bytes_(bytes) {}
    ~DescriptorContent() override { ::close(descriptor_); }

    [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }
    [[nodiscard]] int read(std::uint64_t offset, std::span<std::byte> out) const override {
        while (!out.empty()) {
            const ssize_t got = ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
            if (got < 0 && errno == EINTR) {
                continue;
            }
            if (got <= 0) {
                return got < 0 ? errno : ENODATA;
            }
            offset += static_cast<std::uint64_t>(got);
            out = out.subspan(static_cast<std::size_t>(got));
        }
        return 0;
    }

private:
    int descriptor_;
    std::uint64_t bytes_;
};

} // namespace

std::unique_ptr<const FileContent> content_of(int descriptor, std::uint64_t bytes) {
    return std::make_unique<DescriptorContent>(descriptor, bytes);
}

Result<OpenFile> OpenFile::open(const std::filesystem::path& path, std::uint64_t limit_bytes) {
    // Opening a pipe or a device must not block before it is refused.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor < 0) {
        return bad_input("file.not_opened",
                         path.string() + (errno == ENOENT
                                              ? std::string(": there is no such file")
                                              : std::string(": cannot be read: ") + std::strerror(errno)));
    }
    struct stat status {};
    const int failed = ::fstat(descriptor, &status) != 0 ? errno : 0;
    const auto bytes = static_cast<std::uint64_t>(status.st_size);
    OpenFile file(content_of(descriptor, bytes));
    if (failed != 0) {
        return bad_input("file.unreadable", path.string() + ": cannot be read: " + std::strerror(failed));
    }
    if (!S_ISREG(status.st_mode)) {
        return bad_input("file.not_regular",
                         path.string() + (S_ISDIR(status.st_mode) ? ": this is a folder; name a file"
                                                                  : ": this is not a regular file"));
    }
    if (bytes > limit_bytes) {
        return bad_input("file.too_long", path.string() + ": " + std::to_string(bytes) + " bytes; at most " +
                                              std::to_string(limit_bytes) + " are allowed");
    }
    return file;
}

} // namespace frustumscreen
