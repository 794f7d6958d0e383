#include "app/library/copy_pack.h"

#include "app/library/library_folder.h"
#include "app/pack/check_parts.h"
#include "app/pack/container/sha256.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace frustumscreen::library {

namespace {

/// Keeps the first fault, which the ZIP library would lose.
class WatchedContent final : public FileContent {
public:
    WatchedContent(std::unique_ptr<const FileContent> content, int& fault)
        : content_(std::move(content)), fault_(fault) {}
    [[nodiscard]] std::uint64_t bytes() const override { return content_->bytes(); }
    [[nodiscard]] int read(std::uint64_t offset, std::span<std::byte> out) const override {
        const int failed = content_->read(offset, out);
        fault_ = fault_ != 0 ? fault_ : failed;
        return failed;
    }

private:
    std::unique_ptr<const FileContent> content_;
    int& fault_;
};

/// A pack of which only the signature is checked so far, and the size of its file.
struct WatchedPack {
    tl::expected<pack::SignedPack, pack::PackRefusal> pack;
    std::uint64_t bytes = 0;
};

FileResult<WatchedPack> open_watched(FileTree& tree, const std::string& path, const pack::PackTrust& trust,
                                     int& fault) {
    TRY(std::unique_ptr<const FileContent> content, tree.open(path));
    const std::uint64_t bytes = content->bytes();
    WatchedPack watched{
        pack::open_signed_pack(OpenFile(std::make_unique<WatchedContent>(std::move(content), fault)), trust),
        bytes};
    if (fault != 0) {
        return file_fault(fault);
    }
    return watched;
}

InstalledPack described(const pack::SignedPack& opened, std::uint64_t bytes) {
    InstalledPack pack;
    pack.id = opened.description().id;
    pack.title = opened.description().title;
    pack.serial = opened.serial();
    pack.bytes = bytes;
    pack.manifest_sha256 = opened.manifest_sha256;
    return pack;
}

tl::unexpected<ImportFailure> changed() {
    return failed(
        {.refusal = ImportRefusal::Altered,
         .reason = "the stick held something else when it was read again; copy the pack onto another stick",
         .whole = false});
}

/// Returns the hash of the bytes written.
tl::expected<std::string, ImportFailure> copy_bytes(const FileContent& from, const StickPack& pack,
                                                    NewFile& to, std::size_t step_bytes,
                                                    const CopyObserver& ears) {
    Bytes step(std::min<std::uint64_t>(step_bytes, pack.pack.bytes));
    pack::Sha256 hash;
    for (std::uint64_t at = 0; at < pack.pack.bytes; at += step.size()) {
        step.resize(std::min<std::uint64_t>(step.size(), pack.pack.bytes - at));
        const MonotonicTime began = ears.now();
        if (const int fault = from.read(at, step); fault != 0) {
            return failed(stick_failure(pack.path, {fault}));
        }
        const Nanoseconds reading = ears.now() - began;
        if (const FileResult<void> written = to.append(step); !written) {
            return failed(disk_failure(incoming_file_name, written.error()));
        }
        hash.add(step);
        if (std::optional<ImportFailure> failure = ears.copied(step.size(), reading)) {
            return failed(*std::move(failure));
        }
    }
    if (const FileResult<void> synced = to.sync(); !synced) {
        return failed(disk_failure(incoming_file_name, synced.error()));
    }
    return hash.hex();
}

tl::expected<std::string, ImportFailure> copy_file(FileTree& stick, WritableTree& library,
                                                   const StickPack& pack, std::size_t step_bytes,
                                                   const CopyObserver& ears) {
    const FileResult<std::unique_ptr<const FileContent>> from = stick.open(pack.path);
    if (!from) {
        return failed(stick_failure(pack.path, from.error()));
    }
    if ((*from)->bytes() != pack.pack.bytes) {
        return changed();
    }
    const FileResult<std::unique_ptr<NewFile>> to = library.create(std::string(incoming_file_name));
    if (!to) {
        return failed(disk_failure(incoming_file_name, to.error()));
    }
    return copy_bytes(**from, pack, **to, step_bytes, ears);
}

std::uint64_t unpacked_bytes(const pack::Manifest& manifest) {
    std::uint64_t sum = 0;
    for (const pack::PartRecord& part : manifest.parts) {
        sum += part.bytes;
    }
    return sum;
}

/// Reads the copy alone.
tl::expected<InstalledPack, ImportFailure> check_copy(WritableTree& library, const StickPack& pack,
                                                      const pack::PackTrust& trust, std::size_t step_bytes,
                                                      const CopyObserver& ears) {
    int fault = 0;
    FileResult<WatchedPack> opened = open_watched(library, std::string(incoming_file_name), trust, fault);
    if (!opened) {
        return failed(disk_failure(incoming_file_name, opened.error()));
    }
    if (!opened->pack) {
        return failed(failure_of(opened->pack.error()));
    }
    InstalledPack copied = described(*opened->pack, opened->bytes);
    if (!(copied == pack.pack)) {
        return changed();
    }
    const std::uint64_t all = unpacked_bytes(opened->pack->reader.manifest());
    std::uint64_t unpacked = 0;
    std::uint64_t told = 0;
    const Result<void> good = pack::check_parts(opened->pack->reader, [&](std::uint64_t bytes) {
        unpacked += bytes;
        const auto share = static_cast<double>(unpacked) / static_cast<double>(std::max(all, unpacked));
        const auto now = static_cast<std::uint64_t>(share * static_cast<double>(copied.bytes));
        if (now >= told + std::min<std::uint64_t>(step_bytes, copied.bytes)) {
            ears.checked(now - told);
            told = now;
        }
    });
    if (fault != 0) {
        return failed(disk_failure(incoming_file_name, {fault}));
    }
    if (!good) {
        return failed({.refusal = ImportRefusal::Altered, .reason = good.error().message, .whole = false});
    }
    return copied;
}

} // namespace

tl::expected<StickPack, ImportFailure> look_at_pack(FileTree& tree, const std::string& path,
                                                    const pack::PackTrust& trust) {
    int fault = 0;
    const FileResult<WatchedPack> opened = open_watched(tree, path, trust, fault);
    if (!opened) {
        return failed(stick_failure(path, opened.error()));
    }
    if (!opened->pack) {
        return failed(failure_of(opened->pack.error()));
    }
    StickPack pack{.path = path,
                   .pack = described(*opened->pack, opened->bytes),
                   .is_signed = opened->pack->signer.has_value(),
                   .told = {}};
    pack.told.file = printable(path);
    pack.told.title = printable(pack.pack.title, 1000);
    return pack;
}

tl::expected<InstalledPack, ImportFailure> copy_pack(FileTree& stick, WritableTree& library,
                                                     const StickPack& pack, const pack::PackTrust& trust,
                                                     std::size_t step_bytes, const CopyObserver& ears) {
    TRY(const std::string hash, copy_file(stick, library, pack, step_bytes, ears));
    TRY(InstalledPack copied, check_copy(library, pack, trust, step_bytes, ears));
    copied.sha256 = hash;
    copied.file = installed_file_name(hash);
    if (const FileResult<void> named = library.rename(std::string(incoming_file_name), copied.file); !named) {
        return failed(disk_failure(copied.file, named.error()));
    }
    return copied;
}

} // namespace frustumscreen::library
