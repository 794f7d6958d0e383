#include "app/show/pattern_show.h"

#include <algorithm>

namespace frustumscreen {

PatternShow::PatternShow(PatternScene scene, Typesetter typesetter, PictureUpload upload)
    : scene_(std::move(scene)), typesetter_(std::move(typesetter)), upload_(std::move(upload)),
      table_(table_pattern(scene_, typesetter_)) {}

Result<std::unique_ptr<PatternShow>> PatternShow::create(const Settings& settings) {
    TRY(Typesetter typesetter, Typesetter::open());
    const Pinhole& pinhole = settings.projector.pinhole;
    PatternScene scene{pinhole,
                       settings.projector.table_from_projector,
                       {settings.table.width_m, settings.table.depth_m},
                       make_prop(settings.prop)};
    std::unique_ptr<PatternShow> show(new PatternShow(std::move(scene), std::move(typesetter),
                                                      PictureUpload(pinhole.width, pinhole.height)));
    if (settings.camera.kind != CameraKind::None) {
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

void PatternShow::set_picture(Image8 picture, bool with_edges) {
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

DrawResult PatternShow::draw(MonotonicTime, const TrackedState& tracked_state, const RenderTarget& target,
                             Redraw redraw) {
    const glm::dmat4 pose = with_edges_ ? tracked_state.table_from_prop.matrix() : glm::dmat4(1.0);
    const PixelRectangle whole{0, 0, scene_.projector.width, scene_.projector.height};
    const bool other_camera = follow_camera(target.buffer_age);
    const bool unchanged = target.buffer_age > 0 && shown_ == pose && !other_camera;
    if (redraw == Redraw::Changes && unchanged) {
        return {};
    }
    const bool with_camera = panel_ && viewfinder_ != nullptr;
    without_camera_ = with_camera ? 0 : std::min(without_camera_ + 1, max_buffers);
    if (redraw == Redraw::Again && unchanged && target.buffer_age == 1) {
        return {true, {}, whole, 0};
    }
    if (shown_ != pose) {
        const Image8 picture =
            with_edges_ ? with_prop(table_, scene_, tracked_state.table_from_prop, typesetter_) : table_;
        upload_.put(lines_.empty() ? picture : with_lines(picture, lines_, typesetter_));
        shown_ = pose;
    }
    upload_.show_again(target.framebuffer);
    if (with_camera) {
        panel_->show(target.framebuffer);
    }
    return {true, whole, whole, 1};
}

} // namespace frustumscreen
