/// A file that is read piece by piece, where reading all of it would take too much memory.
///
/// Errors   as read_file. What the file says may change between two reads: who uses a piece checks that piece.
/// Threads  one caller.
#pragma once

#include "firmware_host/base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>

namespace frustumscreen {

class OpenFile {
public:
    /// Errors: not there, not readable, not a regular file, larger than `limit_bytes`.
    [[nodiscard]] static Result<OpenFile> open(const std::filesystem::path& path, std::uint64_t limit_bytes);
    ~OpenFile();
    OpenFile(OpenFile&& other) noexcept
        : descriptor_(std::exchange(other.descriptor_, -1)), bytes_(other.bytes_) {}
    OpenFile& operator=(OpenFile&&) = delete;

    /// As it was opened.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    /// False unless all of `out` could be filled from `offset` on.
    [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> out) const;

private:
    OpenFile(int descriptor, std::uint64_t bytes) : descriptor_(descriptor), bytes_(bytes) {}
    int descriptor_ = -1;
    std::uint64_t bytes_ = 0;
};

} // namespace frustumscreen
