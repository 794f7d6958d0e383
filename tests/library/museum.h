/// A museum for tests: its key, signed packs, sticks, and an installed set on a disk in memory.
#pragma once

#include "app/library/import_stick.h"
#include "app/library/library_folder.h"
#include "app/pack/container/sha256.h"
#include "app/pack/container/zip_archive.h"
#include "app/pack/sign_pack.h"
#include "app/pack/signature/secret_key.h"
#include "tests/library/volatile_disk.h"
#include "tests/pack/samples.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace frustumscreen::testing_disk {

struct Museum {
    pack::SecretKey key = pack::SecretKey::make();

    [[nodiscard]] std::vector<pack::TrustedKey> keys() const {
        return {{"museum", key.public_key(), std::nullopt}};
    }

    /// A small pack, with `padding` bytes in a further part of its own.
    [[nodiscard]] static Bytes unsigned_pack(const std::string& id, const std::string& title,
                                             std::size_t padding = 0) {
        pack::Pack pack = samples::pack();
        pack.id = id;
        pack.title = title;
        pack.textures = {samples::texture(2, 2, 1, true)};
        pack.relief = {};
        pack.levels = {samples::mesh_level()};
        pack.default_level = 0;
        if (padding > 0) {
            pack.sections = {{"padding", "{}", {"padding.bin"}}};
            Bytes bytes(padding);
            for (std::size_t k = 0; k < padding; ++k) {
                bytes[k] = static_cast<std::byte>((k * k * 2654435761U) >> 13U);
            }
            pack.section_parts = {{"padding.bin", std::move(bytes)}};
        }
        return samples::bytes_of(pack);
    }
    [[nodiscard]] static Bytes signed_by(const pack::SecretKey& key, const Bytes& pack,
                                         std::uint64_t serial) {
        Result<pack::ZipReader> zip = pack::ZipReader::open(pack);
        const Bytes manifest = zip->read(zip->entries().front()).value();
        return pack::with_signature(pack, key.sign(manifest, fmt::format("serial:{}", serial))).value();
    }
    [[nodiscard]] Bytes pack(const std::string& id, std::uint64_t serial, std::size_t padding = 0) const {
        return signed_by(key, unsigned_pack(id, fmt::format("{} {}", id, serial), padding), serial);
    }
    void put_exhibit(VolatileDisk& stick, std::string_view text, std::uint64_t serial) const {
        stick.put("exhibit.toml", text);
        stick.put("exhibit.toml.minisig", key.sign(as_bytes(text), fmt::format("serial:{}", serial)));
    }
};

/// The pack with one byte of the padding changed, and a valid checksum in the container.
inline Bytes with_another_part(const Bytes& pack) {
    Result<pack::ZipReader> zip = pack::ZipReader::open(pack);
    pack::ZipWriter other;
    for (const pack::ZipEntry& entry : zip->entries()) {
        Bytes part = zip->read(entry).value();
        if (entry.name == "padding.bin") {
            part[0] ^= std::byte{1};
        }
        other.add(entry.name, part, pack::Packing::Stored);
    }
    return other.finish().value();
}

inline library::ImportRequest request_of(const Museum& museum) {
    library::ImportRequest request;
    request.import_id = "1";
    request.keys = museum.keys();
    request.limits.step_bytes = 2048;
    return request;
}

/// The clock stands still.
inline library::ImportEnvironment quiet_environment() {
    return {[] { return MonotonicTime(); }, [] { return Nanoseconds(0); },
            [](const library::ImportReport&) {}};
}

inline library::ImportReport import_quietly(FileTree& stick, WritableTree& library,
                                            const library::ImportRequest& request) {
    return library::import_stick(stick, library, request, quiet_environment());
}

inline const library::ImportedPack& line_of(const library::ImportReport& report, const std::string& file) {
    for (const library::ImportedPack& pack : report.packs) {
        if (pack.file == file) {
            return pack;
        }
    }
    ADD_FAILURE() << file << " is not in the report";
    static const library::ImportedPack none;
    return none;
}

/// Id and serial of each pack in the set, in order; "-" if it has no id.
inline std::vector<std::string> ids_of(const library::InstalledSet& set) {
    std::vector<std::string> ids;
    for (const library::InstalledPack& pack : set.packs) {
        ids.push_back(fmt::format("{} {}", pack.id.empty() ? "-" : pack.id, pack.serial));
    }
    return ids;
}

/// Checks that the files named by set.txt are all there, byte by byte; empty if they are. Computes each content's
/// hash once.
class Inspector {
public:
    [[nodiscard]] std::string fault_of(VolatileDisk& disk) {
        const tl::expected<library::SetFile, library::ImportFailure> file = library::read_set_file(disk);
        if (!file) {
            return file.error().reason;
        }
        std::string fault = fault_of(disk, file->choice.set);
        for (const std::optional<library::InstalledSet>& set : {file->choice.last_good, file->before}) {
            if (set && fault.empty()) {
                fault = fault_of(disk, *set);
            }
        }
        return fault;
    }

private:
    std::string fault_of(const VolatileDisk& disk, const library::InstalledSet& set) {
        for (const library::InstalledPack& pack : set.packs) {
            const std::optional<Content> content = disk.content(pack.file);
            if (!content) {
                return pack.file + " is missing";
            }
            const auto [known, is_new] = hashes_.try_emplace(*content);
            if (is_new) {
                known->second = pack::sha256_hex(**content);
            }
            if (known->second != pack.sha256 || (*content)->size() != pack.bytes) {
                return pack.file + " has other bytes";
            }
        }
        return "";
    }
    std::map<Content, std::string> hashes_;
};

inline library::InstalledSet installed(VolatileDisk& disk) {
    const tl::expected<library::SetFile, library::ImportFailure> file = library::read_set_file(disk);
    EXPECT_TRUE(file) << (file ? "" : file.error().reason);
    return file ? library::set_to_show(file->choice, library::read_verdict(disk).value_or(std::nullopt))
                : library::InstalledSet();
}

inline void judge(VolatileDisk& disk, library::TrialState verdict, int starts = 1) {
    const library::SetFile file = library::read_set_file(disk).value_or(library::SetFile());
    disk.put(std::string(library::verdict_file_name),
             library::write_verdict({file.choice.set.number, verdict, starts, ""}));
}

} // namespace frustumscreen::testing_disk
