#include "assets_baked/folder/artifact_file.h"

#include "app/pack/container/limits.h"
#include "app/pack/pack_states.h"
#include "app/pack/pack_text.h"
#include "app/pack/pack_torches.h"
#include "app/settings/toml_file.h"
#include "assets_baked/folder/artifact_labels.h"
#include "assets_baked/folder/artifact_path.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/letters_apart.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/trimmed.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace frustumscreen::folder {

namespace {

constexpr std::uintmax_t largest_file_bytes = std::uintmax_t{16} << 20; // limit of a pack's manifest
constexpr std::array<std::string_view, 6> up_words{"x", "y", "z", "-x", "-y", "-z"};
constexpr std::array<std::string_view, 2> prop_words{"frustum", "cube"};
struct InnerKey {
    std::string_view key;
    std::string_view table;
};
constexpr auto inner_keys = std::to_array<InnerKey>(
    {{"language", "[[texts]]"},     {"title", "[[texts]]"},       {"period", "[[texts]]"},
     {"place", "[[texts]]"},        {"maker", "[[texts]]"},       {"credit", "[[texts]]"},
     {"text", "[[texts]]"},         {"description", "[[texts]]"}, {"recording", "[[texts]]"},
     {"point", "[[hotspots]]"},     {"labels", "[[hotspots]]"},   {"animation", "[[behaviours]]"},
     {"trigger", "[[behaviours]]"}, {"titles", "[[behaviours]]"}, {"picture", "[[torch]]"},
     {"film", "[[torch]]"},         {"layer", "[[torch]]"},       {"effect", "[[torch]]"},
     {"hide", "[[states]]"},        {"behaviour", "[[states]]"},  {"up", "[placement]"},
     {"turn_deg", "[placement]"},   {"scale", "[placement]"},     {"lift", "[placement]"},
     {"max_triangles", "[site]"}});
constexpr settings::Range coordinate{-1e9, 1e9, "units of the scan"};

/// Reads a text without surrounding blanks; one of only blanks counts as left out.
void read_text(settings::TableReader& table, std::string_view key, std::string& value,
               pack::TextShape shape = pack::TextShape::Line) {
    table.any_text(key, value);
    if (const std::optional<std::string> fault = pack::fault_of_text(value, shape)) {
        table.refuse("folder.text", key, *fault);
    }
    value = std::string(trimmed(value));
}

void read_word(settings::TableReader& table, std::string_view key, std::string& value,
               std::span<const std::string_view> words) {
    std::size_t index = 0;
    table.choice(key, index, words, {});
    if (table.has(key)) {
        value = words[index];
    }
}

void read_placement(settings::TableReader& table, ArtifactFile& file) {
    read_word(table, "up", file.up, up_words);
    double turn_deg = 0.0;
    table.number("turn_deg", turn_deg, {-360.0, 360.0, "degrees"});
    if (table.has("turn_deg")) {
        file.turn_deg = turn_deg;
    }
    table.number("scale", file.scale, {pack::min_scale, pack::max_scale, ""});
    table.number("lift", file.lift, {0.0, 1.0, "heights of the artifact"});
}

/// An empty table makes a site, too.
void read_site(settings::TableReader& table, std::optional<ArtifactSite>& site) {
    ArtifactSite read;
    const bool is_there = table.has("site");
    table.table("site", {}, [&](settings::TableReader& inner) {
        inner.integer("max_triangles", read.max_triangles, min_region_triangles, max_region_triangles, {});
    });
    site = is_there ? std::optional(read) : std::nullopt;
}

void read_caption(settings::TableReader& table, pack::PackCaption& caption, std::set<std::string>& languages,
                  ArtifactFile& file) {
    table.any_text("language", caption.language);
    read_text(table, "title", caption.title);
    read_text(table, "period", caption.period);
    read_text(table, "place", caption.place);
    read_text(table, "maker", caption.maker);
    read_text(table, "credit", caption.credit);
    read_text(table, "text", caption.text, pack::TextShape::Lines);
    read_text(table, "description", caption.description, pack::TextShape::Lines);
    std::filesystem::path recording;
    read_path(table, "recording", recording);
    table.finish(); // a misspelt key is reported before a missing one
    if (caption.language.empty()) {
        table.refuse("folder.no_language", "language",
                     "is missing or empty; every [[texts]] names its language, such as \"en\"");
    } else if (read_language(table, "language", caption.language) &&
               !languages.insert(caption.language).second) {
        table.refuse("folder.language_twice", "language",
                     fmt::format("is \"{}\" a second time; allowed is each language once", caption.language));
    }
    if (!recording.empty()) {
        table.require(
            "folder.no_description", !caption.description.empty(), "recording",
            "has no description beside it; write its words there, for visitors who do not hear them");
        file.recordings.emplace(caption.language, std::move(recording));
    }
}

void read_hotspot(settings::TableReader& table, ArtifactHotspot& hotspot) {
    table.vector("point", hotspot.point_file, coordinate);
    read_labels(table, "labels", hotspot.labels);
    table.finish(); // as for a text
    table.require("folder.no_point", table.has("point"), "point",
                  "is missing; write it as [x, y, z] in the scan's coordinates");
    hotspot.place = table.place("point");
    table.require("folder.no_labels", !hotspot.labels.empty(), "labels",
                  "has no text; write one for each language, { en = \"...\" }");
}

void read_all(settings::TableReader& table, ArtifactFile& file) {
    read_path(table, "scan", file.scan);
    read_path(table, "texture", file.texture);
    table.any_text("id", file.id);
    table.require("folder.id", file.id.empty() || pack::is_artifact_id(file.id), "id",
                  fmt::format("is \"{}\"; allowed are 1 to {} of a-z 0-9 . _ -, a letter or a digit first",
                              printable(file.id, 40), pack::max_id_bytes));
    read_text(table, "licence", file.licence);
    read_text(table, "author", file.author);
    read_text(table, "source", file.source);
    table.integer("size", file.size, 16, 4096, {});
    table.flag("unlit", file.unlit, {});
    read_word(table, "prop", file.prop, prop_words);
    table.table("placement", {}, [&](settings::TableReader& inner) { read_placement(inner, file); });
    read_site(table, file.site);
    std::set<std::string> languages;
    table.tables("texts", file.texts, pack::max_languages,
                 [&](settings::TableReader& item, pack::PackCaption& caption) {
                     read_caption(item, caption, languages, file);
                 },
                 {});
    table.tables("hotspots", file.hotspots, pack::max_hotspots, read_hotspot, {});
    table.tables("behaviours", file.behaviours, world::max_behaviours,
                 [&](settings::TableReader& item, ArtifactBehaviour& behaviour) {
                     read_behaviour(item, behaviour, file.hotspots.size(), file.behaviours);
                 },
                 {});
    table.tables(
        "torch", file.torches, pack::max_contents,
        [&](settings::TableReader& item, ArtifactTorch& content) { read_torch(item, content, file.torches); },
        {});
    table.tables(
        "states", file.states, pack::max_states,
        [&](settings::TableReader& item, ArtifactState& each) { read_state(item, each, file.states); }, {});
    table.require("folder.site_moves", !file.site || file.behaviours.empty(), "site",
                  "stands beside [[behaviours]], but nothing of a site moves; leave one of them out");
    for (pack::PackCaption& caption : file.texts) {
        caption.title = caption.title.empty() ? file.texts.front().title : caption.title;
    }
}

/// Refuses [texts] in place of [[texts]].
void refuse_single_tables(const toml::table& root, settings::ReadState& state) {
    for (const auto& [key, each] : {std::pair("texts", "language"),
                                    {"hotspots", "place"},
                                    {"behaviours", "movement"},
                                    {"torch", "content"},
                                    {"states", "state"}}) {
        const toml::node* node = root.get(key);
        if (node != nullptr && node->is_table()) {
            state.refuse(
                "folder.single_brackets", static_cast<std::uint32_t>(node->source().begin.line),
                fmt::format("[{}] has one bracket too few on each side; write [[{}]], once for each {}", key,
                            key, each));
        }
    }
}

/// Refuses [[text]] in place of [[texts]]: a text has a key of that name, but not one that holds tables.
void refuse_misspelt_tables(const toml::table& root, settings::ReadState& state) {
    for (const auto& [key, node] : root) {
        const std::string_view name = key.str().substr(0, 60);
        for (const std::string_view known : {"texts", "hotspots", "behaviours", "torch", "states"}) {
            const std::size_t apart = letters_apart(name, known);
            if (node.is_array_of_tables() && apart > 0 && 3 * apart <= known.size()) {
                state.refuse("folder.unknown_table", static_cast<std::uint32_t>(key.source().begin.line),
                             fmt::format("[[{}]] is not known; the nearest one is [[{}]]",
                                         printable(name, 60), known));
            }
        }
    }
}

/// Reports a key at the top of the file, right or misspelt, that belongs into one of its tables.
void refuse_misplaced_key(const toml::table& root, std::span<const std::string> outer_keys,
                          settings::ReadState& state) {
    std::optional<std::pair<std::uint32_t, std::string>> first;
    for (const auto& [key, node] : root) {
        const std::string_view name = key.str().substr(0, 60);
        const auto line = static_cast<std::uint32_t>(key.source().begin.line);
        const auto apart = [&](std::string_view known) { return letters_apart(name, known); };
        const auto nearest =
            std::min_element(inner_keys.begin(), inner_keys.end(), [&](const InnerKey& a, const InnerKey& b) {
                return apart(a.key) < apart(b.key);
            });
        const std::size_t distance = apart(nearest->key);
        const bool is_outer = std::any_of(outer_keys.begin(), outer_keys.end(), [&](std::string_view outer) {
            return (outer != "site" || node.is_table()) && apart(outer) <= distance; // `titel` is no table
        });
        if (!is_outer && 3 * distance <= name.size() + 1 && (!first || line < first->first)) {
            const std::string found = distance == 0
                                          ? std::string(name)
                                          : fmt::format("{} is not a known key; the nearest one, {},",
                                                        printable(name, 60), nearest->key);
            first = {line, fmt::format("{} belongs below a line {}", found, nearest->table)};
        }
    }
    if (first) {
        state.refuse("folder.key_of_table", first->first, first->second);
    }
}

} // namespace

Result<ArtifactFile> parse_artifact_file(std::string_view text, const std::filesystem::path& file) {
    settings::ReadState state{.file = printable(file.string(), 4096),
                              .folder = file.parent_path(),
                              .lines = {},
                              .error = std::nullopt};
    ArtifactFile read;
    settings::read_toml(state, text, largest_file_bytes, [&](const toml::table& root) {
        settings::TableReader keys(state, &root, "");
        refuse_single_tables(root, state);
        refuse_misspelt_tables(root, state);
        read_all(keys, read);
        refuse_misplaced_key(root, keys.known(), state);
        keys.finish();
        keys.require("folder.no_scan", !read.scan.empty(), "scan",
                     "is missing; name the file of the scan in this folder");
    });
    if (state.error) {
        return tl::unexpected<Error>(*std::move(state.error));
    }
    return read;
}

Result<ArtifactFile> read_artifact_file(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / artifact_file_name;
    if (std::error_code none; !std::filesystem::exists(file, none)) {
        return bad_input("folder.no_artifact_file",
                         "{}: there is no {} in this folder; frustumscreen-bake --new {} SCAN writes "
                         "one to start from",
                         folder.string(), artifact_file_name, folder.string());
    }
    TRY(const Bytes bytes, read_file(file, largest_file_bytes));
    return parse_artifact_file(as_text(bytes), file);
}

} // namespace frustumscreen::folder
