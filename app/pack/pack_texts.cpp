#include "app/pack/pack_texts.h"

#include "app/pack/container/limits.h"
#include "app/pack/json/json_reader.h"
#include "app/pack/json/json_writer.h"
#include "app/pack/pack_sections.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <concepts>
#include <optional>
#include <set>

namespace frustumscreen::pack {

namespace {

constexpr std::string_view texts_section = "texts";
constexpr std::string_view sounds_section = "sounds";
constexpr std::string_view ogg_magic = "OggS";

/// Names of the parts of a language. Texts without letters need no atlas.
struct SetEntry {
    std::string language;
    std::string glyphs;
    std::string atlas;
};
struct SoundEntry {
    std::string key;
    std::string part;
};
struct SpokenEntry {
    std::string language;
    std::vector<SoundEntry> sounds;
};

/// `Plain` when reading, or const `Plain` when writing.
template <typename Entry, typename Plain>
concept EntryOf = std::same_as<std::remove_const_t<Entry>, Plain>;

void entry_fields(auto& fields, EntryOf<SetEntry> auto& entry) {
    fields.text("language", entry.language);
    fields.text("glyphs", entry.glyphs);
    fields.text("atlas", entry.atlas);
}

void entry_fields(auto& fields, EntryOf<SpokenEntry> auto& entry) {
    fields.text("language", entry.language);
    fields.objects("sounds", entry.sounds, glyph_limits::max_texts, [](auto& item, auto& sound) {
        item.text("key", sound.key);
        item.text("part", sound.part);
    });
}

void section_fields(auto& fields, auto& entries) {
    fields.objects("languages", entries, max_languages,
                   [](auto& item, auto& entry) { entry_fields(item, entry); });
}

std::vector<std::string> parts_of(const SetEntry& entry) {
    return entry.atlas.empty() ? std::vector{entry.glyphs} : std::vector{entry.glyphs, entry.atlas};
}

std::vector<std::string> parts_of(const SpokenEntry& entry) {
    std::vector<std::string> parts;
    for (const SoundEntry& sound : entry.sounds) {
        parts.push_back(sound.part);
    }
    return parts;
}

bool has_good_keys(const SetEntry& /*entry*/) {
    return true; // the keys are in the part
}

bool has_good_keys(const SpokenEntry& entry) {
    std::set<std::string_view> keys;
    return std::all_of(entry.sounds.begin(), entry.sounds.end(), [&](const SoundEntry& sound) {
        return is_text_key(sound.key) && keys.insert(sound.key).second;
    });
}

/// Each language must occur once, and the section's parts must be those named, each once.
template <typename Entry>
std::optional<std::string> fault_of(const std::vector<Entry>& entries, std::vector<std::string> parts) {
    std::set<std::string_view> languages;
    std::vector<std::string> named;
    for (const Entry& entry : entries) {
        const std::string language = printable(entry.language, 40);
        if (!languages.insert(entry.language).second) {
            return fmt::format("names the language '{}' twice; bake the pack again", language);
        }
        if (!has_good_keys(entry)) {
            return fmt::format(
                "has a sound in '{}' whose key is not valid, or is named twice; bake the pack again",
                language);
        }
        for (std::string& part : parts_of(entry)) {
            named.push_back(std::move(part));
        }
    }
    std::sort(named.begin(), named.end());
    std::sort(parts.begin(), parts.end());
    return named == parts
               ? std::nullopt
               : std::optional<std::string>("does not name exactly its own parts; bake the pack again");
}

const PackSection* find_section(const PackDescription& pack, std::string_view name) {
    const auto found = std::find_if(pack.sections.begin(), pack.sections.end(),
                                    [&](const PackSection& section) { return section.name == name; });
    return found != pack.sections.end() ? &*found : nullptr;
}

/// Empty if there is no section.
template <typename Entry>
Result<std::vector<Entry>> entries_of(const PackDescription& pack, std::string_view name) {
    std::vector<Entry> entries;
    const PackSection* section = find_section(pack, name);
    if (section == nullptr) {
        return entries;
    }
    Refusal refusal;
    const nlohmann::json data = parse_json(refusal, section->data);
    if (!refusal.error) {
        JsonReader fields(refusal, &data, fmt::format("sections.{}.data", name));
        section_fields(fields, entries);
        fields.finish();
    }
    if (refusal.error) {
        return tl::unexpected<Error>(*std::move(refusal.error));
    }
    if (const std::optional<std::string> fault = fault_of(entries, section->parts)) {
        return bad_input("pack.text_section", "the section {} {}", name, *fault);
    }
    return entries;
}

template <typename Entry> void put_section(Pack& pack, std::string_view name, std::vector<Entry> entries) {
    assert(find_section(pack, name) == nullptr);
    if (entries.empty()) {
        return;
    }
    PackSection section{std::string(name), {}, {}};
    for (const Entry& entry : entries) {
        for (std::string& part : parts_of(entry)) {
            section.parts.push_back(std::move(part));
        }
    }
    JsonWriter fields;
    section_fields(fields, entries);
    section.data = nlohmann::json(fields.document()).dump(); // keys in order
    pack.sections.push_back(std::move(section));
}

/// Names of parts have only small letters.
std::string folder_of(std::string_view section, std::string language) {
    std::transform(language.begin(), language.end(), language.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return fmt::format("{}/{}/", section, language);
}

Result<SetLanguage> decode(const SetEntry& entry, const std::map<std::string, Bytes>& parts,
                           Atlases atlases = Atlases::Read) {
    TRY(GlyphRuns runs, at(entry.glyphs, decode_glyph_runs(parts.at(entry.glyphs))));
    if (atlases == Atlases::NotRead) {
        return SetLanguage{entry.language, std::move(runs), {}};
    }
    static const Bytes none;
    TRY(DistanceAtlas atlas,
        at(entry.atlas.empty() ? entry.glyphs : entry.atlas,
           decode_distance_atlas(entry.atlas.empty() ? none : parts.at(entry.atlas), runs)));
    return SetLanguage{entry.language, std::move(runs), std::move(atlas)};
}

Result<void> check_sound(const std::string& name, const Bytes& bytes) {
    return as_text(bytes).starts_with(ogg_magic)
               ? Result<void>()
               : bad_input("pack.not_ogg", "{} is not an Ogg recording; bake the pack again", name);
}

} // namespace

std::string label_key(std::size_t hotspot) {
    return fmt::format("label.{}", hotspot);
}

std::string torch_key(std::size_t content) {
    return fmt::format("torch.{}", content);
}

std::string state_key(std::size_t state) {
    return fmt::format("state.{}", state);
}

std::string behaviour_key(std::size_t behaviour) {
    return fmt::format("behaviour.{}", behaviour);
}

void put_sounds(Pack& pack, std::span<const SpokenLanguage> languages) {
    std::vector<SpokenEntry> entries;
    for (const SpokenLanguage& language : languages) {
        SpokenEntry entry{language.language, {}};
        for (const auto& [key, opus] : language.sounds) {
            entry.sounds.push_back({key, folder_of(sounds_section, language.language) + key + ".opus"});
            pack.section_parts[entry.sounds.back().part] = opus;
        }
        if (!entry.sounds.empty()) {
            entries.push_back(std::move(entry));
        }
    }
    put_section(pack, sounds_section, std::move(entries));
}

void put_set_texts(Pack& pack, std::span<const SetLanguage> languages) {
    std::vector<SetEntry> entries;
    for (const SetLanguage& language : languages) {
        if (language.runs.texts.empty()) {
            continue;
        }
        const std::string folder = folder_of(texts_section, language.language);
        SetEntry entry{language.language, folder + "glyphs.bin", {}};
        pack.section_parts[entry.glyphs] = encode_glyph_runs(language.runs);
        if (Bytes atlas = encode_distance_atlas(language.atlas); !atlas.empty()) {
            entry.atlas = folder + "atlas.webp";
            pack.section_parts[entry.atlas] = std::move(atlas);
        }
        entries.push_back(std::move(entry));
    }
    put_section(pack, texts_section, std::move(entries));
}

Result<std::vector<SetLanguage>> load_set_texts(const std::filesystem::path& file,
                                                std::span<const std::string> languages, Atlases atlases) {
    std::vector<SetEntry> chosen;
    const auto choose = [&](const PackDescription& pack) -> Result<std::vector<std::string>> {
        TRY(std::vector<SetEntry> entries, entries_of<SetEntry>(pack, texts_section));
        std::vector<std::string> names;
        for (SetEntry& entry : entries) {
            if (std::find(languages.begin(), languages.end(), entry.language) != languages.end()) {
                for (std::string& part :
                     atlases == Atlases::Read ? parts_of(entry) : std::vector{entry.glyphs}) {
                    names.push_back(std::move(part));
                }
                chosen.push_back(std::move(entry));
            }
        }
        return names;
    };
    TRY(const auto parts, load_section_parts(file, choose));
    std::vector<SetLanguage> loaded;
    for (const SetEntry& entry : chosen) {
        TRY(SetLanguage language, at(file.string(), decode(entry, parts, atlases)));
        loaded.push_back(std::move(language));
    }
    return loaded;
}

Result<std::vector<SpokenText>> list_sounds(const PackDescription& pack) {
    TRY(const std::vector<SpokenEntry> entries, entries_of<SpokenEntry>(pack, sounds_section));
    std::vector<SpokenText> spoken;
    for (const SpokenEntry& entry : entries) {
        for (const SoundEntry& sound : entry.sounds) {
            spoken.push_back({entry.language, sound.key});
        }
    }
    return spoken;
}

Result<Bytes> load_sound(const std::filesystem::path& file, std::string_view language, std::string_view key) {
    const auto choose = [&](const PackDescription& pack) -> Result<std::vector<std::string>> {
        TRY(const std::vector<SpokenEntry> entries, entries_of<SpokenEntry>(pack, sounds_section));
        for (const SpokenEntry& entry : entries) {
            for (const SoundEntry& sound : entry.sounds) {
                if (entry.language == language && sound.key == key) {
                    return std::vector{sound.part};
                }
            }
        }
        return std::vector<std::string>();
    };
    Result<std::map<std::string, Bytes>> parts = load_section_parts(file, choose);
    if (!parts || parts->empty()) {
        return parts ? Result<Bytes>(Bytes()) : tl::unexpected<Error>(parts.error());
    }
    auto& [name, opus] = *parts->begin();
    TRY_VOID(at(file.string(), check_sound(name, opus)));
    return std::move(opus);
}

Result<void> check_set_and_spoken(const Pack& pack) {
    TRY(const std::vector<SetEntry> set, entries_of<SetEntry>(pack, texts_section));
    TRY(const std::vector<SpokenEntry> spoken, entries_of<SpokenEntry>(pack, sounds_section));
    for (const SetEntry& entry : set) {
        TRY_VOID(without_value(decode(entry, pack.section_parts)));
    }
    for (const SpokenEntry& entry : spoken) {
        for (const std::string& part : parts_of(entry)) {
            TRY_VOID(check_sound(part, pack.section_parts.at(part)));
        }
    }
    return {};
}

} // namespace frustumscreen::pack
