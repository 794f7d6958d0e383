/// The bytes of a ZIP archive, in memory or in a file, as the ZIP library reads and writes them.
///
/// Errors   a call returns false; `failed` and `fault` say why.
/// Threads  one caller.
/// Library  minizip (ioapi).
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/base/open_file.h"

#include <unzip.h>

#include <cstdint>
#include <span>

namespace frustumscreen::pack {

/// The bytes that the library reads and writes, and its cursor in them.
struct ArchiveBytes {
    ArchiveBytes() = default;
    ArchiveBytes(const ArchiveBytes&) = delete;
    ArchiveBytes& operator=(const ArchiveBytes&) = delete;
    virtual ~ArchiveBytes() = default;
    [[nodiscard]] virtual std::uint64_t size() const = 0;
    /// `out` must lie inside.
    [[nodiscard]] virtual bool read(std::uint64_t offset, std::span<std::byte> out) = 0;
    [[nodiscard]] virtual bool write(std::uint64_t /*offset*/, std::span<const std::byte> /*in*/) {
        return false;
    }

    std::uint64_t cursor = 0;
    bool failed = false; ///< bytes that should exist could not be read
};

/// Memory that grows as it is written.
struct GrowingBytes final : ArchiveBytes {
    Bytes bytes;

    [[nodiscard]] std::uint64_t size() const override { return bytes.size(); }
    [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> out) override;
    [[nodiscard]] bool write(std::uint64_t offset, std::span<const std::byte> in) override;
};

/// A file that is written; the caller closes it.
struct WrittenFile final : ArchiveBytes {
    explicit WrittenFile(int descriptor) : file(descriptor) {}
    int file;
    std::uint64_t end = 0;
    int fault = 0; ///< errno

    [[nodiscard]] std::uint64_t size() const override { return end; }
    /// The library only writes, and seeks back to write.
    [[nodiscard]] bool read(std::uint64_t /*offset*/, std::span<std::byte> /*out*/) override { return false; }
    [[nodiscard]] bool write(std::uint64_t offset, std::span<const std::byte> in) override;
};

/// Memory that is only read; it must outlive this.
struct ViewedBytes final : ArchiveBytes {
    explicit ViewedBytes(std::span<const std::byte> bytes) : view(bytes) {}
    std::span<const std::byte> view;

    [[nodiscard]] std::uint64_t size() const override { return view.size(); }
    [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> out) override;
};

/// A file that is only read. The library reads a directory byte by byte, and searches for its end backwards; a window
/// aligned to whole steps avoids a system call for each byte.
class FileBytes final : public ArchiveBytes {
public:
    explicit FileBytes(OpenFile file) : file_(std::move(file)) {}

    [[nodiscard]] std::uint64_t size() const override { return file_.bytes(); }
    [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> out) override;

private:
    static constexpr std::size_t step_bytes = 8192;
    OpenFile file_;
    Bytes window_;
    std::uint64_t begin_ = 0;
};

/// The library's calls on these bytes, which must outlive them.
[[nodiscard]] zlib_filefunc64_def functions_over(ArchiveBytes& bytes);

} // namespace frustumscreen::pack
