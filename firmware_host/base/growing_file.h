/// A file that grows in place, for what must be there up to the last second when the power goes.
///
/// The one exception from 'files appear by rename': its format must be readable up to any cut.
/// Threads  one caller.
/// Errors   one sentence; a full disk is told from others.
#pragma once

#include "firmware_host/base/file.h"

namespace frustumscreen {

class GrowingFile {
public:
    /// Makes a new file: `wanted`, or where that is there already, the first of `wanted`.2, `wanted`.3, ...
    [[nodiscard]] static Result<GrowingFile> create(const std::filesystem::path& wanted);
    /// Takes over an open descriptor; `name` stands in messages.
    GrowingFile(int descriptor, std::filesystem::path name);
    ~GrowingFile();
    GrowingFile(GrowingFile&& other) noexcept;
    GrowingFile(const GrowingFile&) = delete;
    GrowingFile& operator=(const GrowingFile&) = delete;
    GrowingFile& operator=(GrowingFile&&) = delete;

    [[nodiscard]] Result<void> append(std::span<const std::byte> bytes);
    /// What was appended survives a power cut from here on; or not: a disk may say only now what went wrong.
    [[nodiscard]] Result<void> sync() const;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    /// What the latest call says through `errno`.
    [[nodiscard]] Result<void> failure() const;

    int descriptor_;
    std::filesystem::path path_;
};

} // namespace frustumscreen
