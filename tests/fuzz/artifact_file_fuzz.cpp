// A curator's artifact.toml: it is either refused in one line that begins with the file's name, or contains
// only what a pack may contain.
#include "app/pack/container/limits.h"
#include "app/pack/pack_text.h"
#include "assets_baked/folder/artifact_file.h"
#include "tests/fuzz/fuzz.h"

using namespace frustumscreen;

namespace {

void require_clean(const std::string& text, pack::TextShape shape) {
    fuzz::require(!pack::fault_of_text(text, shape), "a text is clean", text);
}

void require_inside(const std::filesystem::path& path) {
    fuzz::require(path.is_relative() && *path.begin() == "vase", "a path stays in the folder", path.string());
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = folder::parse_artifact_file(fuzz::text_of(data, size), "vase/artifact.toml");
    if (!file) {
        const std::string& message = file.error().message;
        fuzz::require(message.starts_with("vase/artifact.toml:"), "a message names the file", message);
        fuzz::require_one_line(message);
        return 0;
    }
    require_inside(file->scan);
    if (!file->texture.empty()) {
        require_inside(file->texture);
    }
    fuzz::require(file->id.empty() || pack::is_artifact_id(file->id), "the id is one");
    fuzz::require(file->scale >= pack::min_scale && file->scale <= pack::max_scale,
                  "the scale is one that a pack may have");
    for (const pack::PackCaption& caption : file->texts) {
        fuzz::require(pack::has_language_form(caption.language), "a language has its form", caption.language);
        for (const std::string* line :
             {&caption.title, &caption.period, &caption.place, &caption.maker, &caption.credit}) {
            require_clean(*line, pack::TextShape::Line);
        }
        require_clean(caption.text, pack::TextShape::Lines);
        require_clean(caption.description, pack::TextShape::Lines);
    }
    fuzz::require(file->hotspots.size() <= pack::max_hotspots, "hotspots are few");
    for (const folder::ArtifactHotspot& hotspot : file->hotspots) {
        fuzz::require(fuzz::is_finite(hotspot.point_file) && !hotspot.labels.empty(),
                      "a hotspot has a place and a label");
    }
    for (const folder::ArtifactBehaviour& behaviour : file->behaviours) {
        require_clean(behaviour.name, pack::TextShape::Line);
        fuzz::require(behaviour.animation.empty() != behaviour.cell.empty(),
                      "a behaviour moves by an animation, or a part by itself");
    }
    return 0;
}
