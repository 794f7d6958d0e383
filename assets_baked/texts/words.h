/// The exhibit's own words as a museum writes them: a folder with one file LANGUAGE.toml for each language.
///
/// A file has the keys of words/en.toml, those with a dot in tables: `[advice]` with `slide_left = "..."`. A
/// missing key falls back; a key that only an earlier version used is read, but not shown. A museum's folder
/// may contain only a few lines; the rest come from the built-in words.
///
/// Errors   one sentence: file, line, key, problem, allowed values.
/// Threads  pure except for reading files; any.
#pragma once

#include "firmware_host/base/result.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::texts {

/// Text by key; keys missing in a file are absent.
using WrittenWords = std::map<std::string, std::string, std::less<>>;

/// `file` is for messages.
[[nodiscard]] Result<WrittenWords> parse_words(std::string_view toml, const std::string& file);

struct Word {
    std::string key;
    std::string text;
    std::string language; ///< language of `text`
};

struct CollectedWords {
    std::string language;
    std::vector<Word> words;        ///< one for each key, in the order of words/en.toml
    std::vector<std::string> notes; ///< missing lines and lines that are no longer shown, a sentence each
};

/// One for each of `languages` (BCP 47); the first is the house's. A line is searched for in the language's
/// file in `folder`, in the built-in words, then in the house's language in both. `folder` may be empty: only
/// the built-in words.
[[nodiscard]] Result<std::vector<CollectedWords>> collect_words(const std::filesystem::path& folder,
                                                                std::span<const std::string> languages);

/// The languages of the built-in words.
[[nodiscard]] std::vector<std::string> builtin_word_languages();

} // namespace frustumscreen::texts
