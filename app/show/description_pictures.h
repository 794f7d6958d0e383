/// An artifact's description as it is shown and spoken: a picture of each portion for the table, how long it is read, and where
/// its sound is.
///
/// Threads  made on the render thread when the artifact is loaded, never in a frame.
/// Errors   no typeface where one is needed; no memory for a picture.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/pack/pack.h"
#include "app/render/gpu_store.h"
#include "app/show/caption_setter.h"
#include "app/show/prompt_reader.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>
#include <vector>

namespace frustumscreen {

/// In one language.
struct DescriptionPictures {
    DescriptionShape shape;                       ///< for the exhibit
    Tellable tellable;                            ///< for the exhibit, with the hotspots
    std::vector<std::vector<TextureId>> portions; ///< by portion and by width
    SharedRecording recording;                    ///< none: it is silent
    std::uint64_t planned_gpu_bytes = 0;
};

struct DescriptionRequest {
    const std::filesystem::path& file;
    const Pack& pack;
    std::span<const SetLanguage> set; ///< the pack's own
    bool spoken = false;
};

/// In the language of `caption`, which is one of the pack's. A description that is too long to be told is not.
[[nodiscard]] Result<DescriptionPictures> make_description(const DescriptionRequest& request,
                                                           const PackCaption& caption, CaptionSetter& setter,
                                                           GpuStore& store);
void release(const DescriptionPictures& description, GpuStore& store);

} // namespace frustumscreen
