#include "app/show/pattern_show.h"

namespace frustumscreen {

PatternShow::PatternShow(PatternScene scene, Typesetter typesetter, PictureUpload upload)
    : scene_(std::move(scene)), typesetter_(std::move(typesetter)), upload_(std::move(upload)),
      table_(table_pattern(scene_, typesetter_)) {}

Result<std::unique_ptr<PatternShow>> PatternShow::create(const Settings& settings) {
    Result<Typesetter> typesetter = Typesetter::open();
    if (!typesetter) {
        return tl::unexpected<Error>(typesetter.error());
    }
    const Pinhole& pinhole = settings.projector.pinhole;
    PatternScene scene{pinhole,
                       settings.projector.table_from_projector,
                       {settings.table.width_m, settings.table.depth_m},
                       make_prop(settings.prop)};
    return std::unique_ptr<PatternShow>(new PatternShow(std::move(scene), std::move(*typesetter),
                                                        PictureUpload(pinhole.width, pinhole.height)));
}

void PatternShow::set_lines(std::vector<std::string> lines) {
    if (lines != lines_) {
        lines_ = std::move(lines);
        shown_.reset();
    }
}

DrawResult PatternShow::draw(MonotonicTime, const Situation& situation, const RenderTarget& target,
                             Redraw redraw) {
    const glm::dmat4 pose = situation.table_from_prop.matrix();
    const PixelRectangle whole{0, 0, scene_.projector.width, scene_.projector.height};
    const bool unchanged = target.buffer_age > 0 && shown_ == pose;
    if (redraw == Redraw::Changes && unchanged) {
        return {};
    }
    if (redraw == Redraw::Again && unchanged && target.buffer_age == 1) {
        return {true, {}, whole, 0};
    }
    shown_ = pose;
    const Image8 picture = with_prop(table_, scene_, situation.table_from_prop, typesetter_);
    upload_.show(lines_.empty() ? picture : with_lines(picture, lines_, typesetter_), target.framebuffer);
    return {true, whole, whole, 1};
}

} // namespace frustumscreen
