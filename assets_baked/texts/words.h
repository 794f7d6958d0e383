/// The exhibit's own words as a museum writes them: a folder with one file LANGUAGE.toml for each language.
///
/// A file has the keys of words/en.toml, those with a dot in tables: `[advice]` with `slide_left = "..."`. A key that is left out
/// falls back; one that only an earlier version knew is read, and not shown. A museum's folder may hold a few lines only; the rest
/// are the built-in words.
///
/// Errors   one sentence: file, line, key, what is wrong, what is allowed.
/// Threads  pure; any.
#pragma once

#include "firmware_host/base/result.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

/// Text by key; what a file leaves out is not there.
using WrittenWords = std::map<std::string, std::string, std::less<>>;

/// `file` is for messages.
[[nodiscard]] Result<WrittenWords> parse_words(std::string_view toml, const std::string& file);

struct Word {
    std::string key;
    std::string text;
    std::string language; ///< that it is written in
};

struct CollectedWords {
    std::string language;
    std::vector<Word> words;        ///< one for each key, in the order of words/en.toml
    std::vector<std::string> notes; ///< which lines were missing, which are no longer shown; a sentence each
};

/// One for each of `languages` (BCP 47), of which the first is the house's. A line is looked for in the language's file in
/// `folder`, in the built-in words, then in the house's language in both. `folder` may be empty: the built-in words alone.
[[nodiscard]] Result<std::vector<CollectedWords>> collect_words(const std::filesystem::path& folder,
                                                                std::span<const std::string> languages);

/// The languages that the built-in words have.
[[nodiscard]] std::vector<std::string> builtin_word_languages();

} // namespace frustumscreen
