/// A file that is read piece by piece, because the whole would take too much memory.
///
/// Errors   as read_file. The content may change between two reads: check each piece after reading it.
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

/// The content of a file, on disk or in memory.
class FileContent {
public:
    FileContent() = default;
    FileContent(const FileContent&) = delete;
    FileContent& operator=(const FileContent&) = delete;
    virtual ~FileContent() = default;
    /// The size when the file was opened.
    [[nodiscard]] virtual std::uint64_t bytes() const = 0;
    /// Fills all of `out` from `offset` on; returns 0 or an errno, ENODATA for a file that ends too early.
    [[nodiscard]] virtual int read(std::uint64_t offset, std::span<std::byte> out) const = 0;
};

class OpenFile {
public:
    /// Errors: not there, not readable, not a regular file, larger than `limit_bytes`.
    [[nodiscard]] static Result<OpenFile> open(const std::filesystem::path& path, std::uint64_t limit_bytes);
    explicit OpenFile(std::unique_ptr<const FileContent> content) : content_(std::move(content)) {}

    /// The size when the file was opened.
    [[nodiscard]] std::uint64_t bytes() const { return content_->bytes(); }
    /// Returns false unless all of `out` was filled from `offset` on.
    [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> out) const {
        return content_->read(offset, out) == 0;
    }

private:
    std::unique_ptr<const FileContent> content_; ///< null only after a move
};

/// The content of a regular file; takes over the descriptor and closes it.
[[nodiscard]] std::unique_ptr<const FileContent> content_of(int descriptor, std::uint64_t bytes);

} // namespace frustumscreen
