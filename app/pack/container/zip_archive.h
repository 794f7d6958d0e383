/// A ZIP container: what a pack needs of it and no more. It is written in memory or to a file, and read from memory or piece by
/// piece from a file.
///
/// Errors   ZipReader: anything but a plain archive (no comment, no junk before or after, no encryption, no
///          ZIP64, stored or deflated, unique names), or an entry whose bytes do not match its checksum;
///          DeviceLost: a file that cannot be read to its end any more.
/// Threads  one caller.
/// Library  minizip (ioapi functions over bytes of our own).
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

namespace frustumscreen::pack_format {

struct ArchiveBytes;
class ZipReader;
struct ZipEntry;

enum class Packing { Stored, Deflated };

/// Dates are fixed, so that the same entries give the same bytes.
class ZipWriter {
public:
    /// In memory.
    ZipWriter();
    /// Into an empty file that is open for reading and writing; it must outlive the writer.
    explicit ZipWriter(int descriptor);
    ~ZipWriter();
    ZipWriter(const ZipWriter&) = delete;
    ZipWriter& operator=(const ZipWriter&) = delete;

    void add(const std::string& name, std::span<const std::byte> bytes, Packing packing);
    /// An entry of another archive as it is packed there. Errors: as ZipReader::read, but its checksum is not looked at.
    [[nodiscard]] Result<void> copy(ZipReader& from, const ZipEntry& entry);
    /// The archive; call once, last. Errors: Internal, when the library failed on the way.
    [[nodiscard]] Result<Bytes> finish();
    /// The same for a file. Errors: it could not be written; the system's reason.
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
    std::uint64_t bytes = 0; ///< unpacked, as the archive claims; never more than its packed bytes can hold
    std::uint64_t stored_bytes = 0; ///< in the archive
    std::uint64_t position = 0;     ///< the library's own handle: place in the directory ...
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
    /// Null if there is none of that name.
    [[nodiscard]] const ZipEntry* find(std::string_view name) const;
    /// Unpacks an entry; the caller must have checked entry.bytes against a limit.
    [[nodiscard]] Result<Bytes> read(const ZipEntry& entry);
    /// The same bytes, some at a time; they count only if all is well in the end.
    [[nodiscard]] Result<void> read_through(const ZipEntry& entry,
                                            const std::function<void(std::span<const std::byte>)>& take);

private:
    friend class ZipWriter;
    /// `message`, or that the file cannot be read any more.
    [[nodiscard]] tl::unexpected<Error> refusal(MessageId id, std::string message) const;
    [[nodiscard]] tl::unexpected<Error> damaged(const ZipEntry& entry) const;
    explicit ZipReader(std::unique_ptr<ArchiveBytes> bytes);
    static Result<ZipReader> open(std::unique_ptr<ArchiveBytes> bytes);
    Result<void> read_directory();
    Result<void> read_whole(const ZipEntry& entry, const std::function<bool()>& step);
    std::unique_ptr<ArchiveBytes> file_;
    void* zip_ = nullptr;
    std::vector<ZipEntry> entries_;
    std::map<std::string, std::size_t, std::less<>> numbers_; ///< of the entries, by name
};

} // namespace frustumscreen::pack_format
