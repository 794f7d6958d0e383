#include "app/programs/bake/label_notes.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::programs {

std::vector<std::string> label_notes(std::span<const folder::ArtifactHotspot> hotspots,
                                     std::span<const pack::PackCaption> captions,
                                     std::span<const std::string> left_out) {
    const auto is_in = [](const std::string& language) {
        return [&](const auto& each) { return each.language == language; };
    };
    std::vector<std::string> notes;
    for (std::size_t k = 0; k < hotspots.size(); ++k) {
        const std::vector<pack::PackLabel>& labels = hotspots[k].labels;
        for (const pack::PackCaption& caption : captions) {
            if (std::none_of(labels.begin(), labels.end(), is_in(caption.language))) {
                notes.push_back(fmt::format("hotspots[{}] has no label in '{}', so its visitors read another "
                                            "language there; write {} = "
                                            "\"...\" under labels",
                                            k, caption.language, caption.language));
            }
        }
        for (const pack::PackLabel& label : labels) {
            const bool has_texts =
                std::any_of(captions.begin(), captions.end(), is_in(label.language)) ||
                std::find(left_out.begin(), left_out.end(), label.language) != left_out.end();
            if (!has_texts) {
                notes.push_back(
                    fmt::format("hotspots[{}] has the label \"{}\" in '{}', and the artifact has "
                                "no [[texts]] in that language; write them, or take the label away",
                                k, printable(label.text, 60), label.language));
            }
        }
    }
    return notes;
}

} // namespace frustumscreen::programs
