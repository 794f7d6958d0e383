#include "assets_baked/texts/words.h"

#include "app/pack/glyph_runs.h"
#include "app/settings/toml_file.h"
#include "assets_baked/texts/builtin_words.h"
#include "assets_baked/texts/check_text.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/letters_apart.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

namespace frustumscreen::texts {

namespace {

constexpr std::uintmax_t max_file_bytes = std::uintmax_t{1} << 20;
constexpr std::size_t max_word_bytes = 1000;
constexpr std::size_t max_named_keys = 5; ///< in one sentence

/// In the order of the files. `name` is the language's own name.
constexpr auto keys = std::to_array<std::string_view>({
    "name",
    "attract_line",
    "room_line",
    "advice.slide_left",
    "advice.slide_left_a_little",
    "advice.slide_right",
    "advice.slide_right_a_little",
    "advice.slide_nearer",
    "advice.slide_nearer_a_little",
    "advice.slide_farther",
    "advice.slide_farther_a_little",
    "advice.slide_back_to_light",
    "advice.turn_counter_clockwise",
    "advice.turn_counter_clockwise_a_little",
    "advice.turn_clockwise",
    "advice.turn_clockwise_a_little",
    "advice.set_down",
    "advice.stand_upright",
    "advice.come_round_left",
    "advice.come_round_right",
    "advice.come_to_front",
    "advice.lower",
    "advice.raise",
    "advice.uncover",
    "advice.wait_tracker",
    "advice.away_from_metal",
    "advice.show_your_head",
    "advice.point_lamp",
    "advice.lamp_closer",
    "advice.pin_window",
    "advice.turn_window",
    "stick.found",
    "stick.copying",
    "stick.take_out",
    "stick.stopped",
    "stick.nothing_on_it",
    "stick.taken",
    "stick.already_there",
    "stick.removed",
    "stick.written",
    "stick.not_written",
    "stick.refused.unsigned",
    "stick.refused.wrong_key",
    "stick.refused.altered",
    "stick.refused.older",
    "stick.refused.not_a_pack",
    "stick.refused.no_room",
    "stick.refused.unreadable",
    "stick.refused.unwritable",
    "stick.refused.too_much",
    "fault.no_artifact",
    "calibration.begin",
    "calibration.lay",
    "calibration.on_boards",
    "calibration.hold_still",
    "calibration.taken",
    "calibration.moved",
    "calibration.not_seen",
    "calibration.same_place",
    "calibration.all_taken",
    "calibration.may_be_kept",
    "calibration.repeat",
    "calibration.refused",
    "calibration.kept",
    "calibration.left",
    "calibration.touch_up",
    "calibration.nothing_moved",
    "calibration.put_right",
    "calibration.more",
    "calibration.does_not_fit",
    "calibration.by_camera",
    "calibration.no_camera",
    "calibration.camera_fault",
    "calibration.no_light",
    "calibration.look_at_light",
    "calibration.lay_flat",
    "calibration.lay_on_boards",
    "calibration.lean",
    "calibration.few_tags",
    "calibration.turn_it",
    "calibration.not_flat",
    "calibration.leans_little",
    "calibration.wrong_height",
    "calibration.board_moved",
    "calibration.disturbed",
    "calibration.too_bright",
    "calibration.dropped",
    "calibration.too_few",
    "calibration.more_rests",
    "calibration.eyes.begin",
    "calibration.eyes.rest",
    "calibration.eyes.shut_right",
    "calibration.eyes.shut_left",
    "calibration.eyes.chin_up",
    "calibration.eyes.chin_down",
    "calibration.eyes.turned_left",
    "calibration.eyes.turned_right",
    "calibration.eyes.hold_still",
    "calibration.eyes.block_moves",
    "calibration.eyes.block_moved",
    "calibration.eyes.head_not_seen",
    "calibration.eyes.off_table",
    "calibration.eyes.no_room",
    "calibration.eyes.head_moved",
    "calibration.eyes.same_head",
    "calibration.eyes.may_be_kept",
    "calibration.eyes.refused",
    "calibration.eyes.kept",
    "calibration.eyes.unchanged",
});
/// Keys that a museum's file for an earlier version may contain.
constexpr auto past_keys = std::to_array<std::string_view>({
    "choose_by_sliding",
    "help",
    "advice.slide_back_to_light_a_little",
    "advice.done_well",
    "fault.no_projector",
    "fault.no_tracker",
    "fault.repairing",
});

bool is_key(std::string_view name) {
    return std::find(keys.begin(), keys.end(), name) != keys.end() ||
           std::find(past_keys.begin(), past_keys.end(), name) != past_keys.end();
}

std::string_view nearest_key(std::string_view found) {
    const std::string_view part = found.substr(0, max_word_bytes);
    return *std::min_element(keys.begin(), keys.end(), [&](std::string_view a, std::string_view b) {
        return letters_apart(part, a) < letters_apart(part, b);
    });
}

/// Reads one file and keeps its first error.
class WordsReader {
public:
    WordsReader(const std::string& file, WrittenWords& words) : file_(file), words_(words) {}

    void read(const toml::table& table, const std::string& prefix) {
        for (const auto& [key, node] : table) {
            const std::string name = prefix + std::string(key.str());
            const bool is_group = std::any_of(keys.begin(), keys.end(), [&](std::string_view known) {
                return known.starts_with(name + ".");
            });
            if (is_group && node.is_table()) {
                read(*node.as_table(), name + ".");
            } else {
                read_word(name, node);
            }
        }
    }
    [[nodiscard]] const std::optional<Error>& error() const { return error_; }

private:
    void read_word(const std::string& name, const toml::node& node) {
        const std::string shown = printable(name, 60);
        if (!is_key(name)) {
            refuse("words.no_word", node,
                   fmt::format("there is no word '{}'; the nearest one is {}", shown, nearest_key(name)));
            return;
        }
        const auto* text = node.as_string();
        if (text == nullptr) {
            refuse("words.no_text", node,
                   fmt::format("{} is not a text; write it between quotation marks", shown));
        } else if (text->get().empty() || text->get().size() > max_word_bytes) {
            refuse("words.word_size", node,
                   fmt::format(
                       "{} has {} bytes; allowed are 1 to {}: leave the key out to use the built-in text",
                       shown, text->get().size(), max_word_bytes));
        } else if (const Result<void> checked = check_shaped_text(text->get()); !checked) {
            refuse("words.word_text", node, fmt::format("{}: {}", shown, checked.error().message));
        } else {
            words_.emplace(name, text->get());
        }
    }
    /// A table's keys come in alphabetical order; report the error nearest to the top of the file.
    void refuse(MessageId id, const toml::node& node, const std::string& what) {
        const auto line = node.source().begin.line;
        if (!error_ || line < line_) {
            line_ = line;
            error_ = Error{ErrorKind::BadInput, id, fmt::format("{}:{}: {}", file_, line, what)};
        }
    }

    const std::string& file_;
    WrittenWords& words_;
    std::optional<Error> error_;
    toml::source_index line_ = 0;
};

/// The built-in words, overridden by those of the folder.
Result<WrittenWords> words_of(const std::filesystem::path& folder, const std::string& language) {
    WrittenWords words;
    for (const BuiltinWords& file : builtin_words()) {
        if (file.language == language) {
            TRY(words, parse_words(file.toml, fmt::format("words/{}.toml", language)));
        }
    }
    const std::filesystem::path file = folder / (language + ".toml");
    std::error_code ignored;
    if (folder.empty() || !std::filesystem::exists(file, ignored)) {
        return words;
    }
    TRY(const Bytes bytes, read_file(file, max_file_bytes));
    TRY(WrittenWords read, parse_words(as_text(bytes), printable(file.string(), 4096)));
    read.merge(words);
    return read;
}

CollectedWords collect(const std::string& language, const WrittenWords& own, const std::string& house,
                       const WrittenWords& fallback) {
    CollectedWords collected{language, {}, {}};
    std::vector<std::string> missing;
    for (const std::string_view key : keys) {
        if (const auto word = own.find(key); word != own.end()) {
            collected.words.push_back({std::string(key), word->second, language});
        } else if (const auto other = fallback.find(key); other != fallback.end()) {
            collected.words.push_back({std::string(key), other->second, house});
            missing.emplace_back(key);
        }
    }
    if (!missing.empty()) {
        const std::size_t named = std::min(missing.size(), max_named_keys);
        const std::string more =
            missing.size() > named ? fmt::format(" and {} more", missing.size() - named) : "";
        collected.notes.push_back(fmt::format(
            "the language '{}' has no text for {}{}; there the exhibit speaks '{}': write them into {}.toml",
            language, fmt::join(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(named), ", "),
            more, house, language));
    }
    std::vector<std::string_view> past;
    std::copy_if(past_keys.begin(), past_keys.end(), std::back_inserter(past),
                 [&](std::string_view key) { return own.find(key) != own.end(); });
    if (!past.empty()) {
        collected.notes.push_back(fmt::format(
            "the language '{}' has a text for {}, which is no longer shown: delete it from {}.toml", language,
            fmt::join(past, ", "), language));
    }
    return collected;
}

} // namespace

std::vector<std::string> builtin_word_languages() {
    std::vector<std::string> languages;
    for (const BuiltinWords& file : builtin_words()) {
        languages.emplace_back(file.language);
    }
    return languages;
}

Result<WrittenWords> parse_words(std::string_view toml, const std::string& file) {
    settings::ReadState state{.file = file, .folder = {}, .lines = {}, .error = std::nullopt};
    WrittenWords words;
    settings::read_toml(state, toml, max_file_bytes, [&](const toml::table& root) {
        WordsReader reader(file, words);
        reader.read(root, "");
        state.error = reader.error();
    });
    if (state.error) {
        return tl::unexpected<Error>(*std::move(state.error));
    }
    return words;
}

Result<std::vector<CollectedWords>> collect_words(const std::filesystem::path& folder,
                                                  std::span<const std::string> languages) {
    if (languages.empty()) {
        return bad_input("words.no_language_named",
                         "no language is named; name at least the exhibit's first language, such as en");
    }
    const std::string& house = languages.front();
    TRY(const WrittenWords fallback, words_of(folder, house));
    for (const std::string_view key : keys) {
        if (!fallback.contains(key)) {
            return bad_input(
                "words.house_lacks",
                "the house's language '{}' has no text for {}; write it into {}.toml, or name another "
                "language first (built in: {})",
                printable(house, 40), key, printable(house, 40), fmt::join(builtin_word_languages(), ", "));
        }
    }
    std::vector<CollectedWords> collected;
    for (const std::string& language : languages) {
        TRY(const WrittenWords own, words_of(folder, language));
        if (own.find("name") == own.end()) {
            return bad_input("words.no_words",
                             "there are no words in '{}'; write {}.toml with at least a line "
                             "name = \"...\", the language's "
                             "own name (built in: {})",
                             printable(language, 40), printable(language, 40),
                             fmt::join(builtin_word_languages(), ", "));
        }
        collected.push_back(collect(language, own, house, fallback));
    }
    return collected;
}

} // namespace frustumscreen::texts
