#include "app/programs/bake/words_command.h"

#include "app/pack/words_file.h"
#include "app/programs/bake/words_preview.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "app/settings/language_tag.h"
#include "assets_baked/texts/bake_words.h"
#include "assets_baked/texts/recorded_speech.h"
#include "assets_baked/texts/speak_words.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/standard_error.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

namespace frustumscreen {

namespace {

constexpr const char* program = "frustumscreen-bake";

struct Arguments {
    std::filesystem::path folder; ///< empty: the built-in words
    std::filesystem::path output;
    std::filesystem::path preview;
    std::vector<std::string> languages;
    std::string speech; ///< empty: espeak-ng
    bool strict = false;
};

Result<void> tell(const std::vector<std::string>& notes, bool strict) {
    if (strict && !notes.empty()) {
        return bad_input(
            fmt::format("this would be lost, and --strict forbids it: {}", fmt::join(notes, "; ")));
    }
    for (const std::string& note : notes) {
        say_line(program, note);
    }
    return {};
}

Result<void> check_folder(const std::filesystem::path& folder) {
    std::error_code ignored;
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
        return bad_input(fmt::format(
            "{}: this is no folder; name one with files such as de.toml, or none for the built-in words",
            folder.string()));
    }
    return {};
}

/// The languages that are named, in the usual case of their tags.
Result<std::vector<std::string>> named_languages(const std::vector<std::string>& written) {
    std::vector<std::string> languages;
    for (const std::string& each : written) {
        const std::string found = fmt::format("--languages: '{}'", printable(each, 40));
        const std::optional<std::string> language = parse_language_tag(each);
        if (!language) {
            return bad_input(fmt::format("{} is no language; allowed are {}", found, allowed_language_tags));
        }
        if (std::find(languages.begin(), languages.end(), *language) != languages.end()) {
            return bad_input(fmt::format("{} is named twice; write each language once", found));
        }
        languages.push_back(*language);
    }
    return languages;
}

Result<void> write_outputs(const BakedWords& baked, const Arguments& arguments) {
    const Result<Bytes> bytes = write_words(baked.languages);
    if (!bytes) {
        return tl::unexpected<Error>(bytes.error());
    }
    if (const Result<void> written = write_file(arguments.output, *bytes); !written) {
        return written;
    }
    fmt::print("{}: {} words in {} languages, {} kB\n", arguments.output.string(),
               baked.languages.front().words.size(), baked.languages.size(), (bytes->size() + 999) / 1000);
    for (const LanguageWords& words : baked.languages) {
        fmt::print("  {:<8}{:<14}{:>5} letters, {:>3} spoken\n", words.language, words.name,
                   words.runs.boxes.size(), words.sounds.size());
    }
    if (!arguments.preview.empty()) {
        return write_file(arguments.preview, encode_png(words_preview(baked.languages)));
    }
    return {};
}

Result<void> speak(BakedWords& baked, const Arguments& arguments) {
    ProgressLine progress("speaking: ");
    SpeakOptions options{arguments.folder, std::nullopt, {}};
    if (arguments.speech != "none") {
        options.voice = arguments.speech.empty() ? Voice() : Voice(arguments.speech);
    }
    options.progress = [&](std::string_view what, double done) { progress.show_share(what, done); };
    const Result<std::vector<std::string>> silent = speak_words(baked.languages, options);
    if (!silent) {
        return tl::unexpected<Error>(silent.error());
    }
    progress.clear();
    for (const std::string& sentence : *silent) {
        say_line(program, sentence);
    }
    return {};
}

/// Recordings in the folder that no word takes. Who names languages leaves the others out on purpose.
std::vector<std::string> unused_recordings_of(const std::vector<CollectedWords>& collected,
                                              const Arguments& arguments,
                                              const std::vector<std::string>& all_languages) {
    RecordingNames names;
    for (const CollectedWords& words : collected) {
        for (const Word& word : words.words) {
            names[words.language + "/" + word.key] =
                find_recording(arguments.folder, words.language, word.key);
        }
    }
    std::vector<std::string> left_out;
    for (const std::string& language : all_languages) {
        const bool is_baked =
            std::any_of(collected.begin(), collected.end(),
                        [&](const CollectedWords& each) { return each.language == language; });
        if (!is_baked) {
            left_out.push_back(language);
        }
    }
    return unused_recordings(arguments.folder, names, left_out);
}

Result<void> work(const Arguments& arguments) {
    if (const Result<void> folder = check_folder(arguments.folder); !folder) {
        return folder;
    }
    if (const Result<void> place = check_output_place(arguments.output); !place) {
        return place;
    }
    const std::vector<std::string> all_languages = builtin_word_languages();
    const Result<std::vector<std::string>> named = named_languages(arguments.languages);
    if (!named) {
        return tl::unexpected<Error>(named.error());
    }
    const std::vector<std::string>& languages = named->empty() ? all_languages : *named;
    const Result<std::vector<CollectedWords>> collected = collect_words(arguments.folder, languages);
    if (!collected) {
        return tl::unexpected<Error>(collected.error());
    }
    const Result<Shaper> shaper = Shaper::open();
    if (!shaper) {
        return tl::unexpected<Error>(shaper.error());
    }
    Result<BakedWords> baked = bake_words(*collected, *shaper);
    if (!baked) {
        return tl::unexpected<Error>(baked.error());
    }
    const std::vector<std::string> unused = unused_recordings_of(*collected, arguments, all_languages);
    baked->notes.insert(baked->notes.end(), unused.begin(), unused.end());
    if (const Result<void> told = tell(baked->notes, arguments.strict); !told) {
        return told;
    }
    if (const Result<void> spoken = speak(*baked, arguments); !spoken) {
        return spoken;
    }
    return write_outputs(*baked, arguments);
}

} // namespace

bool asks_for_words(int argc, const char* const* argv) {
    return std::any_of(argv, argv + argc, [](std::string_view argument) {
        return argument == "--words" || argument.starts_with("--words=");
    });
}

int words_command(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Bakes the exhibit's own words (advice, faults, invitations) into a file for the kiosk.",
                 program);
    app.set_version_flag("--version", FRUSTUMSCREEN_VERSION);
    app.add_option("--words", arguments.folder, "folder with LANGUAGE.toml; without one the built-in words")
        ->expected(0, 1);
    app.add_option("-o,--output", arguments.output, "file to write (*.fswords)")->required();
    app.add_option("--languages", arguments.languages,
                   "the house's language first, such as en,de (default: all built-in ones)")
        ->delimiter(',');
    app.add_option("--preview", arguments.preview, "also draw all texts into this PNG");
    app.add_option(
        "--speech", arguments.speech,
        "program that takes text on standard input and writes WAV; {language} in it is replaced; none: "
        "no voice (default: espeak-ng)");
    app.add_flag("--strict", arguments.strict,
                 "refuse words of which something would be lost; nothing is written");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return exit_status(program, work(arguments));
}

} // namespace frustumscreen
