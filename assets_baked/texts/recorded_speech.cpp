#include "assets_baked/texts/recorded_speech.h"

#include "assets_baked/texts/recording.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/letters_apart.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace frustumscreen {

namespace {

namespace fs = std::filesystem;

constexpr std::array endings{".wav", ".flac", ".opus", ".ogg"};
/// Other endings that a person may use for a recording.
constexpr std::array other_endings{".mp3", ".m4a", ".aac", ".aif", ".aiff", ".wma", ".oga"};

bool is_sound(const fs::path& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return std::find(endings.begin(), endings.end(), ending) != endings.end() ||
           std::find(other_endings.begin(), other_endings.end(), ending) != other_endings.end();
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
    const bool can_be_read = std::find(endings.begin(), endings.end(), file.extension()) != endings.end();
    if (const auto wanted = names.find(name); wanted != names.end() && wanted->second) {
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
    for (const char* ending : endings) {
        std::filesystem::path file = folder / language / (key + ending);
        std::error_code ignored;
        if (!folder.empty() && std::filesystem::exists(file, ignored)) {
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
        const bool is_left_out =
            std::find(left_out.begin(), left_out.end(), inside.begin()->string()) != left_out.end();
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

} // namespace frustumscreen
