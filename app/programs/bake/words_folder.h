/// Lists the files in a museum's folder of words.
///
/// Threads  reads the folder; any.
#pragma once

#include "assets_baked/texts/words.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::programs {

struct WordsFolder {
    std::vector<std::string> languages;            ///< built-in languages, then those that the folder adds
    std::vector<std::filesystem::path> word_files; ///< LANGUAGE.toml
    std::vector<std::string> notes;                ///< files whose name is no language, a sentence each
};

/// `folder` may be empty: the built-in words alone.
[[nodiscard]] WordsFolder list_words_folder(const std::filesystem::path& folder);

struct WordRecordings {
    std::vector<std::filesystem::path> taken;
    std::vector<std::string> notes; ///< recordings that belong to no word, a sentence each
};
/// `left_out`: languages that were left out on purpose; their recordings give no note.
[[nodiscard]] WordRecordings list_word_recordings(const std::filesystem::path& folder,
                                                  std::span<const texts::CollectedWords> collected,
                                                  const std::vector<std::string>& left_out);

} // namespace frustumscreen::programs
