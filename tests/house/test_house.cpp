// Rules for every file of the project.
#include "tests/base/temporary_folder.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr int max_lines = 600;

/// The house's own files with one of these endings, relative to the root.
std::vector<fs::path> files_ending(const std::vector<std::string>& endings) {
    const fs::path root = frustumscreen::source_dir();
    std::vector<fs::path> files;
    for (const char* folder : {"app", "firmware_host", "assets_baked", "tests", "cmake", "config"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string ending = entry.path().extension();
            for (const std::string& wanted : endings) {
                if (entry.is_regular_file() && ending == wanted) {
                    files.push_back(fs::relative(entry.path(), root));
                }
            }
        }
    }
    EXPECT_FALSE(files.empty());
    return files;
}

/// Every page, relative to the root; not those of builds.
std::vector<fs::path> pages() {
    const fs::path root = frustumscreen::source_dir();
    std::vector<fs::path> pages;
    for (auto entry = fs::recursive_directory_iterator(root); entry != fs::end(entry); ++entry) {
        const fs::path path = fs::relative(entry->path(), root);
        if (path == "build" || path == "out" || path == ".git") {
            entry.disable_recursion_pending();
        } else if (path.extension() == ".md") {
            pages.push_back(path);
        }
    }
    return pages;
}

std::vector<std::string> lines_of(const fs::path& file) {
    std::ifstream stream(fs::path(frustumscreen::source_dir()) / file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// The files and folders that a page links to, relative to the root; links into the web and code blocks are left out.
std::set<fs::path> linked_from(const fs::path& page) {
    static const std::regex link(R"(\]\(([^)#\s]+)[^)]*\))"); // [text](target#heading "title")
    std::set<fs::path> targets;
    bool in_code = false;
    for (const std::string& line : lines_of(page)) {
        in_code = in_code != (line.rfind("```", 0) == 0);
        if (in_code) {
            continue;
        }
        for (std::sregex_iterator match(line.begin(), line.end(), link), end; match != end; ++match) {
            const std::string target = (*match)[1];
            if (target.find("://") == std::string::npos && target.rfind("mailto:", 0) != 0) {
                targets.insert((page.parent_path() / target).lexically_normal());
            }
        }
    }
    return targets;
}

/// The literals that stand for a `MessageId`: first behind what makes an error.
std::set<std::string> message_ids_in(const fs::path& file) {
    static const std::regex id(
        R"re(\b(?:bad_input|refuse|require|refusal|refused|lost|bad|fail|Error|Refusal)\s*[({]+\s*(?:[^"();{}]*,\s*(?://[^\n]*\n\s*)?)?"([a-z0-9_]+\.[a-z0-9_]+)"\s*,)re");
    const std::string text = frustumscreen::text_of(fs::path(frustumscreen::source_dir()) / file);
    std::set<std::string> ids;
    for (std::sregex_iterator match(text.begin(), text.end(), id), end; match != end; ++match) {
        ids.insert((*match)[1]);
    }
    return ids;
}

TEST(House, MessageIdsAreUniqueToOneFile) {
    std::map<std::string, fs::path> owners;
    for (const fs::path& file : files_ending({".cpp", ".h"})) {
        if (*file.begin() == "tests") {
            continue;
        }
        for (const std::string& id : message_ids_in(file)) {
            const auto [owner, is_new] = owners.emplace(id, file);
            EXPECT_TRUE(is_new) << id << " is in " << owner->second << " and in " << file
                                << "; give each sentence an id of its own";
        }
    }
    EXPECT_GT(owners.size(), 400U);
}

/// A path of this clone in a precompiled header would make every file that reads it unknown to ccache in another clone.
TEST(House, GeneratedSourcesDoNotContainThePathOfTheClone) {
    const fs::path build = frustumscreen::build_dir();
    std::vector<fs::path> files;
    for (const fs::path& folder : {build / "CMakeFiles", build / "together"}) {
        if (fs::exists(folder)) {
            for (const auto& entry : fs::recursive_directory_iterator(folder)) {
                const std::string name = entry.path().filename();
                if (name == "cmake_pch.hxx" || entry.path().extension() == ".cpp") {
                    files.push_back(entry.path());
                }
            }
        }
    }
    if (files.empty()) {
        GTEST_SKIP() << "this build has none";
    }
    for (const fs::path& file : files) {
        for (const std::string& line : lines_of(file)) {
            EXPECT_EQ(line.find(frustumscreen::source_dir()), std::string::npos) << file << ": " << line;
        }
    }
}

class SlowestTimes : public frustumscreen::WithTemporaryFolder {};

/// More lines than a pipe holds: a reader that ends early would end the script.
TEST_F(SlowestTimes, AreListedFromALargeTable) {
    const fs::path times = folder / "times.tsv";
    std::ofstream out(times);
    for (int k = 0; k < 5000; ++k) {
        out << k << ".50\t1.00\tcompile\tapp/a/room/with/a/long/name/some_source_" << k << ".cpp.o\n";
    }
    out.close();
    const fs::path listed = folder / "listed";
    const std::string script = frustumscreen::source_dir() + "/tests/house/list_slowest.sh";
    EXPECT_EQ(std::system((script + " '" + times.string() + "' >'" + listed.string() + "'").c_str()), 0);
    const std::vector<std::string> lines = lines_of(listed);
    ASSERT_EQ(lines.size(), 12U);
    EXPECT_NE(lines[1].find("some_source_4999.cpp.o"), std::string::npos) << lines[1];
    EXPECT_NE(lines[10].find("some_source_4990.cpp.o"), std::string::npos) << lines[10];
    EXPECT_NE(lines[11].find("all 5000 of kind compile"), std::string::npos) << lines[11];
}

} // namespace

/// A name that begins with one of these words states no behaviour, such as WhatIsWrongIsSaid.
TEST(House, TestNamesBeginWithASubjectOrAVerb) {
    const std::set<std::string> refused{"of", "what", "who", "whose", "where", "nobody"};
    const std::regex macro(R"(^TEST(?:_F|_P)?\(\w+, *(?:DISABLED_)?([A-Za-z][a-z]*))");
    const std::regex method(R"(^ +(?:async )?def test_([a-z]+))");
    std::size_t names = 0;
    for (const fs::path& file : files_ending({".cpp", ".py"})) {
        for (const std::string& line : lines_of(file)) {
            std::smatch found;
            if (std::regex_search(line, found, file.extension() == ".py" ? method : macro)) {
                ++names;
                std::string word = found[1];
                word[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(word[0])));
                EXPECT_FALSE(refused.contains(word)) << file << ": " << line;
            }
        }
    }
    EXPECT_GT(names, 3500U);
}

TEST(House, FilesStayWithinTheLimitOfLines) {
    for (const fs::path& file : files_ending({".h", ".cpp", ".cmake", ".sh"})) {
        EXPECT_LE(lines_of(file).size(), static_cast<std::size_t>(max_lines)) << file;
    }
}

/// Where a string, a character, a raw string or a comment that begins at `at` ends; `at` where none begins.
std::size_t end_of_words(const std::string& text, std::size_t at) {
    const auto behind = [&](const std::string& end, std::size_t from) {
        const std::size_t found = text.find(end, from);
        return found == std::string::npos ? text.size() : found + end.size();
    };
    const char first = text[at];
    if (text.compare(at, 2, "R\"") == 0) {
        const std::size_t open = text.find('(', at);
        return behind(")" + text.substr(at + 2, open - at - 2) + "\"", open);
    }
    if (text.compare(at, 2, "//") == 0) {
        return behind("\n", at);
    }
    if (text.compare(at, 2, "/*") == 0) {
        return behind("*/", at);
    }
    const bool is_digit_separator =
        first == '\'' && at > 0 && std::isxdigit(static_cast<unsigned char>(text[at - 1])) != 0;
    if ((first != '"' && first != '\'') || is_digit_separator) {
        return at;
    }
    std::size_t end = at + 1;
    while (end < text.size() && text[end] != first) {
        end += text[end] == '\\' ? 2U : 1U;
    }
    return end + 1;
}

/// A file's identifiers: strings and comments are left out.
std::set<std::string> identifiers_of(const fs::path& file) {
    const std::string text = frustumscreen::text_of(fs::path(frustumscreen::source_dir()) / file);
    const auto is_word = [&](std::size_t k) {
        return std::isalnum(static_cast<unsigned char>(text[k])) != 0 || text[k] == '_';
    };
    std::set<std::string> found;
    for (std::size_t at = 0; at < text.size();) {
        if (const std::size_t end = end_of_words(text, at); end != at) {
            at = end;
            continue;
        }
        const std::size_t begin = at;
        while (at < text.size() && is_word(at)) {
            ++at;
        }
        if (at > begin) {
            found.insert(text.substr(begin, at - begin));
        } else {
            ++at;
        }
    }
    return found;
}

/// The words behind 'Identifiers do not use' in docs/glossary.md, each in backquotes; with `_` at its end it is a prefix.
std::vector<std::string> words_not_used() {
    std::vector<std::string> words;
    for (const std::string& line : lines_of("docs/glossary.md")) {
        if (line.starts_with("Identifiers do not use")) {
            static const std::regex quoted("`(\\w+)`");
            for (std::sregex_iterator match(line.begin(), line.end(), quoted), end; match != end; ++match) {
                words.push_back((*match)[1]);
            }
        }
    }
    return words;
}

TEST(House, IdentifiersUseNoWordThatTheGlossaryReplaces) {
    const std::vector<std::string> words = words_not_used();
    ASSERT_GE(words.size(), 10U);
    // In an identifier a word begins with a capital, or between underscores.
    std::string any;
    for (const std::string& word : words) {
        const std::string capital = std::string(1, static_cast<char>(std::toupper(word[0]))) + word.substr(1);
        any += word.ends_with('_') ? "|^" + word : "|(^|_)" + word + "(_|$)|" + capital + "(?![a-z])";
    }
    const std::regex replaced(any.substr(1));
    std::size_t looked_at = 0;
    for (const fs::path& file : files_ending({".cpp", ".h"})) {
        for (const std::string& identifier : identifiers_of(file)) {
            EXPECT_FALSE(std::regex_search(identifier, replaced))
                << file << ": " << identifier << "; docs/glossary.md has the word that is used instead";
            ++looked_at;
        }
    }
    EXPECT_GT(looked_at, 10000U);
}

TEST(House, FilesHaveNoMarksOfUnfinishedWork) {
    const std::vector<std::string> marks = {std::string("TO") + "DO", std::string("FIX") + "ME",
                                            std::string("XX") + "X:"};
    for (const fs::path& file : files_ending({".h", ".cpp", ".cmake", ".sh", ".txt", ".md", ".toml"})) {
        int number = 0;
        for (const std::string& line : lines_of(file)) {
            ++number;
            for (const std::string& mark : marks) {
                EXPECT_EQ(line.find(mark), std::string::npos) << file << ":" << number;
            }
        }
    }
}

TEST(House, EveryHeaderBeginsWithADescription) {
    for (const fs::path& file : files_ending({".h"})) {
        if (file.begin()->string() == "tests") {
            continue;
        }
        const std::vector<std::string> lines = lines_of(file);
        ASSERT_FALSE(lines.empty()) << file;
        EXPECT_EQ(lines.front().rfind("/// ", 0), 0U) << file << " does not begin with a /// comment";
    }
}

/// A file that bypasses json.h compiles the whole library again.
TEST(House, JsonIsIncludedOnlyThroughItsHeader) {
    for (const fs::path& file : files_ending({".h", ".cpp"})) {
        for (const std::string& line : lines_of(file)) {
            EXPECT_TRUE(line != "#include <nlohmann/json.hpp>" || file == "firmware_host/base/json.h")
                << file;
        }
    }
}

TEST(House, EveryFileIsFormatted) {
    if (std::system("command -v clang-format >/dev/null") != 0) {
        GTEST_SKIP() << "clang-format is not installed";
    }
    std::string command =
        "cd '" + frustumscreen::source_dir() + "' && clang-format --dry-run -Werror --ferror-limit=1";
    for (const fs::path& file : files_ending({".h", ".cpp"})) {
        command += " '" + file.string() + "'";
    }
    EXPECT_EQ(std::system(command.c_str()), 0) << "run clang-format -i on the files named above";
}

class SkippedTests : public frustumscreen::WithTemporaryFolder {};

/// The output of GoogleTest 1.12, copied by hand.
TEST_F(SkippedTests, AreListedWithTheirReasons) {
    const std::string log = folder / "tests.log";
    const std::string listed = folder / "listed.txt";
    std::ofstream(log)
        << "[ RUN      ] A.Passes\n[       OK ] A.Passes (0 ms)\n[ RUN      ] A.Traces\n"
           "/x/a_test.cpp:170: Skipped\nthis machine allows no tracing\n\n[  SKIPPED ] A.Traces (3 ms)\n"
           "[ RUN      ] B.Silent\n/x/b_test.cpp:3: Skipped\n\n\n[  SKIPPED ] B.Silent (0 ms)\n"
           "[  PASSED  ] 1 test.\n[  SKIPPED ] 2 tests, listed below:\n[  SKIPPED ] A.Traces\n"
           "[  SKIPPED ] B.Silent\n";
    const std::string script = "'" + frustumscreen::source_dir() + "/tests/house/list_skipped.sh' '";
    ASSERT_EQ(std::system((script + log + "' >'" + listed + "'").c_str()), 0);
    EXPECT_EQ(text("listed.txt"), "== 2 tests were skipped\n   A.Traces: this machine allows no tracing\n"
                                  "   B.Silent: it does not say why\n");
}

TEST(House, EveryLinkInPagesLeadsToAFile) {
    std::size_t links = 0;
    for (const fs::path& page : pages()) {
        for (const fs::path& target : linked_from(page)) {
            ++links;
            EXPECT_TRUE(fs::exists(fs::path(frustumscreen::source_dir()) / target)) << page << ": " << target;
        }
    }
    EXPECT_GT(links, 0U);
}

TEST(House, EveryOwnerOfAThreadIsInTheTableOfThreads) {
    static const std::regex thread_member(R"(std::j?thread>? [a-z_]+;)");
    const std::string page =
        frustumscreen::text_of(fs::path(frustumscreen::source_dir()) / "ARCHITECTURE.md");
    const std::size_t begin = page.find("\n## Threads\n");
    ASSERT_NE(begin, std::string::npos);
    const std::string section = page.substr(begin, page.find("\n## ", begin + 1) - begin);
    std::size_t owners = 0;
    for (const fs::path& file : files_ending({".h"})) {
        const std::string text = frustumscreen::text_of(fs::path(frustumscreen::source_dir()) / file);
        if (*file.begin() == "tests" || !std::regex_search(text, thread_member)) {
            continue;
        }
        ++owners;
        const std::string name = file.parent_path().filename() / file.stem();
        EXPECT_NE(section.find("`" + name + "`"), std::string::npos) << name;
    }
    EXPECT_GT(owners, 15U);
}

TEST(House, TheIndexNamesEveryPage) {
    const fs::path index = "docs/README.md";
    const std::set<fs::path> named = linked_from(index);
    for (const fs::path& page : pages()) {
        EXPECT_TRUE(page == index || named.count(page) == 1) << page << " is not in " << index;
    }
}
