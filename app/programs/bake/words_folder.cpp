#include "app/programs/bake/words_folder.h"

#include "app/settings/language_tag.h"
#include "assets_baked/texts/recorded_speech.h"
#include "firmware_host/base/folder_entries.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace frustumscreen::programs {

namespace fs = std::filesystem;

WordsFolder list_words_folder(const fs::path& folder) {
    WordsFolder listed;
    listed.languages = texts::builtin_word_languages();
    for (const fs::directory_entry& each : entries_of(folder)) {
        if (each.path().extension() == ".toml") {
            listed.word_files.push_back(each.path());
        }
    }
    for (const fs::path& file : listed.word_files) {
        const std::string name = file.stem().string();
        const std::optional<std::string> language = settings::parse_language_tag(name);
        if (language != name) {
            listed.notes.push_back(
                fmt::format("{}: this file is not used; name it after its language, such as {}.toml",
                            printable(file.string(), 300), language.value_or("de")));
        } else if (std::find(listed.languages.begin(), listed.languages.end(), name) ==
                   listed.languages.end()) {
            listed.languages.push_back(name);
        }
    }
    return listed;
}

WordRecordings list_word_recordings(const fs::path& folder, std::span<const texts::CollectedWords> collected,
                                    const std::vector<std::string>& left_out) {
    WordRecordings listed;
    texts::RecordingNames names;
    for (const texts::CollectedWords& words : collected) {
        for (const texts::Word& word : words.words) {
            const std::optional<fs::path> file = texts::find_recording(folder, words.language, word.key);
            names[words.language + "/" + word.key] = file;
            if (file) {
                listed.taken.push_back(*file);
            }
        }
    }
    listed.notes = texts::unused_recordings(folder, names, left_out);
    return listed;
}

} // namespace frustumscreen::programs
