/// The file of the exhibit's own words, `*.fswords`: advice, faults and invitations in several languages, as plain
/// text, set (glyph_runs.h) and, if there is a voice, spoken. FORMAT.md has its parts.
///
/// Errors   one line: a file that is incomplete or of another format; a part that contradicts the manifest.
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

namespace frustumscreen::pack {

struct PlainWord {
    std::string key;
    std::string text;
    std::string language; ///< BCP 47; the first language where a line was missing
    bool operator==(const PlainWord&) const = default;
};

struct LanguageWords {
    std::string language; ///< BCP 47
    std::string name;     ///< in the language itself
    std::vector<PlainWord> words;
    GlyphRuns runs; ///< a text for each word, of the same key
    DistanceAtlas atlas;
    std::map<std::string, Bytes> sounds; ///< Ogg Opus by key; a word without a sound is silent
};

/// The first language is the museum's default. At least one is needed.
[[nodiscard]] Result<Bytes> write_words(std::span<const LanguageWords> languages);

struct WordsLanguage {
    std::string language;
    std::string name;
    std::size_t words = 0;
    std::size_t sounds = 0;
};
[[nodiscard]] Result<std::vector<WordsLanguage>> list_words(std::span<const std::byte> file);

/// Reads one language and no part of the others; the file must have `language`.
[[nodiscard]] Result<LanguageWords> read_words(std::span<const std::byte> file, std::string_view language);

} // namespace frustumscreen::pack
