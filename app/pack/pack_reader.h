/// The container of a pack, open: its manifest, and its parts one at a time, each checked against its hash.
///
/// Errors   one line naming the part.
/// Threads  one caller.
#pragma once

#include "app/pack/container/zip_archive.h"
#include "app/pack/manifest.h"

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>

namespace frustumscreen::pack {

/// The bytes of manifest.json, not parsed.
[[nodiscard]] Result<Bytes> read_manifest_bytes(ZipReader& zip);
/// The bytes of the entry `signature`; nothing if there is none.
[[nodiscard]] Result<std::optional<std::string>> read_signature_entry(ZipReader& zip);

class PackReader {
public:
    /// Reads the manifest, and checks that it lists exactly the parts of the container, with their sizes.
    /// `bytes` must outlive the reader.
    [[nodiscard]] static Result<PackReader> open(std::span<const std::byte> bytes);
    /// Reads only the requested parts of the file. Messages do not begin with its name.
    [[nodiscard]] static Result<PackReader> open(OpenFile file);
    /// As above, with the bytes that read_manifest_bytes returned for `zip`, so that a caller that has checked them
    /// uses the same ones.
    [[nodiscard]] static Result<PackReader> open(ZipReader zip, std::span<const std::byte> manifest);

    [[nodiscard]] const Manifest& manifest() const { return manifest_; }
    [[nodiscard]] const ZipReader& zip() const { return zip_; }
    /// A part's bytes; each part can be taken once.
    [[nodiscard]] Result<Bytes> take(const std::string& name);
    /// Checks a part against its hash without keeping it; otherwise as take(). `pass` gets the bytes piece by
    /// piece; they are valid only if the check succeeds.
    [[nodiscard]] Result<void> check(const std::string& name,
                                     const std::function<void(std::span<const std::byte>)>& pass);
    /// Counts a part as used without reading its bytes; each part can be taken or skipped once.
    [[nodiscard]] Result<void> skip(const std::string& name);
    /// The bytes of the entry `signature`, unchecked; nothing if there is none.
    [[nodiscard]] Result<std::optional<std::string>> signature() { return read_signature_entry(zip_); }
    /// Refuses parts without a reference to them.
    [[nodiscard]] Result<void> finish() const;

private:
    PackReader(ZipReader zip, Manifest manifest) : zip_(std::move(zip)), manifest_(std::move(manifest)) {}
    static Result<PackReader> open(Result<ZipReader> zip);
    [[nodiscard]] Result<const PartRecord*> use(const std::string& name);
    ZipReader zip_;
    Manifest manifest_;
    std::set<std::string> taken_;
};

/// Refuses a file larger than a pack may be.
[[nodiscard]] Result<void> check_pack_size(std::uint64_t bytes);

/// Errors: as PackReader::open; a folder; a file that cannot be opened. Messages begin with the file's name.
[[nodiscard]] Result<PackReader> open_pack_file(const std::filesystem::path& file);

} // namespace frustumscreen::pack
