#include "assets_baked/texts/recorded_speech.h"

#include "assets_baked/names/file_name.h"
#include "assets_baked/names/find_entry.h"
#include "assets_baked/texts/recording.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/letters_apart.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace frustumscreen::texts {

namespace {

namespace fs = std::filesystem;

constexpr std::array endings{".wav", ".flac", ".opus", ".ogg"};
/// Other endings that a person may use for a recording.
constexpr std::array other_endings{".mp3", ".m4a", ".aac", ".aif", ".aiff", ".wma", ".oga"};

/// True if the file ends in one of these, in any case.
template <std::size_t count> bool ends_in(const fs::path& file, const std::array<const char*, count>& some) {
    const std::string ending = file.extension().string();
    return std::any_of(some.begin(), some.end(),
                       [&](const char* each) { return names::is_same_file_name(ending, each); });
}

bool is_sound(const fs::path& file) {
    return ends_in(file, endings) || ends_in(file, other_endings);
}

/// Sound files in the folder and its direct subfolders, sorted by name.
std::vector<fs::path> sounds_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code failed;
    fs::recursive_directory_iterator each(folder, fs::directory_options::skip_permission_denied, failed);
    for (; !failed && each != fs::recursive_directory_iterator(); each.increment(failed)) {
        if (each.depth() > 0) {
            each.disable_recursion_pending();
        }
        std::error_code none;
        if (is_sound(each->path()) && each->is_regular_file(none)) {
            files.push_back(each->path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// The reason why a file is not used.
std::string why_unused(const fs::path& file, const std::string& name, const RecordingNames& names) {
    const bool can_be_read = ends_in(file, endings);
    const auto wanted = std::find_if(names.begin(), names.end(), [&](const auto& each) {
        return names::is_same_file_name(each.first, name);
    });
    if (wanted != names.end() && wanted->second) {
        return fmt::format("{} is used instead", printable(wanted->second->string(), 300));
    }
    if (!can_be_read) {
        const fs::path wav = fs::path(file).replace_extension(endings.front());
        return fmt::format("it is not WAV, FLAC or Ogg Opus; convert it, such as with ffmpeg -i {} {}",
                           printable(file.filename().string(), 100), printable(wav.filename().string(), 100));
    }
    const auto nearest = std::min_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
        return letters_apart(name, a.first) < letters_apart(name, b.first);
    });
    return fmt::format("no text has this name; the nearest name of a text is {}{}", nearest->first,
                       file.extension().string());
}

} // namespace

std::optional<std::filesystem::path> find_recording(const std::filesystem::path& folder,
                                                    const std::string& language, const std::string& key) {
    const std::optional<fs::path> spoken =
        folder.empty() ? std::nullopt : names::find_entry(folder, language);
    for (const char* ending : endings) {
        if (std::optional<fs::path> file = spoken ? names::find_entry(*spoken, key + ending) : std::nullopt) {
            return file;
        }
    }
    return std::nullopt;
}

std::vector<std::string> unused_recordings(const fs::path& folder, const RecordingNames& names,
                                           const std::vector<std::string>& left_out) {
    std::vector<std::string> notes;
    if (folder.empty() || names.empty()) {
        return notes;
    }
    for (const fs::path& file : sounds_in(folder)) {
        const fs::path inside = file.lexically_relative(folder);
        const std::string name = (inside.parent_path() / inside.stem()).generic_string();
        const bool is_taken = std::any_of(names.begin(), names.end(), [&](const auto& each) {
            return each.second && each.second->lexically_normal() == file.lexically_normal();
        });
        const bool is_left_out = std::any_of(left_out.begin(), left_out.end(), [&](const std::string& each) {
            return names::is_same_file_name(each, inside.begin()->string());
        });
        if (!is_taken && !is_left_out) {
            notes.push_back(fmt::format("{}: this recording is not used: {}", printable(file.string(), 300),
                                        why_unused(file, name, names)));
        }
    }
    return notes;
}

Result<Speech> read_speech(const std::filesystem::path& file) {
    TRY(const Bytes bytes, read_file(file, max_recording_bytes));
    const std::string name = printable(file.string(), 300);
    TRY(const Recording recording, at(name, read_recording(bytes, RecordingSource::File)));
    TRY(std::optional<Speech> speech, at(name, level_speech(recording)));
    return speech ? Result<Speech>(*std::move(speech))
                  : bad_input("speech.silent", name + ": the recording is silent; record it again, louder");
}

} // namespace frustumscreen::texts
