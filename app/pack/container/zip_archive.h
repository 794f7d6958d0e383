/// A ZIP container, limited to the features that a pack needs. It is written in memory or to a file, and read
/// from memory or piece by piece from a file.
///
/// Errors   ZipReader: anything but a plain archive (no comment, no extra bytes before or after, no
///          encryption, no ZIP64, stored or deflated, unique names), or an entry whose bytes do not match its
///          checksum; DeviceLost: a file that can no longer be read to its end.
/// Threads  one caller.
/// Library  minizip (ioapi functions on our own bytes).
#pragma once

#include "firmware_host/base/file.h"
#include "firmware_host/base/open_file.h"
#include "firmware_host/base/result.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::pack {

struct ArchiveBytes;
class ZipReader;
struct ZipEntry;

enum class Packing { Stored, Deflated };

/// Dates are fixed, so that equal entries give equal bytes.
class ZipWriter {
public:
    /// Writes the archive into memory.
    ZipWriter();
    /// Writes it into an empty file that is open for reading and writing and must outlive the writer.
    explicit ZipWriter(int descriptor);
    ~ZipWriter();
    ZipWriter(const ZipWriter&) = delete;
    ZipWriter& operator=(const ZipWriter&) = delete;

    void add(const std::string& name, std::span<const std::byte> bytes, Packing packing);
    /// Copies an entry of another archive without repacking. Errors: as ZipReader::read, but its checksum is
    /// not verified.
    [[nodiscard]] Result<void> copy(ZipReader& from, const ZipEntry& entry);
    /// Returns the archive; call once, last. Errors: Internal, if the library failed on the way.
    [[nodiscard]] Result<Bytes> finish();
    /// As above, for a file. Errors: it could not be written; the system's reason.
    [[nodiscard]] Result<void> finish_file();

private:
    explicit ZipWriter(std::unique_ptr<ArchiveBytes> file);
    [[nodiscard]] bool close();
    std::unique_ptr<ArchiveBytes> file_;
    void* zip_ = nullptr;
    bool good_ = true;
};

struct ZipEntry {
    std::string name;
    std::uint64_t bytes = 0; ///< unpacked, as the archive claims; at most what its packed bytes can hold
    std::uint64_t stored_bytes = 0; ///< in the archive
    std::uint64_t position = 0;     ///< the library's own handle: position in the directory ...
    std::uint64_t number = 0;       ///< ... and number
};

class ZipReader {
public:
    /// `bytes` must outlive the reader.
    [[nodiscard]] static Result<ZipReader> open(std::span<const std::byte> bytes);
    [[nodiscard]] static Result<ZipReader> open(OpenFile file);
    ~ZipReader();
    ZipReader(ZipReader&&) noexcept;
    ZipReader& operator=(ZipReader&&) = delete;

    [[nodiscard]] const std::vector<ZipEntry>& entries() const { return entries_; }
    /// Null if there is no entry with that name.
    [[nodiscard]] const ZipEntry* find(std::string_view name) const;
    /// Unpacks an entry; the caller must have checked entry.bytes against a limit.
    [[nodiscard]] Result<Bytes> read(const ZipEntry& entry);
    /// As `read`, piece by piece; the bytes are only valid if it succeeds.
    [[nodiscard]] Result<void> read_through(const ZipEntry& entry,
                                            const std::function<void(std::span<const std::byte>)>& take);

private:
    friend class ZipWriter;
    /// An error with `message`, or DeviceLost if the file can no longer be read.
    [[nodiscard]] tl::unexpected<Error> refusal(MessageId id, std::string message) const;
    [[nodiscard]] tl::unexpected<Error> damaged(const ZipEntry& entry) const;
    explicit ZipReader(std::unique_ptr<ArchiveBytes> bytes);
    static Result<ZipReader> open(std::unique_ptr<ArchiveBytes> bytes);
    Result<void> read_directory();
    Result<void> read_whole(const ZipEntry& entry, const std::function<bool()>& step);
    std::unique_ptr<ArchiveBytes> file_;
    void* zip_ = nullptr;
    std::vector<ZipEntry> entries_;
    std::map<std::string, std::size_t, std::less<>> numbers_; ///< index into entries_, by name
};

} // namespace frustumscreen::pack
