// Seeded mutants of signed packs: none is accepted if its unpacked parts or trusted comment differ from the
// signed ones.
#include "app/pack/pack_reader.h"
#include "tests/signature/signature_testing.h"

#include <array>
#include <cstring>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FRUSTUMSCREEN_FEWER_MUTANTS 20
#else
#define FRUSTUMSCREEN_FEWER_MUTANTS 1
#endif

namespace frustumscreen::pack {
namespace {

using pack::Packing;
using pack::ZipReader;
using pack::ZipWriter;
using testing::comment_of;
using testing::signed_pack;

constexpr int all_mutants = 100'000 / FRUSTUMSCREEN_FEWER_MUTANTS;

using Entries = std::vector<std::pair<std::string, Bytes>>;

/// A signed pack and all its unpacked contents.
struct Original {
    Bytes bytes;
    Entries entries; ///< in order
    std::string comment;
};

/// A minimal pack, so many mutants hit relevant bytes.
Pack small_pack() {
    Pack pack = samples::pack();
    pack.levels.pop_back();
    pack.textures.pop_back();
    pack.relief = {};
    pack.default_level = 0;
    return pack;
}

Original original(const Pack& pack, const SecretKey& key, std::uint64_t serial) {
    Original made{signed_pack(pack, key, serial), {}, comment_of(serial)};
    auto zip = ZipReader::open(made.bytes);
    for (const pack::ZipEntry& entry : zip->entries()) {
        made.entries.emplace_back(entry.name, zip->read(entry).value());
    }
    return made;
}

Bytes zip_of(const Entries& entries) {
    ZipWriter zip;
    for (const auto& [name, bytes] : entries) {
        zip.add(name, bytes, name.ends_with(".bin") ? Packing::Deflated : Packing::Stored);
    }
    return zip.finish().value();
}

class Mutator {
public:
    Mutator(std::vector<Original> originals, unsigned seed)
        : originals_(std::move(originals)), random_(seed) {}

    Bytes mutant() {
        const Original& from = originals_[random_() % originals_.size()];
        switch (random_() % 6) {
        case 0:
            return flipped(from.bytes, 0, from.bytes.size());
        case 1: // the directory and its end
            return flipped(from.bytes, directory_of(from.bytes), from.bytes.size());
        case 2:
            return spliced(from.bytes);
        case 3:
            return with_text_mutated(from);
        case 4:
            return recombined(from);
        default:
            return with_directory_edited(from.bytes);
        }
    }
    [[nodiscard]] const std::vector<Original>& originals() const { return originals_; }

private:
    static std::size_t directory_of(const Bytes& zip) {
        std::uint32_t offset = 0;
        std::memcpy(&offset, zip.data() + zip.size() - 6, sizeof offset);
        return offset;
    }

    Bytes flipped(Bytes bytes, std::size_t from, std::size_t to) {
        for (unsigned k = 0; k < 1 + random_() % 3; ++k) {
            bytes[from + random_() % (to - from)] ^= static_cast<std::byte>(1U << (random_() % 8));
        }
        return bytes;
    }

    /// Truncates, removes, inserts or duplicates bytes.
    Bytes spliced(Bytes bytes) {
        const std::size_t at = random_() % bytes.size();
        const std::size_t count = std::min<std::size_t>(1 + random_() % 64, bytes.size() - at);
        const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        switch (random_() % 4) {
        case 0:
            bytes.resize(at);
            break;
        case 1:
            bytes.erase(place, place + static_cast<std::ptrdiff_t>(count));
            break;
        case 2:
            bytes.insert(place, count, static_cast<std::byte>(random_()));
            break;
        default: {
            const Bytes run(place, place + static_cast<std::ptrdiff_t>(count));
            std::copy(run.begin(), run.end(),
                      bytes.begin() + static_cast<std::ptrdiff_t>(random_() % (bytes.size() - count + 1)));
        }
        }
        return bytes;
    }

    /// Checksums are valid: the entry itself is changed.
    Bytes with_text_mutated(const Original& from) {
        Entries entries = from.entries;
        Bytes& bytes =
            random_() % 2 == 0 ? entries.back().second : entries[random_() % entries.size()].second;
        switch (random_() % 3) {
        case 0:
            bytes[random_() % bytes.size()] ^= static_cast<std::byte>(1U << (random_() % 8));
            break;
        case 1:
            bytes.resize(random_() % bytes.size());
            break;
        default:
            bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(random_() % bytes.size()),
                         static_cast<std::byte>(" \t\n\r0A:"[random_() % 7]));
        }
        return zip_of(entries);
    }

    /// Entries, and lines of the signature, from all originals: in another order, omitted, or twice under
    /// different names.
    Bytes recombined(const Original& from) {
        Entries entries = from.entries;
        const Original& other = originals_[random_() % originals_.size()];
        const std::size_t at = random_() % entries.size();
        switch (random_() % 5) {
        case 0:
            entries[at].second = other.entries[random_() % other.entries.size()].second;
            break;
        case 1:
            entries.back().second = with_lines_of(entries.back().second, other.entries.back().second);
            break;
        case 2:
            std::swap(entries[at], entries[random_() % entries.size()]);
            break;
        case 3:
            entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(at));
            break;
        default:
            std::swap(entries[at].second, entries[random_() % entries.size()].second);
        }
        return zip_of(entries);
    }

    Bytes with_lines_of(const Bytes& signature, const Bytes& other) {
        std::string mixed;
        for (std::size_t line = 0; line < 4; ++line) {
            mixed += line_of(as_text(random_() % 2 == 0 ? signature : other), line) + "\n";
        }
        return samples::some_bytes(mixed);
    }
    static std::string line_of(std::string_view text, std::size_t number) {
        for (; number > 0; --number) {
            text.remove_prefix(text.find('\n') + 1);
        }
        return std::string(text.substr(0, text.find('\n')));
    }

    /// A field of one entry in the directory gets the value of another entry, or a random one.
    Bytes with_directory_edited(Bytes bytes) {
        std::vector<std::size_t> records;
        for (std::size_t at = directory_of(bytes); bytes[at + 2] == std::byte{1};) { // PK 01 02
            records.push_back(at);
            std::uint16_t name_bytes = 0;
            std::memcpy(&name_bytes, bytes.data() + at + 28, sizeof name_bytes);
            at += 46U + name_bytes;
        }
        static constexpr std::array<std::pair<std::size_t, std::size_t>, 8> fields{
            {{8, 2}, {10, 2}, {16, 4}, {20, 4}, {24, 4}, {28, 2}, {42, 4}, {46, 8}}}; // APPNOTE.TXT 4.3.12
        const auto [field, size] = fields[random_() % fields.size()];
        const std::size_t to = records[random_() % records.size()] + field;
        if (random_() % 3 == 0) {
            bytes[to + random_() % size] = static_cast<std::byte>(random_());
        } else {
            const std::size_t from = records[random_() % records.size()] + field;
            std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(from), size,
                        bytes.begin() + static_cast<std::ptrdiff_t>(to));
        }
        return bytes;
    }

    std::vector<Original> originals_;
    std::mt19937 random_;
};

/// True if all unpacked parts and the comment are those of one original, by name.
bool is_one_of(const std::vector<Original>& originals, const std::string& comment, const Entries& parts,
               const PackDescription& description) {
    return std::any_of(originals.begin(), originals.end(), [&](const Original& original) {
        const auto holds = [&](const std::pair<std::string, Bytes>& part) {
            return std::find(original.entries.begin(), original.entries.end(), part) !=
                   original.entries.end();
        };
        const bool all = parts.size() + 2 == original.entries.size(); // without manifest and signature
        auto opened = pack::PackReader::open(std::span<const std::byte>(original.bytes));
        return all && comment == original.comment && std::all_of(parts.begin(), parts.end(), holds) &&
               opened->manifest().description == description;
    });
}

TEST(SignedMutants, AreRejectedOrUnpackToASignedOriginal) {
    const SecretKey key = SecretKey::make();
    const SecretKey stranger = SecretKey::make();
    Pack other = small_pack();
    other.title = "Another";
    other.textures[0].texels[0].r ^= 1U;
    std::vector<Original> originals{original(small_pack(), key, 1), original(small_pack(), key, 2),
                                    original(other, key, 3), original(other, stranger, 4)};
    Mutator mutator(originals, 105);
    originals.pop_back(); // the stranger is not trusted
    const std::vector<TrustedKey> keys{testing::trusted(key)};
    int opened_count = 0;
    int accepted = 0;
    for (int k = 0; k < all_mutants && !HasFatalFailure(); ++k) {
        const Bytes mutant = mutator.mutant();
        auto opened = open_signed_pack(mutant, {keys, std::nullopt});
        if (!opened) {
            ASSERT_TRUE(samples::is_one_line(opened.error().error.message)) << opened.error().error.message;
            continue;
        }
        ++opened_count;
        Entries parts;
        bool sound = true;
        for (const pack::PartRecord& record : opened->reader.manifest().parts) {
            Result<Bytes> part = opened->reader.take(record.name);
            sound = sound && part;
            parts.emplace_back(record.name, part ? *std::move(part) : Bytes());
        }
        if (!sound) {
            continue;
        }
        ++accepted;
        ASSERT_TRUE(is_one_of(originals, opened->signer->trusted_comment, parts, opened->description())) << k;
    }
    // The test must cover more than broken containers, and must not accept too much.
    EXPECT_GT(opened_count, all_mutants / 20);
    EXPECT_GT(accepted, all_mutants / 100);
    EXPECT_LT(accepted, all_mutants / 4);
    RecordProperty("mutants", all_mutants);
    RecordProperty("opened", opened_count);
    RecordProperty("accepted", accepted);
}

} // namespace
} // namespace frustumscreen::pack
