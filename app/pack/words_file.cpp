#include "app/pack/words_file.h"

#include "app/pack/container/limits.h"
#include "app/pack/container/sha256.h"
#include "app/pack/container/zip_archive.h"
#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace frustumscreen::pack {

namespace {

constexpr std::string_view manifest_entry = "manifest.json";
constexpr std::string_view format_name = "FrustumScreen words";
constexpr std::uint64_t words_version = 1;
constexpr std::uint64_t max_words_manifest_bytes = 4U << 20;
constexpr std::uint64_t max_words_part_bytes = 32U << 20;

struct Part {
    std::string name;
    std::uint64_t bytes = 0; ///< unpacked
    std::string sha256;      ///< of the unpacked bytes
};

struct SoundPart {
    std::string key;
    Part part;
};

struct LanguageEntry {
    std::string language;
    std::string name;
    std::vector<PlainWord> words;
    Part glyphs;
    Part atlas; ///< empty if the texts have no letters
    std::vector<SoundPart> sounds;
};

void part_fields(auto& fields, auto& part) {
    fields.text("name", part.name);
    fields.whole("bytes", part.bytes, max_words_part_bytes);
    fields.text("sha256", part.sha256);
}

void language_fields(auto& fields, auto& entry) {
    fields.text("language", entry.language);
    fields.text("name", entry.name);
    fields.objects("words", entry.words, glyph_limits::max_texts, [](auto& item, auto& word) {
        item.text("key", word.key);
        item.text("text", word.text);
        item.text("language", word.language);
    });
    fields.object("glyphs", [&](auto& part) { part_fields(part, entry.glyphs); });
    fields.object("atlas", [&](auto& part) { part_fields(part, entry.atlas); });
    fields.objects("sounds", entry.sounds, glyph_limits::max_texts, [](auto& item, auto& sound) {
        item.text("key", sound.key);
        item.object("part", [&](auto& part) { part_fields(part, sound.part); });
    });
}

void words_fields(auto& fields, auto& languages) {
    fields.fixed("format", format_name);
    fields.fixed("version", words_version);
    fields.objects("languages", languages, max_languages,
                   [](auto& item, auto& entry) { language_fields(item, entry); });
}

std::optional<Error> fault_of_format(const nlohmann::json& document) {
    if (!document.is_object() || !document.contains("format") || document["format"] != format_name) {
        return Error{ErrorKind::BadInput, "words.not_words",
                     "this is not a file of the exhibit's words (its manifest names another format)"};
    }
    const auto version = document.find("version");
    if (version == document.end() || !version->is_number_unsigned() || version->get<std::uint64_t>() == 0) {
        return Error{ErrorKind::BadInput, "words.no_version", "its version is missing; bake the words again"};
    }
    if (version->get<std::uint64_t>() > words_version) {
        return Error{
            ErrorKind::BadInput, "words.newer_version",
            fmt::format("it has version {}, this program knows up to {}; it needs a newer FrustumScreen",
                        version->get<std::uint64_t>(), words_version)};
    }
    return std::nullopt;
}

Result<Bytes> entry_of(ZipReader& zip, std::string_view name, std::uint64_t most) {
    const ZipEntry* entry = zip.find(name);
    if (entry == nullptr || entry->bytes > most) {
        return bad_input(
            "words.part",
            entry == nullptr
                ? fmt::format("the part {} is missing; bake the words again", printable(name))
                : fmt::format("{} has {} bytes, allowed are {}", printable(name), entry->bytes, most));
    }
    return zip.read(*entry);
}

Result<std::vector<LanguageEntry>> read_manifest(ZipReader& zip) {
    TRY(const Bytes text, entry_of(zip, manifest_entry, max_words_manifest_bytes));
    Refusal refusal;
    const nlohmann::json document = parse_json(refusal, as_text(text));
    if (!refusal.error) {
        refusal.error = fault_of_format(document);
    }
    std::vector<LanguageEntry> languages;
    if (!refusal.error) {
        JsonReader fields(refusal, &document, "");
        words_fields(fields, languages);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    return languages;
}

Result<std::vector<LanguageEntry>> open_words(std::span<const std::byte> file,
                                              std::optional<ZipReader>& zip) {
    TRY(ZipReader opened, ZipReader::open(file));
    zip.emplace(std::move(opened));
    return read_manifest(*zip);
}

Result<Bytes> part_of(ZipReader& zip, const Part& part) {
    Result<Bytes> bytes = entry_of(zip, part.name, max_words_part_bytes);
    if (bytes && (bytes->size() != part.bytes || sha256_hex(*bytes) != part.sha256)) {
        return bad_input("words.part_changed",
                         "{} is not what the manifest says; bake or copy the words again",
                         printable(part.name));
    }
    return bytes;
}

Result<LanguageWords> read_language(ZipReader& zip, LanguageEntry& entry) {
    LanguageWords words{.language = std::move(entry.language),
                        .name = std::move(entry.name),
                        .words = std::move(entry.words),
                        .runs = {},
                        .atlas = {},
                        .sounds = {}};
    TRY(const Bytes glyphs, part_of(zip, entry.glyphs));
    TRY(const Bytes picture, part_of(zip, entry.atlas));
    TRY(GlyphRuns runs, at(printable(entry.glyphs.name), decode_glyph_runs(glyphs)));
    TRY(DistanceAtlas atlas, at(printable(entry.atlas.name), decode_distance_atlas(picture, runs)));
    words.runs = std::move(runs);
    words.atlas = std::move(atlas);
    for (const PlainWord& word : words.words) {
        if (words.runs.find(word.key) == nullptr) {
            return bad_input("words.no_glyphs", "{} has no glyphs for '{}'; bake the words again",
                             printable(entry.glyphs.name), printable(word.key));
        }
    }
    for (const SoundPart& sound : entry.sounds) {
        TRY(Bytes bytes, part_of(zip, sound.part));
        words.sounds.emplace(sound.key, std::move(bytes));
    }
    return words;
}

} // namespace

Result<Bytes> write_words(std::span<const LanguageWords> languages) {
    struct Entry {
        std::string name;
        Bytes bytes;
        Packing packing;
    };
    std::vector<LanguageEntry> entries;
    std::vector<Entry> written; // the manifest precedes them and has their hashes
    const auto add = [&](std::string name, Bytes bytes, Packing packing) {
        Part part{name, bytes.size(), sha256_hex(bytes)};
        written.push_back({std::move(name), std::move(bytes), packing});
        return part;
    };
    for (const LanguageWords& words : languages) {
        LanguageEntry entry{.language = words.language,
                            .name = words.name,
                            .words = words.words,
                            .glyphs = {},
                            .atlas = {},
                            .sounds = {}};
        entry.glyphs = add(words.language + "/glyphs.bin", encode_glyph_runs(words.runs), Packing::Deflated);
        entry.atlas =
            add(words.language + "/atlas.webp", encode_distance_atlas(words.atlas), Packing::Stored);
        for (const auto& [key, sound] : words.sounds) {
            entry.sounds.push_back(
                {key, add(fmt::format("{}/{}.opus", words.language, key), sound, Packing::Stored)});
        }
        entries.push_back(std::move(entry));
    }
    JsonWriter fields;
    words_fields(fields, entries);
    ZipWriter zip;
    zip.add(std::string(manifest_entry), as_bytes(fields.document().dump(1)), Packing::Deflated);
    for (const Entry& entry : written) {
        zip.add(entry.name, entry.bytes, entry.packing);
    }
    return zip.finish();
}

Result<std::vector<WordsLanguage>> list_words(std::span<const std::byte> file) {
    std::optional<ZipReader> zip;
    TRY(const std::vector<LanguageEntry> entries, open_words(file, zip));
    std::vector<WordsLanguage> languages;
    for (const LanguageEntry& entry : entries) {
        languages.push_back({.language = entry.language,
                             .name = entry.name,
                             .words = entry.words.size(),
                             .sounds = entry.sounds.size()});
    }
    return languages;
}

Result<LanguageWords> read_words(std::span<const std::byte> file, std::string_view language) {
    std::optional<ZipReader> zip;
    TRY(std::vector<LanguageEntry> entries, open_words(file, zip));
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const LanguageEntry& entry) { return entry.language == language; });
    if (found == entries.end()) {
        return bad_input("words.no_language",
                         "there are no words in the language '{}'; bake them with --languages",
                         printable(language, 40));
    }
    return read_language(*zip, *found);
}

} // namespace frustumscreen::pack
