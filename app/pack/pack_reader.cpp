#include "app/pack/pack_reader.h"

#include "app/pack/container/limits.h"
#include "app/pack/container/sha256.h"
#include "app/pack/pack_contents.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::pack {

namespace {

Result<void> check_signature_size(const ZipEntry& entry) {
    return entry.bytes <= max_signature_bytes
               ? Result<void>()
               : bad_input("pack.signature_size", "the signature has {} bytes, allowed are {}", entry.bytes,
                           max_signature_bytes);
}

const PartRecord* find_part(const Manifest& manifest, std::string_view name) {
    const auto part = std::find_if(manifest.parts.begin(), manifest.parts.end(),
                                   [&](const PartRecord& p) { return p.name == name; });
    return part != manifest.parts.end() ? &*part : nullptr;
}

Result<void> check_entries(const ZipReader& zip, const Manifest& manifest) {
    for (const PartRecord& part : manifest.parts) {
        const ZipEntry* entry = zip.find(part.name);
        if (entry == nullptr) {
            return bad_input("pack.part_missing", "the part {} is missing; copy the pack again", part.name);
        }
        if (entry->bytes != part.bytes) {
            return bad_input("pack.part_size", "{} has {} bytes, its manifest says {}; the pack is altered",
                             part.name, entry->bytes, part.bytes);
        }
    }
    std::set<std::string_view> listed;
    for (const PartRecord& part : manifest.parts) {
        listed.insert(part.name);
    }
    for (const ZipEntry& entry : zip.entries()) {
        if (entry.name == signature_name) {
            TRY_VOID(check_signature_size(entry));
        } else if (entry.name != manifest_name && !listed.contains(entry.name)) {
            return bad_input("pack.part_not_listed", "{} is not listed in the manifest; the pack is altered",
                             entry.name);
        }
    }
    return {};
}

} // namespace

Result<Bytes> read_manifest_bytes(ZipReader& zip) {
    if (zip.entries().empty() || zip.entries().front().name != manifest_name) {
        return bad_input("pack.no_manifest", "its first entry is not manifest.json; this is not a pack");
    }
    const ZipEntry& entry = zip.entries().front();
    if (entry.bytes > max_manifest_bytes) {
        return bad_input("pack.manifest_size", "manifest.json has {} bytes, allowed are {}", entry.bytes,
                         max_manifest_bytes);
    }
    return zip.read(entry);
}

Result<std::optional<std::string>> read_signature_entry(ZipReader& zip) {
    const ZipEntry* entry = zip.find(signature_name);
    if (entry == nullptr) {
        return std::optional<std::string>();
    }
    return check_signature_size(*entry)
        .and_then([&] { return zip.read(*entry); })
        .map([](const Bytes& bytes) { return std::optional<std::string>(as_text(bytes)); });
}

Result<void> check_pack_size(std::uint64_t bytes) {
    return bytes <= max_pack_bytes
               ? Result<void>()
               : bad_input("pack.size", "the pack has {} bytes, allowed are {}", bytes, max_pack_bytes);
}

Result<PackReader> PackReader::open(std::span<const std::byte> bytes) {
    return check_pack_size(bytes.size()).and_then([&] { return open(ZipReader::open(bytes)); });
}

Result<PackReader> PackReader::open(OpenFile file) {
    return open(ZipReader::open(std::move(file)));
}

Result<PackReader> PackReader::open(Result<ZipReader> zip) {
    TRY_VOID(zip);
    TRY(const Bytes manifest, read_manifest_bytes(*zip));
    return open(*std::move(zip), manifest);
}

Result<PackReader> PackReader::open(ZipReader zip, std::span<const std::byte> manifest_bytes) {
    TRY(Manifest manifest, at("manifest.json", parse_manifest(as_text(manifest_bytes))));
    TRY_VOID(check_entries(zip, manifest));
    return PackReader(std::move(zip), std::move(manifest));
}

Result<const PartRecord*> PackReader::use(const std::string& name) {
    const PartRecord* part = find_part(manifest_, name);
    if (part == nullptr) {
        return bad_input("pack.part_not_in_manifest",
                         "the manifest refers to the part '{}' and does not list it", printable(name));
    }
    if (!taken_.insert(name).second) {
        return bad_input("pack.part_used_twice", "the manifest uses the part {} twice", name);
    }
    return part;
}

Result<void> PackReader::skip(const std::string& name) {
    return use(name).map([](const PartRecord*) {});
}

Result<Bytes> PackReader::take(const std::string& name) {
    TRY(const PartRecord* const part, use(name));
    Result<Bytes> bytes = zip_.read(*zip_.find(name));
    if (bytes && sha256_hex(*bytes) != part->sha256) {
        return bad_input("pack.part_hash", "{} does not match its hash; the pack is altered", name);
    }
    return bytes;
}

Result<void> PackReader::check(const std::string& name,
                               const std::function<void(std::span<const std::byte>)>& pass) {
    TRY(const PartRecord* const part, use(name));
    Sha256 hash;
    Result<void> read = zip_.read_through(*zip_.find(name), [&](std::span<const std::byte> bytes) {
        hash.add(bytes);
        pass(bytes);
    });
    if (read && hash.hex() != part->sha256) {
        return bad_input("pack.part_hash_in_memory", "{} does not match its hash; the pack is altered", name);
    }
    return read;
}

Result<void> PackReader::finish() const {
    for (const PartRecord& part : manifest_.parts) {
        if (!taken_.contains(part.name)) {
            return bad_input("pack.part_unused", "nothing uses the part {}; the pack is altered", part.name);
        }
    }
    return {};
}

Result<PackReader> open_pack_file(const std::filesystem::path& file) {
    if (std::error_code none; std::filesystem::is_directory(file, none)) {
        return bad_input("pack.folder", file.string() + ": this is a folder; name the *.fspack files in it");
    }
    TRY(OpenFile opened, OpenFile::open(file, max_pack_bytes));
    return at(file.string(), PackReader::open(std::move(opened)));
}

} // namespace frustumscreen::pack

namespace frustumscreen::pack {

Result<std::vector<PackPart>> list_pack_parts(std::span<const std::byte> bytes) {
    TRY(const PackReader reader, PackReader::open(bytes));
    const ZipEntry& manifest = reader.zip().entries().front();
    std::vector<PackPart> parts{{manifest.name, manifest.bytes, manifest.stored_bytes, ""}};
    for (const PartRecord& part : reader.manifest().parts) {
        parts.push_back({.name = part.name,
                         .bytes = part.bytes,
                         .stored_bytes = reader.zip().find(part.name)->stored_bytes,
                         .sha256 = part.sha256});
    }
    return parts;
}

} // namespace frustumscreen::pack
