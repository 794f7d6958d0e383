#include "app/pack/zip_archive.h"

#include "app/pack/limits.h"
#include "firmware_host/base/byte_reader.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <unzip.h>
#include <zip.h>

#include <algorithm>
#include <cstring>
#include <set>

namespace frustumscreen::pack_format {

/// Either a growing buffer (writing) or a view (reading), and the library's cursor in it.
struct MemoryFile {
    Bytes written;
    std::span<const std::byte> view;
    bool writing = false;
    std::uint64_t cursor = 0;
    [[nodiscard]] std::uint64_t size() const { return writing ? written.size() : view.size(); }
};

namespace {

constexpr int deflate_level = 1; ///< Z_BEST_SPEED: a part is packed once and unpacked at every start
constexpr uLong first_of_1980 = (1U << 21) | (1U << 16); ///< MS-DOS date, midnight: the earliest there is
constexpr uLong encrypted_flag = 1;
/// Deflate never packs tighter than 1032 to 1 (zlib's technical details); an archive that claims more is
/// wrong.
constexpr std::uint64_t most_deflate_ratio = 1032;
constexpr std::size_t end_record_bytes = 22;

MemoryFile& file_of(voidpf opaque) {
    return *static_cast<MemoryFile*>(opaque);
}

voidpf open_memory(voidpf opaque, const void*, int) {
    return opaque;
}

uLong read_memory(voidpf opaque, voidpf, void* out, uLong size) {
    MemoryFile& file = file_of(opaque);
    const std::uint64_t left = file.size() - std::min(file.cursor, file.size());
    const std::uint64_t count = std::min<std::uint64_t>(size, left);
    if (count > 0) {
        const std::byte* bytes = file.writing ? file.written.data() : file.view.data();
        std::memcpy(out, bytes + file.cursor, count);
    }
    file.cursor += count;
    return count;
}

uLong write_memory(voidpf opaque, voidpf, const void* in, uLong size) {
    MemoryFile& file = file_of(opaque);
    if (!file.writing) {
        return 0;
    }
    if (file.cursor + size > file.written.size()) {
        file.written.resize(file.cursor + size);
    }
    if (size > 0) {
        std::memcpy(file.written.data() + file.cursor, in, size);
    }
    file.cursor += size;
    return size;
}

ZPOS64_T tell_memory(voidpf opaque, voidpf) {
    return file_of(opaque).cursor;
}

long seek_memory(voidpf opaque, voidpf, ZPOS64_T offset, int origin) {
    MemoryFile& file = file_of(opaque);
    const std::uint64_t from = origin == ZLIB_FILEFUNC_SEEK_CUR   ? file.cursor
                               : origin == ZLIB_FILEFUNC_SEEK_END ? file.size()
                                                                  : 0;
    const std::uint64_t target = from + offset;
    if (target < from || target > file.size()) {
        return -1;
    }
    file.cursor = target;
    return 0;
}

int close_memory(voidpf, voidpf) {
    return 0;
}
int no_error(voidpf, voidpf) {
    return 0;
}

zlib_filefunc64_def functions_over(MemoryFile& file) {
    zlib_filefunc64_def functions{};
    functions.zopen64_file = open_memory;
    functions.zread_file = read_memory;
    functions.zwrite_file = write_memory;
    functions.ztell64_file = tell_memory;
    functions.zseek64_file = seek_memory;
    functions.zclose_file = close_memory;
    functions.zerror_file = no_error;
    functions.opaque = &file;
    return functions;
}

/// The end record is the last thing in the file and its directory ends where it begins (APPNOTE.TXT 4.3.16):
/// nothing was cut off, put in front or added behind.
bool is_whole(std::span<const std::byte> bytes) {
    if (bytes.size() < end_record_bytes) {
        return false;
    }
    const std::span<const std::byte> end = bytes.last(end_record_bytes);
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
        return bad_input(fmt::format("{} is encrypted; packs are not", entry.name));
    }
    const bool stored = info.compression_method == 0;
    if (!stored && info.compression_method != Z_DEFLATED) {
        return bad_input(fmt::format("{} is packed by ZIP method {}; allowed are stored and deflated",
                                     entry.name, info.compression_method));
    }
    const std::uint64_t most = stored ? entry.stored_bytes : entry.stored_bytes * most_deflate_ratio;
    if (entry.bytes > most || (stored && entry.bytes != entry.stored_bytes)) {
        return bad_input(
            fmt::format("{} claims {} bytes, more than its {} packed bytes can hold; the pack is altered",
                        entry.name, entry.bytes, entry.stored_bytes));
    }
    return {};
}

} // namespace

ZipWriter::ZipWriter() : file_(std::make_unique<MemoryFile>()) {
    file_->writing = true;
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

Result<Bytes> ZipWriter::finish() {
    const bool closed = zip_ != nullptr && zipClose(zip_, nullptr) == ZIP_OK;
    zip_ = nullptr;
    if (!good_ || !closed) {
        return fail(ErrorKind::Internal, "the ZIP library could not write the pack in memory");
    }
    return std::move(file_->written);
}

ZipReader::ZipReader() : file_(std::make_unique<MemoryFile>()) {}
ZipReader::ZipReader(ZipReader&& other) noexcept
    : file_(std::move(other.file_)), zip_(std::exchange(other.zip_, nullptr)),
      entries_(std::move(other.entries_)) {}
ZipReader::~ZipReader() {
    if (zip_ != nullptr) {
        unzClose(zip_);
    }
}

Result<ZipReader> ZipReader::open(std::span<const std::byte> bytes) {
    if (!is_whole(bytes)) {
        const bool began_as_zip = ByteReader(bytes).read<std::uint32_t>() == 0x04034b50;
        return bad_input(began_as_zip ? "the pack is truncated or altered; copy it again"
                                      : "this is not a pack (not a ZIP container)");
    }
    ZipReader reader;
    reader.file_->view = bytes;
    zlib_filefunc64_def functions = functions_over(*reader.file_);
    reader.zip_ = unzOpen2_64("", &functions);
    if (reader.zip_ == nullptr) {
        return bad_input("the pack's directory is damaged; copy it again");
    }
    if (const Result<void> directory = reader.read_directory(); !directory) {
        return tl::unexpected(directory.error());
    }
    return reader;
}

Result<void> ZipReader::read_directory() {
    unz_global_info64 global{};
    unzGetGlobalInfo64(zip_, &global);
    std::set<std::string> names;
    int found = unzGoToFirstFile(zip_);
    for (; found == UNZ_OK; found = unzGoToNextFile(zip_)) {
        unz_file_info64 info{};
        std::string name(most_name_bytes + 1, '\0');
        unz64_file_pos position{};
        if (unzGetCurrentFileInfo64(zip_, &info, name.data(), name.size(), nullptr, 0, nullptr, 0) !=
                UNZ_OK ||
            unzGetFilePos64(zip_, &position) != UNZ_OK) {
            break;
        }
        if (info.size_filename > most_name_bytes) {
            return bad_input(fmt::format("an entry's name has {} bytes, allowed are {}", info.size_filename,
                                         most_name_bytes));
        }
        name.resize(info.size_filename);
        ZipEntry entry{printable(name), info.uncompressed_size, info.compressed_size,
                       position.pos_in_zip_directory, position.num_of_file};
        if (!names.insert(entry.name).second) {
            return bad_input(fmt::format("two entries are called {}; the pack is altered", entry.name));
        }
        if (auto sound = check_entry(entry, info); !sound) {
            return sound;
        }
        entries_.push_back(std::move(entry));
    }
    if (found != UNZ_END_OF_LIST_OF_FILE || entries_.size() != global.number_entry) {
        return bad_input("the pack's directory is damaged; copy it again");
    }
    return {};
}

const ZipEntry* ZipReader::find(std::string_view name) const {
    const auto entry =
        std::find_if(entries_.begin(), entries_.end(), [&](const ZipEntry& e) { return e.name == name; });
    return entry != entries_.end() ? &*entry : nullptr;
}

Result<Bytes> ZipReader::read(const ZipEntry& entry) {
    const unz64_file_pos position{entry.position, entry.number};
    Bytes bytes(entry.bytes);
    bool good = unzGoToFilePos64(zip_, &position) == UNZ_OK && unzOpenCurrentFile(zip_) == UNZ_OK;
    if (good) {
        std::size_t filled = 0;
        int count = 1;
        while (filled < bytes.size() && count > 0) {
            const std::size_t step = std::min<std::size_t>(bytes.size() - filled, 1U << 30);
            count = unzReadCurrentFile(zip_, bytes.data() + filled, static_cast<unsigned>(step));
            filled += count > 0 ? static_cast<std::size_t>(count) : 0;
        }
        // There must not be one byte more. Closing compares the checksum, but only if the entry was read to
        // its end.
        std::byte beyond{};
        good = filled == bytes.size() && unzReadCurrentFile(zip_, &beyond, 1) == 0;
        good = unzCloseCurrentFile(zip_) == UNZ_OK && good;
    }
    if (!good) {
        return bad_input(fmt::format("{} is damaged; copy the pack again", entry.name));
    }
    return bytes;
}

} // namespace frustumscreen::pack_format
