/// A file that is read piece by piece, where reading all of it would take too much memory.
///
/// Errors   as read_file. What the file says may change between two reads: who uses a piece checks that piece.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>

namespace frustumscreen {

/// What a file holds, wherever it lies.
class FileContent {
public:
    FileContent() = default;
    FileContent(const FileContent&) = delete;
    FileContent& operator=(const FileContent&) = delete;
    virtual ~FileContent() = default;
    /// As it was opened.
    [[nodiscard]] virtual std::uint64_t bytes() const = 0;
    /// 0, or why not all of `out` could be filled from `offset` on: an errno, ENODATA for a file that ends before.
    [[nodiscard]] virtual int read(std::uint64_t offset, std::span<std::byte> out) const = 0;
};

class OpenFile {
public:
    /// Errors: not there, not readable, not a regular file, larger than `limit_bytes`.
    [[nodiscard]] static Result<OpenFile> open(const std::filesystem::path& path, std::uint64_t limit_bytes);
    explicit OpenFile(std::unique_ptr<const FileContent> content) : content_(std::move(content)) {}

    /// As it was opened.
    [[nodiscard]] std::uint64_t bytes() const { return content_->bytes(); }
    /// False unless all of `out` could be filled from `offset` on.
    [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> out) const {
        return content_->read(offset, out) == 0;
    }

private:
    std::unique_ptr<const FileContent> content_; ///< never null, but in what was moved from
};

/// What an open descriptor of a regular file holds; it is closed at the end.
[[nodiscard]] std::unique_ptr<const FileContent> content_of(int descriptor, std::uint64_t bytes);

} // namespace frustumscreen
