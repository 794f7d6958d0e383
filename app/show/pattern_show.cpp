#include "app/show/pattern_show.h"

#include <algorithm>

namespace frustumscreen::show {

PatternShow::PatternShow(typography::PatternScene scene, typography::Typesetter typesetter, EyeParts eyes)
    : scene_(std::move(scene)), typesetter_(std::move(typesetter)), eyes_(eyes),
      upload_(scene_.projector.width, scene_.projector.height),
      table_(typography::table_pattern(scene_, typesetter_)) {}

Result<std::unique_ptr<PatternShow>> PatternShow::create(const settings::Settings& settings) {
    TRY(typography::Typesetter typesetter, typography::Typesetter::open());
    const geometry::Pinhole& pinhole = settings.projector.pinhole;
    typography::PatternScene scene{.projector = pinhole,
                                   .table_from_projector = settings.projector.table_from_projector,
                                   .table_size_m = {settings.table.width_m, settings.table.depth_m},
                                   .prop = settings::make_prop(settings.prop)};
    std::unique_ptr<PatternShow> show(
        new PatternShow(std::move(scene), std::move(typesetter), EyeParts(settings)));
    if (settings::stereo_of(settings) != settings::Stereo::Off) {
        show->letters_ = std::make_unique<EyeLetters>(show->eyes_, show->table_, show->typesetter_);
    }
    if (settings.camera.kind != settings::CameraKind::None) {
        show->panel_ = std::make_unique<ViewfinderPanel>(pinhole);
    }
    return show;
}

void PatternShow::tell(const RunStatus& status) {
    if (panel_) {
        panel_->set_line(viewfinder_line(status), typesetter_);
    }
}

/// True if the framebuffer's camera picture is out of date.
bool PatternShow::follow_camera(int buffer_age) {
    if (panel_ && viewfinder_ != nullptr) {
        return panel_->follow(*viewfinder_) || without_camera_ > 0;
    }
    if (panel_) {
        panel_->forget();
    }
    return buffer_age > without_camera_;
}

void PatternShow::set_picture(image::Image8 picture, bool with_edges) {
    table_ = std::move(picture);
    with_edges_ = with_edges;
    shown_.reset();
}

void PatternShow::set_lines(std::vector<std::string> lines) {
    if (lines != lines_) {
        lines_ = std::move(lines);
        shown_.reset();
    }
}

/// Draws the picture for this pose and stores it for the display.
void PatternShow::draw_picture(const geometry::RigidTransform& table_from_prop) {
    image::Image8 picture =
        with_edges_ ? typography::with_prop(table_, scene_, table_from_prop, typesetter_) : table_;
    if (!lines_.empty()) {
        picture = typography::with_lines(picture, lines_, typesetter_);
    }
    upload_.put(picture);
    if (letters_) {
        letters_->put(picture);
    }
}

render::DrawResult PatternShow::draw(MonotonicTime, const tracking::TrackedState& tracked_state,
                                     const render::RenderTarget& target, render::Redraw redraw) {
    const glm::dmat4 pose = with_edges_ ? tracked_state.table_from_prop.matrix() : glm::dmat4(1.0);
    const PixelRectangle whole = eyes_.whole();
    const bool other_camera = follow_camera(target.buffer_age);
    const bool unchanged = target.buffer_age > 0 && shown_ == pose && !other_camera;
    if (redraw == render::Redraw::Changes && unchanged) {
        return {};
    }
    const bool with_camera = panel_ && viewfinder_ != nullptr;
    without_camera_ = with_camera ? 0 : std::min(without_camera_ + 1, max_buffers);
    if (redraw == render::Redraw::Again && unchanged && target.buffer_age == 1) {
        return {.drawn = true, .redrawn = {}, .lit = whole, .draw_calls = 0};
    }
    if (shown_ != pose) {
        draw_picture(tracked_state.table_from_prop);
        shown_ = pose;
    }
    eyes_.show(upload_, target.framebuffer);
    if (letters_ && with_edges_) {
        letters_->show(target.framebuffer);
    }
    if (with_camera) {
        panel_->show(target.framebuffer, eyes_);
    }
    return {.drawn = true, .redrawn = whole, .lit = whole, .draw_calls = 1};
}

} // namespace frustumscreen::show
