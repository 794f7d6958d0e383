// The staff's guide has a row for every sentence that the table, the safe picture and the staff's picture can show. The
// sentences are read from the programs' sources, so that a new one without a row fails here.

#include "tests/folders.h"
#include "tests/guide/string_literals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
const fs::path root = frustumscreen::source_dir();

/// Sources whose sentences reach the staff.
constexpr const char* sources[] = {"app/counts/counts_folder.cpp",
                                   "app/counts/day_counts.cpp",
                                   "app/drift",
                                   "app/exhibit",
                                   "app/guidance",
                                   "app/kiosk_copy",
                                   "app/safe",
                                   "app/residency",
                                   "app/report",
                                   "app/scene/other_prop.cpp",
                                   "app/show",
                                   "app/status",
                                   "app/typography",
                                   "app/watch",
                                   "app/programs/calibrate/auto_picture.cpp",
                                   "app/programs/calibrate/eye_picture.cpp",
                                   "app/programs/calibrate/table_words.cpp",
                                   "app/programs/calibrate/touch_picture.cpp",
                                   "app/programs/watchdog",
                                   "firmware_host/camera",
                                   "firmware_host/display",
                                   "firmware_host/panel",
                                   "firmware_host/service",
                                   "firmware_host/sound",
                                   "firmware_host/tracker",
                                   "app/library/library_folder.cpp",
                                   "app/library/own_settings.cpp",
                                   "app/library/report_request.cpp",
                                   "app/library/set_file.cpp",
                                   "app/library/signed_text.cpp",
                                   "app/library/stick_settings.cpp"};

/// A source with sentences that none of the three pictures shows, and the reason.
struct ExemptSource {
    const char* file;
    const char* why;
};
constexpr ExemptSource exempt[] = {
    {"app/drift/drift_reference.cpp", "the journal"},
    {"app/exhibit/states.h", "docs/states.md has them, and a test of its own"},
    {"app/exhibit/states_page.cpp", "the page docs/states.md"},
    {"app/typography/text_image.cpp", "ends the program before its first picture"},
    {"app/programs/watchdog/watchdog_main.cpp", "the command line"},
    {"app/show/artifact_show_start.cpp", "the journal"},
    {"app/residency/artifact_texts.cpp", "the journal"},
    {"app/show/default_words.cpp", "the journal"},
    {"app/show/import_journal.cpp", "the journal"},
    {"app/show/import_watch.cpp", "the journal"},
    {"app/show/last_good_settings.cpp", "the journal and the status file"},
    {"app/show/notice_show.cpp", "the journal"},
    {"app/residency/prompt_reader.cpp", "the journal"},
    {"app/residency/torch_contents.cpp", "the journal"},
    {"app/show/offline_scene.cpp", "frustumscreen render"},
    {"app/show/offline_site.cpp", "frustumscreen render"},
    {"app/show/offline_torch.cpp", "frustumscreen render"},
    {"app/show/run_hours.cpp", "the journal and the status file"},
    {"app/show/run_loop.cpp", "the journal"},
    {"app/show/run_watch.cpp", "the journal"},
    {"app/show/screen_output.cpp",
     "docs/second_screen.md has them; else the projector's sentences in other words"},
    {"app/show/screenshot.cpp", "frustumscreen status --screenshot"},
    {"app/show/shown_set.cpp", "the journal"},
    {"app/show/table_show.cpp", "the journal"},
    {"app/status/describe_devices.h", "docs/status.md has them, and a test of its own; numbers for programs"},
    {"app/status/describe_status.h", "docs/status.md has them, and a test of its own; numbers for programs"},
    {"app/status/prometheus_text.cpp", "numbers for programs"},
    {"app/status/set_status.cpp", "the journal and systemctl status"},
    {"app/status/watchdog_status.h", "numbers for programs"},
    {"firmware_host/camera/camera_set_up.h", "frustumscreen camera"},
    {"firmware_host/display/shader_cache.cpp", "the journal"},
    {"firmware_host/service/ask_staff_socket.cpp", "frustumscreen status --screenshot"},
    {"firmware_host/service/crash_record.cpp", "the journal"},
    {"firmware_host/service/staff_socket.cpp", "frustumscreen status --screenshot"},
    {"firmware_host/service/stop_signals.cpp", "the journal"},
    {"firmware_host/sound/opus_reader.cpp", "packs, when they are baked"},
    {"firmware_host/tracker/convert_recording.cpp", "files, when they are converted"},
    {"firmware_host/tracker/packet_file.cpp", "files, when they are read"},
    {"firmware_host/tracker/packet_replay.cpp", "files, when they are read"},
    {"firmware_host/tracker/pose_file.cpp", "files, when they are read"},
    {"firmware_host/tracker/pose_path.cpp", "files, when they are made"},
};

/// Sentences that are never shown, of sources that also have shown ones.
constexpr const char* never_shown[] = {
    "FrustumScreen kiosk copy 1",      // in the file of a copy
    "not wanted any more",             // ends a thread's work; not shown
    "no picture for the staff",        // the journal
    "texts left out",                  // the journal
    "a region's finer level left out", // the journal
};

std::string text_of(const fs::path& file) {
    std::ifstream stream(root / file, std::ios::binary);
    EXPECT_TRUE(stream.good()) << file;
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Reduces white space to single spaces, and replaces the fields that a program fills in by "...", as on the page.
std::string as_written(const std::string& text) {
    static const std::regex field(R"(\{[^{}]*\})");
    static const std::regex dots(R"(\.\.\.(\.\.\.)+)");
    static const std::regex space(R"(\s+)");
    return std::regex_replace(std::regex_replace(std::regex_replace(text, field, "..."), dots, "..."), space,
                              " ");
}

/// Without the punctuation that joins it to its neighbours.
std::string bare(std::string text) {
    const auto joins = [](char c) { return std::string_view(" .,;:").find(c) != std::string_view::npos; };
    text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), joins));
    text.erase(std::find_if_not(text.rbegin(), text.rend(), joins).base(), text.end());
    return text;
}

/// True for three words or more; shorter texts are names, keys or parts of a file's format.
bool is_sentence(const std::string& text) {
    static const std::regex word(R"([A-Za-z']{2,}[,;:.]? )");
    const auto words = std::distance(std::sregex_iterator(text.begin(), text.end(), word), {});
    return words >= 2 && text.find_first_of("<>\\#$") == std::string::npos;
}

/// The sentences in the first columns of the page's tables; a row may have several.
std::vector<std::string> named_on_the_page() {
    static const std::regex first_cell(R"(^\| (.*?) \|.*)");
    static const std::regex several(R"( ?<br> ?)");
    std::vector<std::string> named;
    std::istringstream lines(text_of("docs/guide/messages.md"));
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (std::regex_match(line, match, first_cell)) {
            const std::string cell = as_written(match[1]);
            std::copy(std::sregex_token_iterator(cell.begin(), cell.end(), several, -1), {},
                      std::back_inserter(named));
        }
    }
    return named;
}

/// Programs join sentences from parts: a part has a row if a row contains it between two joints.
bool is_named(const std::string& sentence) {
    static const std::vector<std::string> named = named_on_the_page();
    const auto is_joint = [](const std::string& text, std::size_t at) {
        return at >= text.size() || std::string_view(" .,;:()").find(text[at]) != std::string_view::npos;
    };
    return std::any_of(named.begin(), named.end(), [&](const std::string& row) {
        for (std::size_t at = row.find(sentence); at != std::string::npos; at = row.find(sentence, at + 1)) {
            if (is_joint(row, at - 1) && is_joint(row, at + sentence.size())) {
                return true;
            }
        }
        return false;
    });
}

void expect_named(const std::string& sentence, const fs::path& from) {
    EXPECT_TRUE(is_named(sentence)) << from << " says\n    " << sentence
                                    << "\nand docs/guide/messages.md has no row for it";
}

std::vector<fs::path> files_of(const char* folder) {
    if (fs::is_regular_file(root / folder)) {
        return {folder};
    }
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") {
            files.push_back(fs::relative(entry.path(), root));
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// The texts of a TOML file below the table [`only`]; all of them if `only` is empty.
std::vector<std::string> toml_texts(const fs::path& file, const std::string& only) {
    static const std::regex line_form(R"re(^\s*\w+\s*=\s*"(.*)"\s*$)re");
    static const std::regex table_form(R"(^\[(.*)\]$)");
    std::vector<std::string> texts;
    std::string table;
    std::ifstream stream(root / file);
    for (std::string line; std::getline(stream, line);) {
        std::smatch match;
        if (std::regex_match(line, match, table_form)) {
            table = match[1];
        } else if (std::regex_match(line, match, line_form) && (only.empty() || table == only)) {
            texts.push_back(match[1]);
        }
    }
    return texts;
}

} // namespace

TEST(Guide, ReadsStringLiteralsLikeTheCompiler) {
    EXPECT_EQ(string_literals(
                  "#include \"a b c\"\nf(\"one \" // \"not this\"\n  \"two\", \"three\"); /* \"nor this\" */"
                  "g('\"', \"fo\\\"ur\", 1'000, R\"(raw \" text)\", \"five\");"),
              (std::vector<std::string>{"one two", "three", "fo\"ur", "five"}));
    EXPECT_EQ(bare(as_written("; the {}{} of\n {:.1f} s: ")), "the ... of ... s");
    EXPECT_TRUE(is_sentence("the tracker is running"));
    EXPECT_FALSE(is_sentence("frame_ms"));
}

/// The sentences of a source file that may reach the staff.
std::vector<std::string> sentences_of(const fs::path& file) {
    std::vector<std::string> sentences;
    for (const std::string& literal : string_literals(text_of(file))) {
        if (std::string sentence = bare(as_written(literal)); is_sentence(sentence)) {
            sentences.push_back(std::move(sentence));
        }
    }
    return sentences;
}

TEST(Guide, NamesEverySentenceOfThePrograms) {
    std::set<std::string> unknown;
    for (const ExemptSource& each : exempt) {
        unknown.insert(each.file);
    }
    std::set<std::string> never_met(std::begin(never_shown), std::end(never_shown));
    std::size_t sentences = 0;
    for (const char* folder : sources) {
        for (const fs::path& file : files_of(folder)) {
            if (unknown.count(file.string()) == 1) {
                continue;
            }
            for (const std::string& sentence : sentences_of(file)) {
                never_met.erase(sentence);
                if (std::find(std::begin(never_shown), std::end(never_shown), sentence) ==
                    std::end(never_shown)) {
                    ++sentences;
                    expect_named(sentence, file);
                }
            }
        }
    }
    EXPECT_GT(sentences, 300U);
    EXPECT_TRUE(never_met.empty()) << *never_met.begin() << " is in no program";
}

/// A file whose sentences all have rows must not be in `exempt`, so that it is tested.
TEST(Guide, ExemptsNoFileWhoseSentencesAreAllNamed) {
    for (const ExemptSource& each : exempt) {
        const std::vector<std::string> sentences = sentences_of(each.file);
        EXPECT_FALSE(std::all_of(sentences.begin(), sentences.end(), is_named)) << each.file;
        EXPECT_TRUE(std::any_of(
            std::begin(sources), std::end(sources),
            [&](const std::string& source) { return std::string(each.file).starts_with(source); }))
            << each.file << " is in no folder that is looked at";
    }
}

TEST(Guide, NamesEveryTextOfTheTable) {
    const fs::path file = "assets_baked/texts/words/en.toml";
    const std::vector<std::string> texts = toml_texts(file, "");
    EXPECT_GT(texts.size(), 40U);
    for (const std::string& text : texts) {
        if (text != "English") {
            expect_named(as_written(text), file);
        }
    }
}

TEST(Guide, NamesEveryTextOfTheSafePicture) {
    const fs::path file = "assets_baked/safe/words.toml";
    const std::vector<std::string> texts = toml_texts(file, "en");
    EXPECT_EQ(texts.size(), 2U);
    for (const std::string& text : texts) {
        expect_named(as_written(text), file);
    }
}
