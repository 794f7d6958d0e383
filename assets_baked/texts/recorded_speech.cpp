#include "assets_baked/texts/recorded_speech.h"

#include "assets_baked/texts/recording.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/printable.h"

namespace frustumscreen {

std::optional<std::filesystem::path> find_recording(const std::filesystem::path& folder,
                                                    const std::string& language, const std::string& key) {
    for (const char* ending : {".wav", ".flac", ".opus", ".ogg"}) {
        std::filesystem::path file = folder / language / (key + ending);
        std::error_code ignored;
        if (!folder.empty() && std::filesystem::exists(file, ignored)) {
            return file;
        }
    }
    return std::nullopt;
}

Result<Speech> read_speech(const std::filesystem::path& file) {
    const Result<Bytes> bytes = read_file(file, most_recording_bytes);
    if (!bytes) {
        return tl::unexpected<Error>(bytes.error());
    }
    const Result<Recording> recording = read_recording(*bytes, RecordingSource::File);
    Result<Speech> speech = recording ? level_speech(*recording) : tl::unexpected<Error>(recording.error());
    return speech ? std::move(speech) : at(printable(file.string(), 300), speech.error());
}

} // namespace frustumscreen
