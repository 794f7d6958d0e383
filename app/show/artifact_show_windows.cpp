// The titles of states below their windows.
#include "app/show/artifact_show.h"

namespace frustumscreen::show {

void ArtifactShow::place_state_titles(const exhibit::Presentation& presentation) {
    for (const exhibit::PresentedWindow& window : presentation.windows.windows()) {
        const residency::LoadedTexts* const texts =
            window.state && window.title.size_m.y > 0.0
                ? set_->artifact_cache->texts(window.artifact, residency::TextPart::Caption, window.language)
                : nullptr;
        const scene::TextureId texture =
            texts != nullptr ? texts->texture(residency::state_picture(catalogue()[window.artifact],
                                                                       window.language, *window.state))
                             : scene::TextureId::None;
        if (texture != scene::TextureId::None) {
            on_table_.add({.corners_m = residency::picture_corners(
                               residency::on_pixels(window.title, projector_, table_from_projector_)),
                           .brightness = caption_brightness_ * window.brightness,
                           .texture = texture});
        }
    }
}

} // namespace frustumscreen::show
