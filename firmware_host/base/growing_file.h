/// A file that grows in place, for data that must survive a power cut up to the last second.
///
/// The one exception to "files appear by rename": its format must be readable after a cut at any byte.
/// Threads  one caller.
/// Errors   one sentence; a full disk has its own sentence.
#pragma once

#include "firmware_host/base/file.h"

namespace frustumscreen {

class GrowingFile {
public:
    /// Creates a new file: `wanted`, or if that exists, the first free name of `wanted`.2, `wanted`.3, ...
    [[nodiscard]] static Result<GrowingFile> create(const std::filesystem::path& wanted);
    /// Takes over an open descriptor; `name` appears in messages.
    GrowingFile(int descriptor, std::filesystem::path name);
    ~GrowingFile();
    GrowingFile(GrowingFile&& other) noexcept;
    GrowingFile(const GrowingFile&) = delete;
    GrowingFile& operator=(const GrowingFile&) = delete;
    GrowingFile& operator=(GrowingFile&&) = delete;

    [[nodiscard]] Result<void> append(std::span<const std::byte> bytes);
    /// After this call all appended bytes survive a power cut. A disk may report an earlier error only here.
    [[nodiscard]] Result<void> sync() const;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    /// The error that the latest call left in `errno`.
    [[nodiscard]] Result<void> failure() const;

    int descriptor_;
    std::filesystem::path path_;
};

} // namespace frustumscreen
