#include "app/programs/bake/words_command.h"

#include "app/pack/words_file.h"
#include "app/programs/bake/words_folder.h"
#include "app/programs/bake/words_preview.h"
#include "app/programs/common/command_line.h"
#include "app/programs/common/guarded_main.h"
#include "app/programs/common/progress_line.h"
#include "app/settings/language_tag.h"
#include "assets_baked/texts/bake_words.h"
#include "assets_baked/texts/speak_words.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/output_file.h"
#include "firmware_host/base/printable.h"
#include "firmware_host/base/standard_error.h"
#include "firmware_host/base/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string_view>

namespace frustumscreen::programs {

namespace {

constexpr const char* program = "frustumscreen-bake";

struct Arguments {
    std::filesystem::path folder; ///< empty: the built-in words
    std::filesystem::path output;
    std::filesystem::path preview;
    std::vector<std::string> languages;
    std::string speech; ///< empty: espeak-ng
    bool strict = false;
    bool force = false; ///< replace outputs of another kind
};

Result<void> tell(const std::vector<std::string>& notes, bool strict) {
    if (strict && !notes.empty()) {
        return bad_input("words.would_be_lost", "this would be lost, and --strict forbids it: {}",
                         fmt::join(notes, "; "));
    }
    for (const std::string& note : notes) {
        say_line(program, note);
    }
    return {};
}

Result<void> check_folder(const std::filesystem::path& folder) {
    std::error_code ignored;
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
        return bad_input("words.no_folder",
                         "{}: this is not a folder; name a folder with files such as de.toml, or leave it "
                         "out to use the built-in words",
                         folder.string());
    }
    return {};
}

/// The named languages, with the usual case of their tags.
Result<std::vector<std::string>> named_languages(const std::vector<std::string>& written) {
    std::vector<std::string> languages;
    for (const std::string& each : written) {
        const std::string found = fmt::format("--languages: '{}'", printable(each, 40));
        const std::optional<std::string> language = settings::parse_language_tag(each);
        if (!language) {
            return bad_input("words.language", "{} is not a language; allowed are {}", found,
                             settings::allowed_language_tags);
        }
        if (std::find(languages.begin(), languages.end(), *language) != languages.end()) {
            return bad_input("words.language_twice", "{} is named twice; write each language once", found);
        }
        languages.push_back(*language);
    }
    return languages;
}

Result<void> write_outputs(const texts::BakedWords& baked, const Arguments& arguments) {
    TRY(const Bytes bytes, pack::write_words(baked.languages));
    TRY_VOID(write_file(arguments.output, bytes));
    fmt::print("{}: {} words in {} languages, {} kB\n", arguments.output.string(),
               baked.languages.front().words.size(), baked.languages.size(), (bytes.size() + 999) / 1000);
    for (const pack::LanguageWords& words : baked.languages) {
        fmt::print("  {:<8}{:<14}{:>5} letters, {:>3} spoken\n", words.language, words.name,
                   words.runs.boxes.size(), words.sounds.size());
    }
    if (!arguments.preview.empty()) {
        return write_file(arguments.preview, image::encode_png(words_preview(baked.languages)));
    }
    return {};
}

Result<void> speak(texts::BakedWords& baked, const Arguments& arguments) {
    ProgressLine progress("speaking: ");
    texts::SpeakOptions options{arguments.folder, std::nullopt, {}};
    if (arguments.speech != "none") {
        options.voice = arguments.speech.empty() ? texts::Voice() : texts::Voice(arguments.speech);
    }
    options.progress = [&](std::string_view what, double done) { progress.show_share(what, done); };
    TRY(const std::vector<std::string> silent, texts::speak_words(baked.languages, options));
    progress.clear();
    for (const std::string& sentence : silent) {
        say_line(program, sentence);
    }
    return {};
}

/// Checks, before the work, that the output replaces no input and only a file of its kind.
Result<void> check_output(const std::filesystem::path& output, bool is_of_kind, const char* kind,
                          bool force) {
    TRY_VOID(check_output_place(output));
    std::error_code ignored;
    if (!force && std::filesystem::exists(output, ignored) && !is_of_kind) {
        return bad_input("words.not_replaced",
                         "{}: this file exists and is not {}; choose another name for the output, or add "
                         "--force to replace it",
                         output.string(), kind);
    }
    return {};
}

bool is_words_file(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file);
    return bytes && pack::list_words(*bytes);
}

bool is_png_file(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file);
    return bytes && as_text(*bytes).starts_with("\x89PNG\r\n");
}

Result<void> check_outputs(const Arguments& arguments) {
    Result<void> checked =
        check_output(arguments.output, is_words_file(arguments.output), "a file of words", arguments.force);
    if (!checked || arguments.preview.empty()) {
        return checked;
    }
    if (std::filesystem::absolute(arguments.preview).lexically_normal() ==
        std::filesystem::absolute(arguments.output).lexically_normal()) {
        return bad_input("words.same_name", "{}: the words and their picture have the same name; choose two",
                         arguments.output.string());
    }
    return check_output(arguments.preview, is_png_file(arguments.preview), "a PNG picture", arguments.force);
}

Result<void> check_outputs_are_no_inputs(const Arguments& arguments, const WordsFolder& folder,
                                         const WordRecordings& recordings) {
    for (const auto& inputs : {folder.word_files, recordings.taken}) {
        for (const auto& output : {arguments.output, arguments.preview}) {
            TRY_VOID(check_output_is_no_input(output, inputs));
        }
    }
    return {};
}

/// Languages that are left out on purpose, because the command line names others.
std::vector<std::string> left_out_of(const std::vector<std::string>& all,
                                     const std::vector<std::string>& baked) {
    std::vector<std::string> left_out;
    std::copy_if(all.begin(), all.end(), std::back_inserter(left_out), [&](const std::string& language) {
        return std::find(baked.begin(), baked.end(), language) == baked.end();
    });
    return left_out;
}

/// Reads the words, with notes on what may be lost of the folder; checks that no output is an input.
Result<std::vector<texts::CollectedWords>> collect(const Arguments& arguments,
                                                   std::vector<std::string>& notes) {
    const WordsFolder folder = list_words_folder(arguments.folder);
    TRY(const std::vector<std::string> named, named_languages(arguments.languages));
    const std::vector<std::string>& languages = named.empty() ? folder.languages : named;
    TRY(std::vector<texts::CollectedWords> collected, texts::collect_words(arguments.folder, languages));
    const WordRecordings recordings =
        list_word_recordings(arguments.folder, collected, left_out_of(folder.languages, languages));
    TRY_VOID(check_outputs_are_no_inputs(arguments, folder, recordings));
    notes = folder.notes;
    notes.insert(notes.end(), recordings.notes.begin(), recordings.notes.end());
    return collected;
}

Result<void> work(const Arguments& arguments) {
    TRY_VOID(check_folder(arguments.folder));
    TRY_VOID(check_outputs(arguments));
    std::vector<std::string> notes;
    TRY(const std::vector<texts::CollectedWords> collected, collect(arguments, notes));
    TRY(const texts::Shaper shaper, texts::Shaper::open());
    TRY(texts::BakedWords baked, texts::bake_words(collected, shaper));
    notes.insert(notes.end(), baked.notes.begin(), baked.notes.end());
    TRY_VOID(tell(notes, arguments.strict));
    TRY_VOID(speak(baked, arguments));
    return write_outputs(baked, arguments);
}

} // namespace

int words_command(int argc, char** argv) {
    Arguments arguments;
    CommandLine app("Bakes the exhibit's own words (advice, faults, invitations) into a file for the kiosk.",
                    program);
    app.set_version_flag("--version", name_and_version("frustumscreen-bake"));
    app.add_option("--words", arguments.folder,
                   "folder with LANGUAGE.toml files (default: the built-in words)")
        .expected(0, 1);
    app.add_option("-o,--output", arguments.output, "file to write (*.fswords)").required();
    app.add_option("--languages", arguments.languages,
                   "languages, the exhibit's first language first, such as en,de (default: all built-in ones "
                   "and those of the folder)")
        .delimiter(',');
    app.add_option("--preview", arguments.preview, "PNG to draw all texts into");
    app.add_option("--speech", arguments.speech,
                   "program that reads text from standard input and writes WAV; {language} stands for the "
                   "language; none: no voice (default: espeak-ng)");
    app.add_flag("--force", arguments.force, "replace an output file that is not a file of words");
    app.add_flag("--strict", arguments.strict, "write nothing if any words would be lost");
    if (const auto end = app.end_of_arguments(argc, argv)) {
        return *end;
    }
    return exit_status(program, work(arguments));
}

} // namespace frustumscreen::programs
