#include "app/pack/container/archive_bytes.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace frustumscreen::pack {

bool GrowingBytes::read(std::uint64_t offset, std::span<std::byte> out) {
    std::memcpy(out.data(), bytes.data() + offset, out.size());
    return true;
}

bool GrowingBytes::write(std::uint64_t offset, std::span<const std::byte> in) {
    bytes.resize(std::max<std::size_t>(bytes.size(), offset + in.size()));
    std::memcpy(bytes.data() + offset, in.data(), in.size());
    return true;
}

bool WrittenFile::write(std::uint64_t offset, std::span<const std::byte> in) {
    while (!in.empty()) {
        const ssize_t written = ::pwrite(file, in.data(), in.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            fault = written < 0 ? errno : EIO;
            return false;
        }
        offset += static_cast<std::uint64_t>(written);
        in = in.subspan(static_cast<std::size_t>(written));
    }
    end = std::max(end, offset);
    return true;
}

bool ViewedBytes::read(std::uint64_t offset, std::span<std::byte> out) {
    std::memcpy(out.data(), view.data() + offset, out.size());
    return true;
}

bool FileBytes::read(std::uint64_t offset, std::span<std::byte> out) {
    if (out.size() > step_bytes) {
        failed = failed || !file_.read(offset, out);
        return !failed;
    }
    if (offset < begin_ || offset + out.size() > begin_ + window_.size()) {
        begin_ = offset / step_bytes * step_bytes;
        window_.resize(std::min<std::uint64_t>(2 * step_bytes, file_.bytes() - begin_));
        if (!file_.read(begin_, window_)) {
            window_.clear();
            failed = true;
            return false;
        }
    }
    std::memcpy(out.data(), window_.data() + (offset - begin_), out.size());
    return true;
}

namespace {

ArchiveBytes& bytes_of(voidpf opaque) {
    return *static_cast<ArchiveBytes*>(opaque);
}

voidpf open_bytes(voidpf opaque, const void*, int) {
    return opaque;
}

uLong read_bytes(voidpf opaque, voidpf, void* out, uLong size) {
    ArchiveBytes& bytes = bytes_of(opaque);
    const std::uint64_t left = bytes.size() - std::min(bytes.cursor, bytes.size());
    const std::uint64_t count = std::min<std::uint64_t>(size, left);
    if (count > 0 && !bytes.read(bytes.cursor, {static_cast<std::byte*>(out), count})) {
        return 0;
    }
    bytes.cursor += count;
    return count;
}

uLong write_bytes(voidpf opaque, voidpf, const void* in, uLong size) {
    ArchiveBytes& bytes = bytes_of(opaque);
    if (size > 0 && !bytes.write(bytes.cursor, {static_cast<const std::byte*>(in), size})) {
        return 0;
    }
    bytes.cursor += size;
    return size;
}

ZPOS64_T tell_cursor(voidpf opaque, voidpf) {
    return bytes_of(opaque).cursor;
}

long seek_cursor(voidpf opaque, voidpf, ZPOS64_T offset, int origin) {
    ArchiveBytes& bytes = bytes_of(opaque);
    const std::uint64_t from = origin == ZLIB_FILEFUNC_SEEK_CUR   ? bytes.cursor
                               : origin == ZLIB_FILEFUNC_SEEK_END ? bytes.size()
                                                                  : 0;
    const std::uint64_t target = from + offset;
    if (target < from || target > bytes.size()) {
        return -1;
    }
    bytes.cursor = target;
    return 0;
}

int close_bytes(voidpf, voidpf) {
    return 0;
}

int no_error(voidpf, voidpf) {
    return 0;
}

} // namespace

zlib_filefunc64_def functions_over(ArchiveBytes& bytes) {
    zlib_filefunc64_def functions{};
    functions.zopen64_file = open_bytes;
    functions.zread_file = read_bytes;
    functions.zwrite_file = write_bytes;
    functions.ztell64_file = tell_cursor;
    functions.zseek64_file = seek_cursor;
    functions.zclose_file = close_bytes;
    functions.zerror_file = no_error;
    functions.opaque = &bytes;
    return functions;
}

} // namespace frustumscreen::pack
