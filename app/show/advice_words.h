/// The exhibit's own words in the languages that it shows: pictures for the table, recordings for the loudspeaker.
///
/// Units    metres on the table.
/// Threads  made on the render thread before the first frame.
/// Memory   its recordings stay as they are in the file; prompt_reader.h decodes what is spoken.
/// Errors   the file cannot be read or is none of words.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/gpu_store.h"
#include "app/show/prompt_reader.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen {

/// One sentence, wrapped to each of the captions' widths, and spoken.
struct AdviceWord {
    std::vector<TextureId> textures; ///< one for each of AdviceText::sizes_m
    SharedRecording recording;       ///< none: it is silent
};

struct AdviceWords {
    std::vector<AdviceLanguage> languages;      ///< for the exhibit
    std::vector<std::vector<AdviceWord>> words; ///< [language][text], in the same order
    std::uint64_t planned_gpu_bytes = 0;
};

struct AdviceWordsRequest {
    std::filesystem::path file;
    std::vector<std::string> languages; ///< that are shown; the nearest ones are read
    double em_m = 0.010;
    double texels_per_m = 2400.0;
    bool spoken = false;
};

[[nodiscard]] Result<AdviceWords> load_advice_words(const AdviceWordsRequest& request, GpuStore& store);

} // namespace frustumscreen
