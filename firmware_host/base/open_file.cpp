#include "firmware_host/base/open_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace frustumscreen {

Result<OpenFile> OpenFile::open(const std::filesystem::path& path, std::uint64_t limit_bytes) {
    // A pipe or a device must not hold the program up before it is refused.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor < 0) {
        return bad_input(path.string() + (errno == ENOENT
                                              ? std::string(": there is no such file")
                                              : std::string(": cannot be read: ") + std::strerror(errno)));
    }
    OpenFile file(descriptor, 0);
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) {
        return bad_input(path.string() + ": cannot be read: " + std::strerror(errno));
    }
    if (!S_ISREG(status.st_mode)) {
        return bad_input(path.string() + ": this is not a regular file");
    }
    file.bytes_ = static_cast<std::uint64_t>(status.st_size);
    if (file.bytes_ > limit_bytes) {
        return bad_input(path.string() + ": " + std::to_string(file.bytes_) + " bytes; at most " +
                         std::to_string(limit_bytes) + " are allowed");
    }
    return file;
}

OpenFile::~OpenFile() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

bool OpenFile::read(std::uint64_t offset, std::span<std::byte> out) const {
    while (!out.empty()) {
        const ssize_t got = ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            return false;
        }
        offset += static_cast<std::uint64_t>(got);
        out = out.subspan(static_cast<std::size_t>(got));
    }
    return true;
}

} // namespace frustumscreen
