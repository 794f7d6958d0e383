/// The container of a pack, opened: its manifest, and its parts one at a time, each checked against its hash.
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

namespace frustumscreen::pack_format {

/// The bytes of manifest.json, and nothing of what they say.
[[nodiscard]] Result<Bytes> read_manifest_bytes(ZipReader& zip);
/// The bytes of the entry `signature`; nothing if there is none.
[[nodiscard]] Result<std::optional<std::string>> read_signature_entry(ZipReader& zip);

class PackReader {
public:
    /// Reads the manifest, and checks that the parts are exactly those that it lists, with the sizes that it
    /// lists. `bytes` must outlive the reader.
    [[nodiscard]] static Result<PackReader> open(std::span<const std::byte> bytes);
    /// Reads of the file what is asked for and no more. Messages do not begin with its name.
    [[nodiscard]] static Result<PackReader> open(OpenFile file);
    /// As above, with the bytes that read_manifest_bytes gave for `zip`: who checked them first uses the same ones.
    [[nodiscard]] static Result<PackReader> open(ZipReader zip, std::span<const std::byte> manifest);

    [[nodiscard]] const Manifest& manifest() const { return manifest_; }
    [[nodiscard]] const ZipReader& zip() const { return zip_; }
    /// A part's bytes; each part can be taken once.
    [[nodiscard]] Result<Bytes> take(const std::string& name);
    /// Holds a part against its hash without keeping it; else as take(). `pass` gets its bytes, some at a time; they count only
    /// if all is well in the end.
    [[nodiscard]] Result<void> check(const std::string& name,
                                     const std::function<void(std::span<const std::byte>)>& pass);
    /// Counts a part as used without reading its bytes; each part can be taken or passed over once.
    [[nodiscard]] Result<void> pass_over(const std::string& name);
    /// The bytes of the entry `signature`, unchecked; nothing if there is none.
    [[nodiscard]] Result<std::optional<std::string>> signature() { return read_signature_entry(zip_); }
    /// Refuses parts that nothing refers to.
    [[nodiscard]] Result<void> finish() const;

private:
    PackReader(ZipReader zip, Manifest manifest) : zip_(std::move(zip)), manifest_(std::move(manifest)) {}
    static Result<PackReader> open(Result<ZipReader> zip);
    [[nodiscard]] Result<const PartRecord*> use(const std::string& name);
    ZipReader zip_;
    Manifest manifest_;
    std::set<std::string> taken_;
};

/// Refuses a file of more bytes than a pack may have.
[[nodiscard]] Result<void> check_pack_size(std::uint64_t bytes);

/// Errors: as PackReader::open; a folder; what cannot be opened. Messages begin with the file's name.
[[nodiscard]] Result<PackReader> open_pack_file(const std::filesystem::path& file);

} // namespace frustumscreen::pack_format
