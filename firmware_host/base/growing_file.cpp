#include "firmware_host/base/growing_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace frustumscreen {

namespace {

constexpr int max_of_one_name = 10'000;

} // namespace

Result<GrowingFile> GrowingFile::create(const std::filesystem::path& wanted) {
    for (int number = 1; number <= max_of_one_name; ++number) {
        const std::filesystem::path path =
            number == 1 ? wanted : std::filesystem::path(wanted.string() + "." + std::to_string(number));
        const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
        if (descriptor >= 0) {
            return GrowingFile(descriptor, path);
        }
        if (errno != EEXIST) {
            return bad_input("file.not_made", path.string() + ": cannot be made: " + std::strerror(errno));
        }
    }
    return bad_input("file.too_many_of_name",
                     wanted.string() + ": there are too many files of this name; move them away");
}

GrowingFile::GrowingFile(int descriptor, std::filesystem::path name)
    : descriptor_(descriptor), path_(std::move(name)) {}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_)) {}

GrowingFile::~GrowingFile() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

Result<void> GrowingFile::append(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written < 0) {
            return failure();
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return {};
}

Result<void> GrowingFile::sync() const {
    while (::fdatasync(descriptor_) != 0) {
        if (errno == EINVAL) {
            return {}; // a pipe, or another object without storage
        }
        if (errno != EINTR) {
            return failure();
        }
    }
    return {};
}

Result<void> GrowingFile::failure() const {
    if (errno == ENOSPC || errno == EDQUOT) {
        return bad_input("file.disk_full", path_.string() + ": the disk is full");
    }
    return bad_input("file.not_grown", path_.string() + ": cannot be written: " + std::strerror(errno));
}

} // namespace frustumscreen
