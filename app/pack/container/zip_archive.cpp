#include "app/pack/container/zip_archive.h"

#include "app/pack/container/archive_bytes.h"
#include "app/pack/container/limits.h"
#include "firmware_host/base/byte_reader.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <unzip.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace frustumscreen::pack {

namespace {

constexpr int deflate_level = 1; ///< Z_BEST_SPEED: a part is packed once and unpacked at every start
constexpr uLong first_of_1980 = (1U << 21) | (1U << 16); ///< MS-DOS date, midnight: the earliest possible
constexpr uLong encrypted_flag = 1;
/// Deflate never packs tighter than 1032 to 1 (zlib's technical details); an archive that claims more is
/// invalid.
constexpr std::uint64_t max_deflate_ratio = 1032;
constexpr std::size_t end_record_bytes = 22;
constexpr std::size_t through_step_bytes = 64U << 10U;

/// An entry is at the start of the file, the end record at its end, and the directory ends where that record
/// begins (APPNOTE.TXT 4.3.16): nothing was cut off, prepended or appended.
bool is_whole(ArchiveBytes& bytes) {
    std::array<std::byte, end_record_bytes> record{};
    std::array<std::byte, 4> first{};
    if (bytes.size() < end_record_bytes || !bytes.read(bytes.size() - end_record_bytes, record) ||
        !bytes.read(0, first) || ByteReader(first).read<std::uint32_t>() != 0x04034b50) {
        return false;
    }
    const std::span<const std::byte> end(record);
    const auto signature = ByteReader(end).read<std::uint32_t>();
    ByteReader rest(end.subspan(12));
    const std::uint64_t directory_bytes = rest.read<std::uint32_t>();
    const std::uint64_t directory_offset = rest.read<std::uint32_t>();
    const auto comment_bytes = rest.read<std::uint16_t>();
    return signature == 0x06054b50 && comment_bytes == 0 &&
           directory_offset + directory_bytes == bytes.size() - end_record_bytes;
}

Result<void> check_entry(const ZipEntry& entry, const unz_file_info64& info) {
    if ((info.flag & encrypted_flag) != 0) {
        return bad_input("zip.encrypted", "{} is encrypted; packs are not", entry.name);
    }
    const bool stored = info.compression_method == 0;
    if (!stored && info.compression_method != Z_DEFLATED) {
        return bad_input("zip.method", "{} is packed by ZIP method {}; allowed are stored and deflated",
                         entry.name, info.compression_method);
    }
    const std::uint64_t most = stored ? entry.stored_bytes : entry.stored_bytes * max_deflate_ratio;
    if (entry.bytes > most || (stored && entry.bytes != entry.stored_bytes)) {
        return bad_input("zip.claims",
                         "{} claims {} bytes, more than its {} packed bytes can hold; the pack is altered",
                         entry.name, entry.bytes, entry.stored_bytes);
    }
    return {};
}

} // namespace

ZipWriter::ZipWriter() : ZipWriter(std::make_unique<GrowingBytes>()) {}
ZipWriter::ZipWriter(int descriptor) : ZipWriter(std::make_unique<WrittenFile>(descriptor)) {}

ZipWriter::ZipWriter(std::unique_ptr<ArchiveBytes> file) : file_(std::move(file)) {
    zlib_filefunc64_def functions = functions_over(*file_);
    zip_ = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
    good_ = zip_ != nullptr;
}

ZipWriter::~ZipWriter() {
    if (zip_ != nullptr) {
        zipClose(zip_, nullptr);
    }
}

void ZipWriter::add(const std::string& name, std::span<const std::byte> bytes, Packing packing) {
    if (!good_) {
        return;
    }
    zip_fileinfo info{};
    info.dosDate = first_of_1980;
    const bool stored = packing == Packing::Stored;
    good_ = zipOpenNewFileInZip(zip_, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                                stored ? 0 : Z_DEFLATED, stored ? 0 : deflate_level) == ZIP_OK &&
            zipWriteInFileInZip(zip_, bytes.data(), static_cast<unsigned>(bytes.size())) == ZIP_OK &&
            zipCloseFileInZip(zip_) == ZIP_OK;
}

Result<void> ZipWriter::copy(ZipReader& from, const ZipEntry& entry) {
    const unz64_file_pos position{entry.position, entry.number};
    unz_file_info64 packed{};
    int method = 0;
    int level = 0;
    bool good = unzGoToFilePos64(from.zip_, &position) == UNZ_OK &&
                unzGetCurrentFileInfo64(from.zip_, &packed, nullptr, 0, nullptr, 0, nullptr, 0) == UNZ_OK &&
                unzOpenCurrentFile2(from.zip_, &method, &level, 1) == UNZ_OK;
    if (good) {
        zip_fileinfo info{};
        info.dosDate = first_of_1980;
        good_ = good_ && zipOpenNewFileInZip2(zip_, entry.name.c_str(), &info, nullptr, 0, nullptr, 0,
                                              nullptr, method, level, 1) == ZIP_OK;
        Bytes piece(1U << 16U);
        std::uint64_t left = packed.compressed_size;
        while (left > 0 && good && good_) {
            const auto step = static_cast<unsigned>(std::min<std::uint64_t>(left, piece.size()));
            good = unzReadCurrentFile(from.zip_, piece.data(), step) == static_cast<int>(step);
            good_ = zipWriteInFileInZip(zip_, piece.data(), step) == ZIP_OK;
            left -= step;
        }
        unzCloseCurrentFile(from.zip_);
        good_ = good_ && zipCloseFileInZipRaw64(zip_, packed.uncompressed_size, packed.crc) == ZIP_OK;
    }
    return good ? Result<void>() : from.damaged(entry);
}

bool ZipWriter::close() {
    const bool closed = zip_ != nullptr && zipClose(zip_, nullptr) == ZIP_OK;
    zip_ = nullptr;
    return good_ && closed;
}

Result<void> ZipWriter::finish_file() {
    if (!close()) {
        const int fault = static_cast<const WrittenFile&>(*file_).fault;
        return bad_input("zip.not_written", "cannot be written: {}", std::strerror(fault != 0 ? fault : EIO));
    }
    return {};
}

Result<Bytes> ZipWriter::finish() {
    if (!close()) {
        return fail(ErrorKind::Internal, "zip.no_memory",
                    "the ZIP library could not write the pack in memory");
    }
    return std::move(static_cast<GrowingBytes&>(*file_).bytes);
}

ZipReader::ZipReader(std::unique_ptr<ArchiveBytes> bytes) : file_(std::move(bytes)) {}
ZipReader::ZipReader(ZipReader&& other) noexcept
    : file_(std::move(other.file_)), zip_(std::exchange(other.zip_, nullptr)),
      entries_(std::move(other.entries_)), numbers_(std::move(other.numbers_)) {}
ZipReader::~ZipReader() {
    if (zip_ != nullptr) {
        unzClose(zip_);
    }
}

Result<ZipReader> ZipReader::open(std::span<const std::byte> bytes) {
    return open(std::make_unique<ViewedBytes>(bytes));
}

Result<ZipReader> ZipReader::open(OpenFile file) {
    return open(std::make_unique<FileBytes>(std::move(file)));
}

tl::unexpected<Error> ZipReader::refusal(MessageId id, std::string message) const {
    return file_->failed ? fail(ErrorKind::DeviceLost, "zip.unreadable",
                                "it cannot be read; its disk or stick fails, or was pulled out")
                         : bad_input(id, std::move(message));
}

Result<ZipReader> ZipReader::open(std::unique_ptr<ArchiveBytes> bytes) {
    ZipReader reader(std::move(bytes));
    if (!is_whole(*reader.file_)) {
        std::array<std::byte, 4> first{};
        const bool begins_as_zip = reader.file_->size() >= first.size() && reader.file_->read(0, first) &&
                                   ByteReader(first).read<std::uint32_t>() == 0x04034b50;
        return begins_as_zip
                   ? reader.refusal("zip.truncated", "the pack is truncated or altered; copy it again")
                   : reader.refusal("zip.not_a_pack", "this is not a pack (not a ZIP container)");
    }
    zlib_filefunc64_def functions = functions_over(*reader.file_);
    reader.zip_ = unzOpen2_64("", &functions);
    if (reader.zip_ == nullptr) {
        return reader.refusal("zip.directory", "the pack's directory is damaged; copy it again");
    }
    TRY_VOID(reader.read_directory());
    return reader;
}

Result<void> ZipReader::read_directory() {
    unz_global_info64 global{};
    unzGetGlobalInfo64(zip_, &global);
    int found = unzGoToFirstFile(zip_);
    for (; found == UNZ_OK; found = unzGoToNextFile(zip_)) {
        unz_file_info64 info{};
        std::string name(max_name_bytes + 1, '\0');
        unz64_file_pos position{};
        if (unzGetCurrentFileInfo64(zip_, &info, name.data(), name.size(), nullptr, 0, nullptr, 0) !=
                UNZ_OK ||
            unzGetFilePos64(zip_, &position) != UNZ_OK) {
            break;
        }
        if (info.size_filename > max_name_bytes) {
            return bad_input("zip.name_length", "an entry's name has {} bytes, allowed are {}",
                             info.size_filename, max_name_bytes);
        }
        name.resize(info.size_filename);
        ZipEntry entry{.name = printable(name),
                       .bytes = info.uncompressed_size,
                       .stored_bytes = info.compressed_size,
                       .position = position.pos_in_zip_directory,
                       .number = position.num_of_file};
        if (!numbers_.emplace(entry.name, entries_.size()).second) {
            return bad_input("zip.entry_twice", "two entries are called {}; the pack is altered", entry.name);
        }
        TRY_VOID(check_entry(entry, info));
        entries_.push_back(std::move(entry));
    }
    if (found != UNZ_END_OF_LIST_OF_FILE || entries_.size() != global.number_entry) {
        return refusal("zip.entries", "the pack's directory is damaged; copy it again");
    }
    return {};
}

const ZipEntry* ZipReader::find(std::string_view name) const {
    const auto number = numbers_.find(name);
    return number != numbers_.end() ? &entries_[number->second] : nullptr;
}

tl::unexpected<Error> ZipReader::damaged(const ZipEntry& entry) const {
    return refusal("zip.entry_damaged", fmt::format("{} is damaged; copy the pack again", entry.name));
}

Result<Bytes> ZipReader::read(const ZipEntry& entry) {
    Bytes bytes(entry.bytes);
    std::size_t filled = 0;
    const auto fill = [&] {
        const std::size_t step = std::min<std::size_t>(bytes.size() - filled, 1U << 30);
        const int count = unzReadCurrentFile(zip_, bytes.data() + filled, static_cast<unsigned>(step));
        filled += count > 0 ? static_cast<std::size_t>(count) : 0;
        return count > 0 && filled < bytes.size();
    };
    const Result<void> whole = read_whole(entry, fill);
    return whole && filled == bytes.size() ? Result<Bytes>(std::move(bytes)) : damaged(entry);
}

Result<void> ZipReader::read_through(const ZipEntry& entry,
                                     const std::function<void(std::span<const std::byte>)>& take) {
    std::array<std::byte, through_step_bytes> step{};
    std::uint64_t taken = 0;
    const auto pass = [&] {
        const std::uint64_t most = std::min<std::uint64_t>(entry.bytes - taken, step.size());
        const int count = unzReadCurrentFile(zip_, step.data(), static_cast<unsigned>(most));
        if (count > 0) {
            take(std::span(step).first(static_cast<std::size_t>(count)));
            taken += static_cast<std::uint64_t>(count);
        }
        return count > 0 && taken < entry.bytes;
    };
    const Result<void> whole = read_whole(entry, pass);
    return whole && taken == entry.bytes ? Result<void>() : damaged(entry);
}

/// `step` reads on and returns true if there is more.
Result<void> ZipReader::read_whole(const ZipEntry& entry, const std::function<bool()>& step) {
    const unz64_file_pos position{entry.position, entry.number};
    if (unzGoToFilePos64(zip_, &position) != UNZ_OK || unzOpenCurrentFile(zip_) != UNZ_OK) {
        return damaged(entry);
    }
    while (entry.bytes > 0 && step()) {
    }
    // There must be no further byte. Closing verifies the checksum, but only if the entry was read to its
    // end.
    std::byte beyond{};
    const bool ends = unzReadCurrentFile(zip_, &beyond, 1) == 0;
    return unzCloseCurrentFile(zip_) == UNZ_OK && ends ? Result<void>() : damaged(entry);
}

} // namespace frustumscreen::pack
