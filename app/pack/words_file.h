/// The file of the exhibit's own words, `*.fswords`: advice, faults and invitations in several languages, as plain text, set
/// (glyph_runs.h) and, where there is a voice, spoken. FORMAT.md has its parts.
///
/// Errors   one line: anything but a whole file of this format; a part that is not what the manifest says.
/// Threads  pure; any.
#pragma once

#include "app/pack/glyph_runs.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {

struct PlainWord {
    std::string key;
    std::string text;
    std::string language; ///< BCP 47; that of the house where a line was missing
    bool operator==(const PlainWord&) const = default;
};

struct LanguageWords {
    std::string language; ///< BCP 47
    std::string name;     ///< its own
    std::vector<PlainWord> words;
    GlyphRuns runs; ///< a text for each word, of the same key
    DistanceAtlas atlas;
    std::map<std::string, Bytes> sounds; ///< Ogg Opus by key; words without one are silent
};

/// The first language is the house's. At least one.
[[nodiscard]] Result<Bytes> write_words(std::span<const LanguageWords> languages);

struct WordsLanguage {
    std::string language;
    std::string name;
    std::size_t words = 0;
    std::size_t sounds = 0;
};
[[nodiscard]] Result<std::vector<WordsLanguage>> list_words(std::span<const std::byte> file);

/// Reads one language and no part of the others; `language` is one that the file has.
[[nodiscard]] Result<LanguageWords> read_words(std::span<const std::byte> file, std::string_view language);

} // namespace frustumscreen
